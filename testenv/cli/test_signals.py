# SPDX-License-Identifier: Apache-2.0
"""Ctrl+C, the end of a job and of a terminal: nothing is left behind, nothing that was rendered is lost."""
import os
import signal
import subprocess
import sys
import time

import pytest

import _patina
from patina.cli import checkpoints, interrupts, main, record, snapshots
from usda import prim, stage

STAGE = stage(prim("Sphere", "ball"), prim("DomeLight", "dome"), up="")
LONG = ("-w", "64", "--samples", "65536", "--maxDepth", "1", "--quiet")
SHORT = ("-w", "16", "--samples", "4", "--maxDepth", "1", "--quiet")  # where a test that fails renders all of it


@pytest.fixture(name="folder")
def _folder(tmp_path, monkeypatch):
    (tmp_path / "stage.usda").write_text(STAGE)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def send(number):
    """Sends a signal to this process, and waits until it is handled."""
    os.kill(os.getpid(), number)
    for _ in range(100000):
        pass


@pytest.fixture(name="renderers")
def _renderers(monkeypatch):
    """:returns: function of a class and its arguments, which then stands around each renderer"""
    make = _patina.make_renderer

    def stand(around, *arguments):
        monkeypatch.setattr(_patina, "make_renderer", lambda backend: around(make(backend), *arguments))

    return stand


class _Signals:
    """Sends a signal to this process as soon as a render has samples."""

    def __init__(self, renderer, number, times=1):
        self._renderer, self._number, self._times = renderer, number, times

    def __getattr__(self, name):
        return getattr(self._renderer, name)

    def wait(self, seconds):
        if self._number and self._renderer.progress()["samplesDone"] > 0:
            for _ in range(self._times):
                os.kill(os.getpid(), self._number)
            self._number = 0
        return self._renderer.wait(seconds)


@pytest.mark.parametrize("number", interrupts.NUMBERS, ids=lambda number: number.name)
def test_a_signal_while_rendering_saves_image_and_checkpoint(number, folder, renderers, monkeypatch, capsys):
    renderers(_Signals, number)
    monkeypatch.delenv("PATINA_COMMAND", raising=False)
    before = [signal.getsignal(n) for n in interrupts.NUMBERS]
    assert main.main(["record", "stage.usda", "a.exr", *LONG]) == 75
    said = capsys.readouterr().err
    assert said == f"patina: interrupted; --resume continues: patina record stage.usda a.exr {' '.join(LONG)} --resume\n"
    assert sorted(os.listdir()) == ["a.exr", "a.exr.checkpoint", "stage.usda"]
    film = _patina.Film()
    film.load_checkpoint("a.exr.checkpoint")
    assert film.resolve("sampleCount").min() > 0
    assert [signal.getsignal(n) for n in interrupts.NUMBERS] == before


def test_only_whole_images_are_written_where_that_is_asked_for(folder, renderers, capsys):
    renderers(_Signals, signal.SIGTERM)
    assert main.main(["record", "stage.usda", "a.exr", *LONG, "--onlyWhole"]) == 75
    assert "it is not written; --resume continues" in capsys.readouterr().err
    assert sorted(os.listdir()) == ["a.exr.checkpoint", "stage.usda"]


class _SignalsAtTheEnd(_Signals):
    """Sends the signal when the last sample is done."""

    def wait(self, seconds):
        while not self._renderer.wait(seconds):
            pass
        os.kill(os.getpid(), self._number)
        return True


def test_a_signal_with_the_last_sample_of_a_frame_keeps_that_and_begins_no_other(folder, renderers, capsys):
    renderers(_SignalsAtTheEnd, signal.SIGTERM)
    assert main.main(["record", "stage.usda", "a.####.exr", "-f", "1:3", *SHORT]) == 75
    assert "--frames 2,3 " in capsys.readouterr().err and sorted(os.listdir()) == ["a.0001.exr", "stage.usda"]
    assert main.main(["record", "stage.usda", "a.exr", *SHORT]) == 0  # nothing is left to do


class _NeverStarts(_Signals):
    """A renderer that builds for as long as it is let."""

    def start(self, *_):
        pass

    def wait(self, _):
        os.kill(os.getpid(), self._number)
        return False


def test_nothing_is_promised_where_nothing_is_saved(folder, renderers, capsys):
    renderers(_NeverStarts, signal.SIGTERM)
    assert main.main(["record", "stage.usda", "a.exr", *LONG]) == 75
    assert capsys.readouterr().err == "patina: interrupted before there were samples; nothing is saved\n"
    assert os.listdir() == ["stage.usda"]


@pytest.mark.parametrize("number, said", [(signal.SIGINT, "interrupted"), (signal.SIGTERM, "terminated"),
                                          (signal.SIGHUP, "ended with its terminal")])
