# SPDX-License-Identifier: Apache-2.0
"""The commands that a job sends, how it tells a failure that may pass, and jobs of the same image."""
import concurrent.futures
import errno
import json
import os
import subprocess
import sys
import time
import types

import pytest

import _patina
import movie
from inProcess import patina
from patina.cli import record
from patina.cli.errors import CommandError, is_temporary
from patina.farm import cut, identity, job, owner, partial, sender, work, worker


def frame(folder, tiles=2):
    return work.Frame(None, str(folder / "a.exr"), cut.Cut(tiles), [])


def test_a_worker_leaves_no_image_of_fewer_samples(tmp_path):
    assert "--onlyWhole" in work.Task(frame(tmp_path, 1), None).arguments(["stage.usda", "a.exr"], 0)


def test_what_a_job_has_kept_is_known_by_its_files(tmp_path):
    one = frame(tmp_path)
    now = time.time()
    assert not one.kept(now - 60)
    one.prepare("job")
    (tmp_path / "a.exr.parts" / "2.part").write_text("")
    assert one.kept(now - 60) and not one.kept(now + 60)


def test_the_folder_of_commands_is_looked_at(tmp_path):
    assert worker.check("home", [], [], None, str(tmp_path / "none")) == [f"cannot enter {tmp_path / 'none'}"]


def test_a_build_that_is_made_anew_ends_the_work_of_a_worker(tmp_path, monkeypatch):
    """Files are looked at once for a job, the build before each task."""
    made = {"version": "1", "build": "old", "instruction set": "any"}
    monkeypatch.setattr(identity, "of_machine", lambda _: dict(made))
    checks, begun = ("anew", [], [], dict(made)), []
    monkeypatch.setattr(worker, "_execute", lambda *_, **__: begun.append(made["build"]) or 0)
    worker.run([], str(tmp_path), str(tmp_path / "1.log"), checks)
    made["build"] = "new"
    with pytest.raises(worker.Refused, match="build is new, not old"):
        worker.run([], str(tmp_path), str(tmp_path / "1.log"), checks)
    assert begun == ["old"]

    def missing(_):  # while it is linked
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))

    monkeypatch.setattr(identity, "of_machine", missing)
    assert worker.check(*checks) == ["has no Patina: [Errno 2] No such file or directory"]


def test_a_part_tells_the_build_that_its_process_began_with(tmp_path, monkeypatch):
    made, render = dict(identity.of_machine(_patina), build="old"), record._Job._render

    def built_anew(*arguments):
        made["build"] = "new"
        render(*arguments)

    monkeypatch.setattr(identity, "of_machine", lambda _: dict(made))
    monkeypatch.setattr(record._Job, "_render", built_anew)
    identity.of_process.cache_clear()
    file = str(tmp_path / "1.part")
    patina("record", movie.write_stage(tmp_path), tmp_path / "a.exr", "-w", 16, "--samples", 1, "--part=1/1",
           f"--partial={file}", "--quiet")
    identity.of_process.cache_clear()
    assert partial.read(_patina, file).identity["build"] == "old" and made["build"] == "new"


class Client:
    """Ends each task with the next of some errors, or a result."""

    def __init__(self, *errors):
        self.errors = list(errors)

    def scheduler_info(self, n_workers):
        return {"workers": {"tcp://1": {"name": "one"}}}

    def submit(self, *_, **__):
        future, error = concurrent.futures.Future(), self.errors.pop(0)
        if error is None:
            future.cancel()
        elif isinstance(error, dict):
            future.set_result(error)
        else:
            future.set_exception(error)
        return future


def sent_by(client, folder):
    """:returns: the sender that had this client end the one task of a frame"""
    one = frame(folder, 1)
    sent = sender.Sender(client, [], str(folder), (), 0)
    sent.run([one], one.tasks(set()), lambda _: None)
    return sent


@pytest.mark.parametrize("passing", [True, False])
def test_reasons_that_may_pass_are_known(tmp_path, passing):
    failed = [worker.PartFailed("why", "tcp://1", passing) for _ in range(work.TRIES)]
    sent = sent_by(Client(*failed), tmp_path)
    assert [task.passing for task in sent.failed] == [passing] and not sent.lost


@pytest.mark.parametrize("error", [worker.PartFailed("why"), worker.Refused("why"), worker.PartFailed(), worker.Refused()])
def test_workers_that_tell_less_end_no_job(tmp_path, error):
    sent = sent_by(Client(*[error] * sender.REFUSALS), tmp_path)
    reasons = {why for task in sent.failed for _, why in task.failures}
    assert not sent.lost and reasons == {"why" if error.args else type(error).__name__}
    assert [task.passing for task in sent.failed] == [False]


