# SPDX-License-Identifier: Apache-2.0
"""The folder of an image's parts, where others may write: what a job removes there, and what it does not touch."""
import concurrent.futures
import os
import types

import pytest

import inProcess
import movie
from patina.cli.errors import CommandError
from patina.farm import folders, job, owner, sender, work, worker
from test_work import _dead, frame, owned, prepare, version  # noqa: F401


def test_what_is_not_the_jobs_own_stays(tmp_path):
    one = frame(tmp_path)
    one.prepare("job")
    own = ["1.part", "12.part", "2.log", "image.log", "3.20250101-101500.77.failed.log", "image.20250101-101500.7.failed.log",
           "image.20250101-101500.7.2.failed.log", ".2.29304-1.part"]
    others = ["7.2.part", ".a.2-1.part", "stage.usda", "notes.log", "kept.failed.log", "1.part.txt"]
    for name in own + others:
        (tmp_path / "a.exr.parts" / name).write_text("")
    one.forget()
    assert sorted(os.listdir(one.folder)) == sorted([*others, owner.NAME])
    for name in others:
        os.remove(os.path.join(one.folder, name))
    one.forget()
    one.leave()
    assert not os.path.exists(one.folder)
    one.forget()  # nothing is there


@pytest.mark.parametrize("resume", [False, True])
def test_a_link_in_the_place_of_the_parts_is_refused(tmp_path, resume):
    other, one = tmp_path / "other", frame(tmp_path)
    other.mkdir()
    for name in ("1.part", "1.log", owner.NAME):
        (other / name).write_text("{}")
    os.symlink(other, one.folder)
    (tmp_path / "a.exr").write_text("")  # as if --resume had only to tidy up
    with pytest.raises(CommandError, match=f"cannot use the folder {one.folder}: it is a link; remove it"):
        owner.check(one.folder, "job")
    with pytest.raises(CommandError, match="it is a link"):
        prepare("job", one, resume=resume)
    one.job = "job"
    for end in (one.forget, one.tidy, lambda: one.tidy_after("job"), one.leave):
        end()
    with pytest.raises(worker.PartFailed, match="cannot use the folder .*it is a link"):
        version(tmp_path, os.path.join(one.folder, "1.log"), "links")
    assert sorted(os.listdir(other)) == ["1.log", "1.part", owner.NAME]


@pytest.mark.parametrize("number, reason", [(1, ""), (2, "cannot write '{}/2.part': it is a folder"),
                                            (3, "cannot read part '{}/1.part': it does not exist")])
def test_a_link_that_comes_while_a_part_is_rendered_leads_nowhere(tmp_path, monkeypatch, number, reason):
    """The third task merges."""
    one, before, other = frame(tmp_path), tmp_path / "before", tmp_path / "other"
    one.prepare("job")
    other.mkdir()
    os.mkdir(one.part_file(one.parts()[1]))
    for name in ("1.part", f"{number}.log"):
        (other / name).write_text("mine")
    call = worker._execute

    def swapped(*arguments, **keywords):
        os.rename(one.folder, before)
        os.symlink(other, one.folder)
        return call(*arguments, **keywords)

    monkeypatch.setattr(worker, "_execute", swapped)
    task = work.Task(one, one.parts()[number - 1] if number < 3 else None)
    command = task.arguments([movie.write_stage(tmp_path), one.image, "--imageWidth=96", "--samples=1"], 1)
    if reason:
        with pytest.raises(worker.PartFailed, match=reason.format(one.folder)):
            worker.run(command, str(tmp_path), task.log, ("swapped", [], [], {}))
    else:
        worker.run(command, str(tmp_path), task.log, ("swapped", [], [], {}))
    assert {path.name: path.read_text() for path in other.iterdir()} == dict.fromkeys(("1.part", f"{number}.log"), "mine")
    assert os.path.isfile(before / "1.part") is (number == 1)


def test_a_folder_of_somebody_else_is_refused(tmp_path, monkeypatch):
    """But not on a file system that gives all files to one user, as those of other systems do."""
    one = frame(tmp_path)
    os.mkdir(one.folder)
    (tmp_path / "a.exr.parts" / "1.part").write_text("")
    uid = os.stat(one.folder).st_uid
    monkeypatch.setattr(folders.os, "geteuid", lambda: uid + 1)
    owner.check(one.folder, "job")
    monkeypatch.setattr(folders, "_maker", lambda _: uid + 1)
    with pytest.raises(CommandError, match=f"cannot use the folder {one.folder}: it belongs to .+; remove it"):
        owner.check(one.folder, "job")
    with pytest.raises(CommandError, match="it belongs to"):
        prepare("job", one)
    one.forget()
    assert os.listdir(one.folder) == ["1.part"]


def test_whose_a_folder_is_is_seen_without_writing_there(tmp_path, monkeypatch):
    one = frame(tmp_path)
    os.mkdir(one.folder)
    os.utime(one.folder, ns=(0, 0))
    uid = os.stat(one.folder).st_uid
    monkeypatch.setattr(folders.os, "geteuid", lambda: uid + 1)
    owner.check(one.folder, "job")
    assert os.stat(one.folder).st_mtime_ns == 0 and os.listdir(tmp_path) == ["a.exr.parts"]


