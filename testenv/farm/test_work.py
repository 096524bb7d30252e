# SPDX-License-Identifier: Apache-2.0
"""The files that a job removes, the commands that it sends, and how it tells a failure that may pass."""
import concurrent.futures
import os
import time
import types

import pytest

import _patina
import patina
from patina.cli.errors import CommandError
from patina.farm import cut, identity, sender, work, worker


def frame(folder, tiles=2):
    return work.Frame(None, str(folder / "a.exr"), cut.Cut(tiles), [])


def test_what_is_not_the_jobs_own_stays(tmp_path):
    one = frame(tmp_path)
    one.prepare()
    own = ["1.part", "12.part", "2.log", "image.log", "3.20250101-101500.77.failed.log", "image.20250101-101500.7.failed.log"]
    others = ["7.2.part", "stage.usda", "notes.log", "kept.failed.log", "1.part.txt"]
    for name in own + others:
        (tmp_path / "a.exr.parts" / name).write_text("")
    one.forget()
    assert sorted(os.listdir(one.folder)) == sorted(others)
    for name in others:
        os.remove(os.path.join(one.folder, name))
    one.forget()
    assert not os.path.exists(one.folder)
    one.forget()  # nothing is there


def test_an_input_among_the_parts_is_refused(tmp_path):
    one = frame(tmp_path)
    one.check([str(tmp_path / "stage.usda"), str(tmp_path / "a.exr.partsOfOthers" / "b.png")])
    with pytest.raises(CommandError, match="b.png lies in .*a.exr.parts"):
        one.check([str(tmp_path / "a.exr.parts" / "deep" / "b.png")])


def test_a_worker_leaves_no_image_of_fewer_samples(tmp_path):
    assert "--onlyWhole" in work.Task(frame(tmp_path, 1), None).arguments(["stage.usda", "a.exr"], 0)


def test_what_a_job_has_kept_is_known_by_its_files(tmp_path):
    one = frame(tmp_path)
    now = time.time()
    assert not one.kept(now - 60)
    one.prepare()
    (tmp_path / "a.exr.parts" / "2.part").write_text("")
    assert one.kept(now - 60) and not one.kept(now + 60)


def test_the_folder_of_commands_is_looked_at(tmp_path):
    assert worker.check("home", [], [], None, str(tmp_path / "none")) == [f"cannot enter {tmp_path / 'none'}"]


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


@pytest.mark.parametrize("passing", [True, False])
def test_reasons_that_may_pass_are_known(tmp_path, passing):
    one = frame(tmp_path, 1)
    failed = [worker.PartFailed("why", "tcp://1", passing) for _ in range(work.TRIES)]
    sent = sender.Sender(Client(*failed), [], str(tmp_path), (), 0)
    sent.run([one], one.tasks(set()), lambda _: None)
    assert [task.passing for task in sent.failed] == [passing] and not sent.lost


class KilledWorker(Exception):
    """Known by its name, as Dask's own is."""


@pytest.mark.parametrize("losses, failures, given_up", [(work.LOSSES - 1, work.TRIES - 1, False), (work.LOSSES, 0, True),
                                                        (3, work.TRIES, True)])
def test_workers_that_die_are_no_fault_of_a_part(tmp_path, losses, failures, given_up):
    one = frame(tmp_path, 1)
    errors = [KilledWorker("died")] * losses + [worker.PartFailed("why", "tcp://1", False)] * failures
    client = Client(*errors, {"worker": "one", "host": "here", "seconds": 1.0})
    sent = sender.Sender(client, [], str(tmp_path), (), 0)
    sent.run([one], one.tasks(set()), lambda _: None)
    assert bool(sent.failed) is given_up and bool(sent.written) is not given_up
    assert len(client.errors) == given_up, "given up at once, or sent until it is done"


def test_a_scheduler_that_dies_ends_the_job_in_words(tmp_path):
    one = frame(tmp_path, 1)
    sent = sender.Sender(Client(None), [], str(tmp_path), (), 0)
    sent.run([one], one.tasks(set()), lambda _: None)
    assert "the scheduler is lost (CancelledError" in sent.lost and not sent.written


def test_which_statuses_may_pass(tmp_path, monkeypatch):
    for status, passing in ((75, True), (1, False), (-9, True), (-11, False)):
        monkeypatch.setattr(worker, "subprocess", types.SimpleNamespace(call=lambda *_, **__: status, DEVNULL=None))
        with pytest.raises(worker.PartFailed) as failed:
            worker.run([], str(tmp_path), str(tmp_path / "1.log"), ("statuses", [], [], None))
        assert failed.value.args[2] is passing


def test_commands_run_with_the_senders_variables(tmp_path, monkeypatch):
    monkeypatch.setenv("OCIO", "/a/workers/own.ocio")
    seen = {}
    monkeypatch.setattr(worker.subprocess, "call", lambda *_, env, **__: seen.update(env) or 0)
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
    paths = [os.path.dirname(os.path.dirname(patina.__file__)), os.path.dirname(_patina.__file__)]
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