class KilledWorker(Exception):
    """Known by its name, as Dask's own is."""


@pytest.mark.parametrize("losses, failures, given_up", [(work.LOSSES - 1, work.TRIES - 1, False), (work.LOSSES, 0, True),
                                                        (3, work.TRIES, True)])
def test_workers_that_die_are_no_fault_of_a_part(tmp_path, losses, failures, given_up):
    errors = [KilledWorker("died")] * losses + [worker.PartFailed("why", "tcp://1", False)] * failures
    client = Client(*errors, {"worker": "one", "host": "here", "seconds": 1.0})
    sent = sent_by(client, tmp_path)
    assert bool(sent.failed) is given_up and bool(sent.written) is not given_up
    assert len(client.errors) == given_up, "given up at once, or sent until it is done"


@pytest.mark.parametrize("failed, wanted", [("tcp://1", ["tcp://2"]), ("tcp://gone", None)])
def test_only_workers_that_are_there_are_avoided(tmp_path, failed, wanted):
    places = []
    client = Client(worker.PartFailed("why", failed, False), {"worker": "one", "host": "here", "seconds": 1.0})
    client.scheduler_info = lambda n_workers: {"workers": {"tcp://1": {}, "tcp://2": {}}}
    submit = client.submit
    client.submit = lambda *_, **more: places.append(more.get("workers")) or submit()
    sent = sent_by(client, tmp_path)
    assert places == [None, wanted] and len(sent.written) == 1


def test_workers_that_go_away_are_told(tmp_path):
    """Dask sends their tasks again by itself, so that the sender sees no failure."""
    one = frame(tmp_path, 1)
    client = Client({"worker": "one", "host": "here", "seconds": 1.0})
    there = iter([{"tcp://1": {"name": "one"}, "tcp://2": {"name": "two"}}, {"tcp://3": {"name": "one"}}])
    client.scheduler_info = lambda n_workers: {"workers": next(there)}
    sent = sender.Sender(client, [], str(tmp_path), (), 0)
    sent._workers()
    sent._seen = float("-inf"), sent._seen[1]
    sent.run([one], one.tasks(set()), lambda _: None)
    assert sent.gone == ["one", "two"] and not sent.failed
    assert [row.losses for row in sent.rows.values()] == [1, 1]
    assert [line.split()[-1] for line in job.table(sent, 1.0)[1:-1]] == ["1", "1"]


def test_a_scheduler_that_dies_ends_the_job_in_words(tmp_path):
    sent = sent_by(Client(None), tmp_path)
    assert "the scheduler is lost (CancelledError" in sent.lost and not sent.written


def test_which_statuses_may_pass(tmp_path, monkeypatch):
    for status, passing in ((75, True), (1, False), (-9, True), (-11, False)):
        monkeypatch.setattr(worker, "_execute", lambda *_, **__: status)
        with pytest.raises(worker.PartFailed) as failed:
            worker.run([], str(tmp_path), str(tmp_path / "1.log"), ("statuses", [], [], None))
        assert failed.value.args[2] is passing


def test_commands_run_with_the_senders_variables(tmp_path, monkeypatch):
    monkeypatch.setenv("OCIO", "/a/workers/own.ocio")
    seen = {}
    monkeypatch.setattr(worker, "_execute", lambda *_, env, **__: seen.update(env) or 0)
    worker.run([], str(tmp_path), str(tmp_path / "log"), ("variables", [], [], {}),
               {"OCIO": None, "PATINA_MODEL_PATH": "/models"})
    assert "OCIO" not in seen and seen["PATINA_MODEL_PATH"] == "/models" and seen["PATH"]


def test_what_variables_lead_to_makes_a_part(tmp_path, monkeypatch):
    (tmp_path / "a.mtlx").write_text("<materialx/>")
    (tmp_path / "a.ocio").write_text("ocio_profile_version: 2")
    monkeypatch.setenv("PATINA_MODEL_PATH", str(tmp_path))
    monkeypatch.setenv("OCIO", str(tmp_path / "a.ocio"))
    before = identity.of_environment()
    assert identity.difference({"environment": before}, {"environment": identity.of_environment()}) == ""
    (tmp_path / "b.mtlx").write_text("<materialx/>")
    now = identity.of_environment()
    assert identity.difference({"environment": now}, {"environment": before}) == "$PATINA_MODEL_PATH leads to something else"
    (tmp_path / "b.mtlx").unlink()
    (tmp_path / "a.ocio").write_text("ocio_profile_version: 1")
    now = identity.of_environment()
    assert identity.difference({"environment": now}, {"environment": before}) == "$OCIO leads to something else"
    monkeypatch.setenv("OCIO", "ocio://default")
    assert identity.of_environment()["OCIO"] == "ocio://default" and "OCIO" not in identity.environment_files()