def test_a_signal_outside_of_rendering_tidies_up(number, said, folder, monkeypatch, capsys):
    """As it comes to any command: here while it writes a file beside others."""
    from patina.cli import explain, outputs

    def write(_):
        with outputs.writing("out.txt") as file:
            file.write("half")
            send(number)

    monkeypatch.setattr(explain, "run", write)
    assert main.main(["explain", "m.mtlx"]) == 1
    assert capsys.readouterr().err == f"patina: {said}\n"
    assert os.listdir() == ["stage.usda"]


@pytest.mark.parametrize("dropped", ("open_stage", "_translate"))
def test_a_signal_that_a_library_drops_ends_the_command(dropped, folder, monkeypatch, capsys):
    """An import of pxr prints the exception as an error of its own and goes on."""
    from patina.cli import openStage

    owner = openStage if dropped == "open_stage" else record._Job
    name = "_open" if dropped == "open_stage" else dropped
    run = getattr(owner, name)

    def swallow(*arguments):
        try:
            send(signal.SIGTERM)
        except KeyboardInterrupt:
            pass
        return run(*arguments)

    monkeypatch.setattr(owner, name, swallow)
    assert main.main(["record", "stage.usda", "a.png", *SHORT]) == 75
    assert capsys.readouterr().err == "patina: terminated\n"
    assert os.listdir() == ["stage.usda"]


@pytest.mark.parametrize("number", interrupts.NUMBERS, ids=lambda number: number.name)
def test_imports_end_before_the_command_does(number, folder, monkeypatch, capfd):
    """pxr prints exceptions that come into its imports, with their tracebacks."""
    from patina.cli import explain

    (folder / "slowLibrary.py").write_text(f"""import os, time
try:
    os.kill(os.getpid(), {int(number)})
    time.sleep(0.1)
except KeyboardInterrupt:
    print("Traceback of a library")
whole = True
""")
    monkeypatch.syspath_prepend(str(folder))
    went_on = []

    def load(_):
        import slowLibrary

        assert slowLibrary.whole
        time.sleep(5)
        went_on.append(True)

    monkeypatch.setattr(explain, "run", load)
    before = [signal.getsignal(n) for n in (*interrupts.NUMBERS, signal.SIGALRM)]
    try:
        assert main.main(["explain", "m.mtlx"]) == 1
    finally:
        sys.modules.pop("slowLibrary", None)
    said = capfd.readouterr()
    assert said.out == "" and said.err.startswith("patina: ") and len(said.err.splitlines()) == 1
    assert not went_on
    assert [signal.getsignal(n) for n in (*interrupts.NUMBERS, signal.SIGALRM)] == before


@pytest.mark.parametrize("ended_by", ("check", "another error"))
def test_one_signal_ends_a_command_once(ended_by, folder, monkeypatch, capfd):
    """A signal that came into an import is still due when the command has ended: the report takes longer than that."""
    from patina.cli import explain

    (folder / "slowImport.py").write_text(f"""import os
os.kill(os.getpid(), {int(signal.SIGTERM)})
for _ in range(1000):
    pass
""")
    monkeypatch.syspath_prepend(str(folder))

    def run(_):
        import slowImport  # noqa: F401

        if ended_by == "check":
            interrupts.Endings.check()
        raise OSError("a library's own")

    failed = main._failed

    def slow(*arguments):
        time.sleep(3 * interrupts.Endings._POLL_SECONDS)
        return failed(*arguments)

    monkeypatch.setattr(explain, "run", run)
    monkeypatch.setattr(main, "_failed", slow)
    try:
        assert main.main(["explain", "m.mtlx"]) == 1
    finally:
        sys.modules.pop("slowImport", None)
    assert capfd.readouterr().err == "patina: terminated\n"


# In the place of a module of Python that the command line imports first.
ARGPARSE = """import importlib.machinery, os, sys
sys.modules["patina.cli.interrupts"].ONCE_SECONDS = 3600.0
for _ in range(2):  # as `timeout` sends it
    os.kill(os.getpid(), int(os.environ["EARLY"]))
sys.path.remove(os.path.dirname(__file__))
spec = importlib.machinery.PathFinder.find_spec("argparse")
spec.loader.exec_module(sys.modules["argparse"])
"""


@pytest.mark.parametrize("launched", (False, True), ids=("python", "held"))
@pytest.mark.parametrize("number, status, said", [
    (signal.SIGINT, 75, "patina: interrupted\n"), (signal.SIGTERM, 75, "patina: terminated\n"),
    (signal.SIGUSR1, 2, "patina record: ")], ids=("SIGINT", "SIGTERM", "SIGUSR1"))