@pytest.mark.parametrize("what", ["link", "another's", "own"])
def test_a_job_of_other_schedulers_takes_no_folder_of_somebody_else(tmp_path, monkeypatch, what):
    """Its tasks name the folder themselves."""
    image, folder, other = tmp_path / "a.##.exr", tmp_path / "a.##.exr.parts", tmp_path / "other"
    other.mkdir()
    if what == "link":
        os.symlink(other, folder)
    elif what == "another's":
        folder.mkdir()
        uid = os.stat(folder).st_uid
        monkeypatch.setattr(folders.os, "geteuid", lambda: uid + 1)
        monkeypatch.setattr(folders, "_maker", lambda _: uid + 1)
    result = inProcess.patina("record", movie.write_stage(tmp_path), image, "-w", 16, "--samples=1", "--frames=1", "--part=1/1",
                              f"--partial={folder}/1.1.part", "--quiet", check=False)
    if what == "own":
        assert result.returncode == 0 and os.listdir(folder) == ["1.1.part"], result.stderr
    else:
        assert result.returncode == 1 and f"cannot use the folder {folder}: it " in result.stderr
        assert os.listdir(folder) == []


class Here:
    """Runs what is sent in this process."""

    def scheduler_info(self, n_workers):
        return {"workers": {"here": {}}}

    def submit(self, function, *arguments, **_):
        future = concurrent.futures.Future()
        try:
            future.set_result(function(*arguments))
        except (worker.PartFailed, worker.Refused) as error:
            future.set_exception(error)
        return future


@pytest.mark.parametrize("whose", ["the sender's", "the worker's", "another's"])
def test_a_worker_writes_to_no_folder_of_another_user(tmp_path, monkeypatch, whose):
    """Such a folder comes in the place of that which the sender has made. A worker may be of another user than the sender."""
    one = frame(tmp_path, 1)
    one.prepare("job")
    os.rename(one.folder, tmp_path / "before")
    os.mkdir(one.folder)
    uid = one.user
    monkeypatch.setattr(folders, "_maker", lambda _: None)
    if whose != "the worker's":
        monkeypatch.setattr(folders.os, "geteuid", lambda: uid + 1)
    if whose != "the sender's":
        one.user = uid + 2
    begun = []
    monkeypatch.setattr(worker, "_execute", lambda *_, **__: begun.append(os.listdir(one.folder)) or 0)
    sent = sender.Sender(Here(), [], str(tmp_path), (whose, [], [], {}), 0)
    sent.run([one], one.tasks(set()), lambda _: None)
    if whose == "another's":
        assert not begun and os.listdir(one.folder) == []
        assert all("it belongs to" in why for _, why in sent.failed[0].failures)
    else:
        assert begun == [["image.log"]] and sent.written == [one]


@pytest.mark.parametrize("target", ["mine", "none"])
def test_a_link_among_the_parts_is_replaced(tmp_path, target):
    one = frame(tmp_path)
    one.prepare("job")
    (tmp_path / "mine").write_text("mine")
    link = one.part_file(one.parts()[0])
    call = worker._execute

    def planted(*arguments, **keywords):
        os.symlink(tmp_path / target, link)
        return call(*arguments, **keywords)

    task = work.Task(one, one.parts()[0])
    command = task.arguments([movie.write_stage(tmp_path), one.image, "--imageWidth=96", "--samples=1"], 1)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(worker, "_execute", planted)
        if target == "none":
            with pytest.raises(worker.PartFailed, match="it is a link to nothing"):
                worker.run(command, str(tmp_path), task.log, ("links", [], [], {}))
        else:
            worker.run(command, str(tmp_path), task.log, ("links", [], [], {}))
    assert os.path.islink(link) is (target == "none")
    assert (tmp_path / "mine").read_text() == "mine" and not (tmp_path / "none").exists()


def test_links_among_the_parts_of_an_earlier_job_are_left_out(tmp_path, monkeypatch):
    one, read = frame(tmp_path), []
    os.mkdir(one.folder)
    first, second = map(one.part_file, one.parts())
    for file in (first, tmp_path / "other"):
        open(file, "w").close()
    os.symlink(tmp_path / "other", second)

    def seen(_, file):
        read.append(file)
        raise CommandError("no part")

    monkeypatch.setattr(work.partial, "read", seen)
    assert work.parts_there(None, one, {}) == set() and read == [first]


@pytest.mark.parametrize("newer", [False, True], ids=["older", "newer"])
@pytest.mark.parametrize("names", [["2.part"], ["2.part", "1.log"], ["image.log"]], ids="-".join)
def test_parts_that_a_killed_job_left_behind_its_image_go(tmp_path, dead, names, newer):
    """--resume looks no more at an image that is there. Newer parts are of another render that was not done."""
    one = frame(tmp_path)
    if owned(one, **dead)["begun"] is None:
        pytest.skip("the system does not tell when a process began")
    for name in names:
        (tmp_path / "a.exr.parts" / name).write_text("")
    (tmp_path / "a.exr").write_text("")
    begun = os.stat(tmp_path / "a.exr.parts" / names[0]).st_mtime_ns
    os.utime(tmp_path / "a.exr", ns=(begun, begun - (1000 if newer else 0)))
    waiting = job.Job._waiting(types.SimpleNamespace(
        name="second", frames=[frame(tmp_path)], arguments=types.SimpleNamespace(resume=True)))
    assert waiting == ([], [])
    assert os.path.exists(one.folder) is (newer and "2.part" in names) and (tmp_path / "a.exr").exists()


def test_an_input_among_the_parts_is_refused(tmp_path):
    one = frame(tmp_path)
    one.check([str(tmp_path / "stage.usda"), str(tmp_path / "a.exr.partsOfOthers" / "b.png")])
    with pytest.raises(CommandError, match="b.png lies in .*a.exr.parts"):
        one.check([str(tmp_path / "a.exr.parts" / "deep" / "b.png")])