def version(folder, log, name):
    """Runs a short command as a worker does, from another folder."""
    paths = [os.path.dirname(os.path.dirname(os.path.dirname(worker.__file__))), os.path.dirname(_patina.__file__)]
    worker.run(["--version"], str(folder), str(log), (name, [], [], None),
               {"PYTHONPATH": os.pathsep.join(map(os.path.abspath, paths))})


def test_nothing_of_the_senders_folder_runs(tmp_path, monkeypatch):
    """A patina/ beside a shot is not meant."""
    monkeypatch.delenv("PYTHONSAFEPATH", raising=False)
    (tmp_path / "patina").mkdir()
    (tmp_path / "patina" / "__init__.py").write_text("import pathlib\npathlib.Path('ran').touch()\n")
    version(tmp_path, tmp_path / "1.log", "own")
    assert sorted(os.listdir(tmp_path)) == ["patina"]


def test_logs_follow_no_links_and_wait_for_no_pipes(tmp_path):
    (tmp_path / "mine").write_text("mine")
    os.symlink(tmp_path / "mine", tmp_path / "1.log")
    os.mkfifo(tmp_path / "2.log")
    for number in (1, 2):
        version(tmp_path, tmp_path / f"{number}.log", "logs")
    assert (tmp_path / "mine").read_text() == "mine"
    with pytest.raises(worker.PartFailed, match="cannot write .*none"):
        version(tmp_path, tmp_path / "none" / "1.log", "none")


@pytest.mark.parametrize("number, passing", [(None, False), (errno.ENOSPC, True), (errno.ESTALE, True), (errno.EEXIST, False)])
def test_a_log_that_cannot_be_written_fails_one_part(tmp_path, monkeypatch, number, passing):
    log = tmp_path / "1.log"
    log.mkdir()
    if number:
        def fail(*_, **__):
            raise OSError(number, os.strerror(number))

        monkeypatch.setattr(worker.os, "remove", fail)
    with pytest.raises(worker.PartFailed, match=f"cannot write {log}: ") as failed:
        version(tmp_path, log, "folder")
    assert failed.value.args[1:] == ("", passing)
    sent = sent_by(Client(*[failed.value] * work.TRIES), tmp_path)
    assert [task.passing for task in sent.failed] == [passing] and not sent.lost


def test_failures_of_one_second_keep_their_logs(tmp_path, monkeypatch):
    monkeypatch.setattr(worker.time, "strftime", lambda _: "20250101-101500")
    said = iter(("one", "two", "three"))

    def call(_, take, **__):
        take(next(said).encode())
        return 1

    monkeypatch.setattr(worker, "_execute", call)
    for _ in range(3):
        with pytest.raises(worker.PartFailed, match="one|two|three"):
            worker.run([], str(tmp_path), str(tmp_path / "1.log"), ("failures", [], [], {}))
    logs = sorted(tmp_path.iterdir())
    assert {log.read_text() for log in logs} == {"one", "two", "three"} and all(work._OWN.fullmatch(log.name) for log in logs)


def test_a_full_disk_loses_no_reason(tmp_path, monkeypatch):
    monkeypatch.setattr(worker, "_CHILD", "import sys; print('first'); sys.exit('no space left on device')")
    log = tmp_path / "1.log"
    monkeypatch.setattr(worker.folders.Folder, "new", lambda self, name: os.open("/dev/full", os.O_WRONLY))
    with pytest.raises(worker.PartFailed, match="no space left on device"):
        worker.run([], str(tmp_path), str(log), ("full", [], [], {}))


@pytest.mark.parametrize("status", [0, 1])
def test_a_log_that_another_has_removed_changes_no_outcome(tmp_path, monkeypatch, status):
    def call(*_, **__):
        os.remove(tmp_path / "1.log")
        return status

    monkeypatch.setattr(worker, "_execute", call)
    arguments = [], str(tmp_path), str(tmp_path / "1.log"), ("removed", [], [], {})
    if status == 0:
        assert worker.run(*arguments)["seconds"] >= 0.0
    else:
        with pytest.raises(worker.PartFailed, match="it ended with status 1"):
            worker.run(*arguments)


def prepare(name, *frames, resume=False):
    """Begins to write as a job of this name does."""
    job.Job._prepare(types.SimpleNamespace(name=name, arguments=types.SimpleNamespace(resume=resume)), frames)


@pytest.fixture(name="dead", params=["gone", "unnoticed", "later"])
def _dead(request):
    """What an owner's file says of a process that has ended, which its parent may not have noticed, or whose number another
    has."""
    if request.param == "later":
        yield {"begun": 1}
        return
    process = subprocess.Popen([sys.executable, "-c", ""])
    if request.param == "gone":
        process.wait()
    else:
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
    yield {"pid": process.pid}
    process.wait()