def test_a_signal_before_there_is_a_command(number, status, said, launched, folder):
    """It comes while Python imports the command, or while Python starts: the launcher holds it until it is heard."""
    command, variables = [sys.executable, "-m", "patina", "record"], dict(os.environ, EARLY="0")
    if launched:
        command = [sys.executable, "-c", "import os, signal, sys; signal.pthread_sigmask(signal.SIG_BLOCK, [1, 2, 15, 10]); "
                   f"os.kill(os.getpid(), {int(number)}); os.execv(sys.argv[1], sys.argv[1:])", *command]
    else:
        (folder / "early").mkdir()
        (folder / "early" / "argparse.py").write_text(ARGPARSE)
        variables.update(EARLY=str(int(number)), PYTHONPATH=f"{folder / 'early'}:{os.environ['PYTHONPATH']}")
    done = subprocess.run(command, env=variables, capture_output=True, text=True, timeout=60)
    assert done.returncode == status and done.stderr.startswith(said), done.stderr


def test_a_snapshot_that_is_asked_for_early_is_taken(monkeypatch):
    before = {n: signal.getsignal(n) for n in (*interrupts.NUMBERS, signal.SIGUSR1)}
    try:
        interrupts.begin(["record"])
        os.kill(os.getpid(), signal.SIGUSR1)
        with snapshots.Snapshots(0.0) as asked:
            assert asked._asked
        with snapshots.Snapshots(0.0) as asked:
            assert not asked._asked
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def test_a_signal_waits_for_what_is_not_to_be_left_half_way():
    done = []
    with interrupts.Endings(), pytest.raises(KeyboardInterrupt):
        with interrupts.held():
            send(signal.SIGTERM)
            done.append("whole")
    assert done == ["whole"]


def test_ignored_signals_stay_ignored(folder):
    """As nohup wants it."""
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with interrupts.Endings() as endings, interrupts.Interrupts() as met:
            os.kill(os.getpid(), signal.SIGHUP)
            time.sleep(0.01)
            assert not endings.met and not met.met
    finally:
        signal.signal(signal.SIGHUP, before)


def test_temporary_folders_go_with_the_process(folder, tmp_path):
    """A package's textures lie in one; SIGTERM comes when they do, and no render runs."""
    program = """
import os, signal, sys
from patina.cli import explain, main
from patina.stage import assets, compat
def run(_):
    compat.read_asset = lambda path: b"data"
    assert assets.extract("a.usdz[b.png]").startswith(os.environ["TMPDIR"])
    os.kill(os.getpid(), signal.SIGTERM)
    for _ in range(100000): pass
explain.run = run
sys.exit(main.main(["explain", "m.mtlx"]))
"""
    place = tmp_path / "temporary"
    place.mkdir()
    done = subprocess.run([sys.executable, "-c", program], env={**os.environ, "TMPDIR": str(place)}, capture_output=True,
                          text=True, timeout=60)
    assert (done.returncode, done.stderr) == (1, "patina: terminated\n")
    assert os.listdir(place) == []


def test_what_a_killed_render_has_left_is_told_used_and_removed(folder, capsys):
    process = subprocess.Popen([sys.executable, "-m", "patina", "record", "stage.usda", "a.exr", *LONG, "--checkpointSeconds",
                                "0.01"])
    end = time.monotonic() + 60
    while not os.path.exists("a.exr.checkpoint") and time.monotonic() < end:
        time.sleep(0.01)
    process.kill()
    process.wait()
    left = f".a.exr.{process.pid}-99999.checkpoint"  # as if it had been killed while it wrote one
    open(left, "w").close()
    image = f".a.{process.pid}-99999.exr"
    open(image, "w").close()
    assert os.path.exists("a.exr.checkpoint")
    few = ("-w", "64", "--samples", "1", "--maxDepth", "1")
    assert main.main(["record", "stage.usda", "a.exr", *few, "--keepCheckpoint"]) == 0
    assert "a.exr.checkpoint of an earlier render is given up (--resume would have continued it)" in capsys.readouterr().err
    assert sorted(os.listdir()) == ["a.exr", "a.exr.checkpoint", "stage.usda"]
    assert main.main(["record", "stage.usda", "a.exr", *few, "--resume"]) == 0
    assert "given up" not in capsys.readouterr().err
    assert sorted(os.listdir()) == ["a.exr", "stage.usda"]


def test_a_disk_that_is_full_for_checkpoints_does_not_end_a_render(folder, monkeypatch, capsys):
    monkeypatch.setattr(checkpoints, "path_of", lambda image: "/dev/null/a.checkpoint")
    monkeypatch.setattr(checkpoints, "remove", lambda path: None)
    monkeypatch.setattr(record._Job, "_check_outputs", lambda *_: None)
    assert main.main(["record", "stage.usda", "a.exr", "-w", "16", "--samples", "64", "--checkpointSeconds", "1e-9"]) == 0
    assert "cannot write '/dev/null/a.checkpoint'" in capsys.readouterr().err
    assert _patina.read_image("a.exr").width == 16