def owned(one, **changes):
    """Leaves the folder of a frame to a job. :returns: what its file says"""
    one.prepare("first")
    path = owner.path_of(one.folder)
    with open(path, encoding="utf-8") as file:
        told = dict(json.load(file), **changes)
    with open(path, "w", encoding="utf-8") as file:
        json.dump(told, file)
    return told


@pytest.mark.parametrize("resume", [False, True])
@pytest.mark.parametrize("host", ["", "elsewhere"])
def test_a_second_job_of_an_image_is_refused(tmp_path, host, resume):
    first, second = frame(tmp_path), frame(tmp_path)
    other = work.Frame(None, str(tmp_path / "b.exr"), cut.Cut(2), [])
    told = owned(first, **({"host": host, "pid": 1} if host else {}))
    (tmp_path / "a.exr.parts" / "1.part").write_text("")
    before = sorted(os.listdir(first.folder))
    with pytest.raises(CommandError) as refused:
        prepare("second", other, second, resume=resume)
    path = f"{first.folder}/{owner.NAME}"
    assert str(refused.value) == (f"process {told['pid']} on {told['host']} renders this image; "
                                  f"remove {path} if it has ended")
    for one in (other, second):  # as at the end of a job
        one.leave()
    assert sorted(os.listdir(first.folder)) == before and not os.path.exists(other.folder)
    first.leave()
    assert os.listdir(first.folder) == ["1.part"]
    prepare("second", second, resume=resume)
    assert sorted(os.listdir(first.folder)) == ["1.part", owner.NAME][0 if resume else 1:]


@pytest.mark.parametrize("resume", [False, True])
def test_the_folder_of_a_dead_job_is_taken_over(tmp_path, dead, resume):
    first, second = frame(tmp_path), frame(tmp_path)
    told = owned(first, **dead)
    if told["begun"] is None:
        pytest.skip("the system does not tell when a process began")
    (tmp_path / "a.exr.parts" / "1.part").write_text("")
    prepare("second", second, resume=resume)
    first.leave()  # what is another's stays
    with open(owner.path_of(first.folder), encoding="utf-8") as file:
        assert json.load(file)["job"] == "second"
    assert os.path.exists(second.part_file(cut.Part(1, second.cut))) is resume


def test_of_two_jobs_that_find_an_owner_dead_one_takes_over(tmp_path, dead, monkeypatch):
    first = frame(tmp_path)
    if owned(first, **dead)["begun"] is None:
        pytest.skip("the system does not tell when a process began")
    check, refused = owner._check, []

    def another_comes_after(place, job):
        check(place, job)
        if job == "second":
            with pytest.raises(CommandError, match="begins just now") as told:
                owner.take(first.folder, "third")
            refused.append(told)

    monkeypatch.setattr(owner, "_check", another_comes_after)
    owner.take(first.folder, "second")
    assert len(refused) == 1
    with open(owner.path_of(first.folder), encoding="utf-8") as file:
        assert json.load(file)["job"] == "second"


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"host": 5, "pid": 1, "job": "a"}', '{"host": "a", "pid": -1, "job": "a"}',
                                  "pipe", "folder"])
def test_an_owner_that_cannot_be_told_is_refused(tmp_path, text):
    one = frame(tmp_path)
    path = tmp_path / "a.exr.parts" / owner.NAME
    path.parent.mkdir()
    if text == "pipe":
        os.mkfifo(path)
    elif text == "folder":
        path.mkdir()
    else:
        path.write_text(text)
    with pytest.raises(CommandError, match=f"{path} does not tell whose it is; remove it"):
        prepare("second", one)
    one.leave()
    assert path.exists()


def test_a_job_is_refused_before_workers_are_asked_for(tmp_path):
    first, second = frame(tmp_path), frame(tmp_path)
    owned(first)
    one = types.SimpleNamespace(name="second", _waiting=lambda: ([work.Task(second, None)], [second]),
                                _on_workers=lambda *_: pytest.fail("workers were asked for"))
    with pytest.raises(CommandError, match="renders this image"):
        job.Job.run(one, [])


def test_an_owner_that_cannot_be_written_leaves_no_half_of_it(tmp_path, monkeypatch):
    one = frame(tmp_path)

    def fail(*_):
        raise OSError(errno.ENOSPC, "no space")

    monkeypatch.setattr(owner.os, "write", fail)
    with pytest.raises(CommandError, match=f"cannot write .*{owner.NAME}: no space") as failed:
        prepare("job", one)
    assert is_temporary(failed.value) and os.listdir(one.folder) == []
