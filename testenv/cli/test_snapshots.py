# SPDX-License-Identifier: Apache-2.0
"""Snapshots while a render runs, what --verbose tells, exit statuses, and the command that goes on."""
import json
import os
import shlex
import shutil
import signal
import subprocess
import sys

import numpy as np
import pytest

import _patina
from patina.cli import errors, frames, goOn, main, openStage, snapshots
from usda import prim, stage

STAGE = stage(prim("Sphere", "ball"), prim("DomeLight", "dome"), up="", startTimeCode=1, endTimeCode=4)
SHORT = ("-w", "32", "--samples", "64", "--maxDepth", "1")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "stage.usda").write_text(STAGE)
    monkeypatch.chdir(tmp_path)
    return tmp_path


class _Watched:
    """A renderer that calls `act` now and then while a render has samples, which end when it says so."""

    def __init__(self, renderer, act):
        self._renderer, self._act = renderer, act

    def __getattr__(self, name):
        return getattr(self._renderer, name)

    def wait(self, _seconds):
        done = self._renderer.wait(0.001)
        if self._renderer.progress()["samplesDone"] > 0:
            self._act(self)
        return done


def watched(monkeypatch, act):
    make = _patina.make_renderer
    monkeypatch.setattr(_patina, "make_renderer", lambda backend: _Watched(make(backend), act))


def signalled(monkeypatch):
    """Each render is asked for a snapshot by a signal."""
    begin = snapshots.Snapshots.begin

    def asked(self, write):
        begin(self, write)
        os.kill(os.getpid(), signal.SIGUSR1)

    watched(monkeypatch, lambda _: None)
    monkeypatch.setattr(snapshots.Snapshots, "begin", asked)


def pixels(path):
    return np.array(_patina.read_image(str(path)).pixels)


def test_snapshots_are_whole_images_and_go_with_the_render(folder, monkeypatch):
    seen = []

    def look(_):
        if os.path.exists("a_part.exr"):
            image = _patina.read_image("a_part.exr")
            seen.append((image.width, image.metadata["patina:samples"], image.metadata["patina:snapshot"]))
            assert np.isfinite(np.array(image.pixels)).all() and np.array(image.pixels)[0, 0, 0] == pytest.approx(1.0)

    watched(monkeypatch, look)
    long = ("-w", "32", "--samples", "512", "--maxDepth", "1", "--quiet")
    assert main.main(["record", "stage.usda", "a.exr", *long, "--snapshot", "0.01"]) == 0
    assert seen and all(width == 32 and 1.0 <= samples <= 512.0 and mark == 1 for width, samples, mark in seen)
    assert sorted(os.listdir()) == ["a.exr", "stage.usda"]
    assert main.main(["record", "stage.usda", "b.exr", *long]) == 0
    assert np.array_equal(pixels("a.exr"), pixels("b.exr"))  # looking changes no bit


@pytest.mark.parametrize("flags", [("--tolerance", "0.01", "--samples", "256"), ("--backend", "raster", "--samples", "12")],
                         ids=("adaptive", "raster"))
def test_looking_changes_no_bit(folder, monkeypatch, flags):
    seen = []
    watched(monkeypatch, lambda _: seen.append(os.path.exists("a_part.exr")))
    arguments = ("-w", "32", "--quiet", *flags)
    assert main.main(["record", "stage.usda", "a.exr", *arguments, "--snapshot", "0.001"]) == 0
    assert main.main(["record", "stage.usda", "b.exr", *arguments]) == 0
    assert any(seen) and np.array_equal(pixels("a.exr"), pixels("b.exr"))


def test_a_signal_asks_for_a_snapshot(folder, monkeypatch):
    before, taken = signal.getsignal(signal.SIGUSR1), []
    write = snapshots.Snapshots.look
    opened = openStage.open_stage

    def early(*arguments):
        os.kill(os.getpid(), signal.SIGUSR1)
        return opened(*arguments)

    monkeypatch.setattr(openStage, "open_stage", early)

    def look(self, renderer, film):
        assert write(self, renderer, film) is None
        if os.path.exists("a.now.png"):  # the first, or the next that is asked for
            os.remove("a.now.png")
            taken.append(1)
            os.kill(os.getpid(), signal.SIGUSR1)

    monkeypatch.setattr(snapshots.Snapshots, "look", look)
    watched(monkeypatch, lambda _: None)
    assert main.main(["record", "stage.usda", "a.png", "-w", "64", "--samples", "512", "--maxDepth", "1", "--quiet",
                      "--snapshotSuffix", ".now"]) == 0
    assert len(taken) > 1 and signal.getsignal(signal.SIGUSR1) == before


def test_a_snapshot_that_cannot_be_written_is_told_and_the_render_goes_on(folder, monkeypatch, capsys):
    def fail(*_):
        raise RuntimeError("cannot write 'a_part.exr': its folder has gone")

    monkeypatch.setattr("patina.cli.record._Job._write_snapshot", fail)
    watched(monkeypatch, lambda _: None)
    small = ("-w", "64", "--samples", "256", "--maxDepth", "1")
    assert main.main(["record", "stage.usda", "a.exr", *small, "--snapshot", "0.001"]) == 0
    assert "no snapshot: cannot write 'a_part.exr': its folder has gone" in capsys.readouterr().err
    assert pixels("a.exr").shape[1] == 64


def test_a_snapshot_never_takes_the_place_of_another_image(folder, capsys):
    (folder / "a_part.exr").mkdir()
    assert main.main(["record", "stage.usda", "a.exr", *SHORT, "--snapshot", "1"]) == 1
    assert "a_part.exr" in capsys.readouterr().err and not os.path.exists("a.exr")
    assert main.main(["record", "stage.usda", "a.exr", *SHORT, "--snapshot", "1", "--snapshotSuffix", "a/b"]) == 2


def test_only_snapshots_that_were_written_are_removed(folder, monkeypatch):
    (folder / "a_part.exr").write_text("somebody's")
    assert main.main(["record", "stage.usda", "a.exr", *SHORT, "--quiet", "--snapshot", "3600"]) == 0
    assert (folder / "a_part.exr").read_text() == "somebody's"
    signalled(monkeypatch)
    assert main.main(["record", "stage.usda", "b.exr", *SHORT, "--quiet"]) == 0
    assert sorted(os.listdir()) == ["a.exr", "a_part.exr", "b.exr", "stage.usda"]  # one that a signal asked for goes too


def test_a_snapshot_takes_no_name_of_another_frames_image(folder, monkeypatch, capsys):
    flags = (*SHORT, "--snapshotSuffix", "0", "--frames", "10,1")
    assert main.main(["record", "stage.usda", "a.#.exr", *flags, "--snapshot", "1"]) == 1
    assert "cannot write 'a.10.exr': it is a snapshot's name" in capsys.readouterr().err
    assert os.listdir() == ["stage.usda"]
    signalled(monkeypatch)
    assert main.main(["record", "stage.usda", "a.#.exr", *flags]) == 0
    assert "no snapshot: cannot write 'a.10.exr'" in capsys.readouterr().err
    assert pixels("a.10.exr").shape[1] == 32 and pixels("a.1.exr").shape[1] == 32


def test_a_snapshot_by_signal_is_not_written_over_an_input(folder, monkeypatch, capsys):
    _patina.write_image("a_part.png", np.ones((2, 2, 3), np.float32))
    before = (folder / "a_part.png").read_bytes()
    (folder / "stage.usda").write_text(STAGE.replace('"dome"\n{', '"dome"\n{\n    asset inputs:texture:file = @a_part.png@'))
    signalled(monkeypatch)
    assert main.main(["record", "stage.usda", "a.png", *SHORT]) == 0
    assert "no snapshot: cannot write 'a_part.png': this command reads" in capsys.readouterr().err
    assert (folder / "a_part.png").read_bytes() == before


def test_verbose_tells_time_and_memory_of_each_phase(folder, capsys):
    assert main.main(["record", "stage.usda", "a.exr", *SHORT, "--verbose", "--json=s.json"]) == 0
    lines = capsys.readouterr().err.splitlines()
    rows = {words[0]: words for words in map(str.split, lines) if len(words) > 2 and words[0] in (
        "read", "translate", "build", "sample", "write", "all")}
    assert list(rows) == ["read", "translate", "build", "sample", "write", "all"]
    assert "64 samples per pixel" in " ".join(rows["sample"])
    with open("s.json") as file:
        frame = json.load(file)["frames"][0]
    assert set(frame["memory"]) >= {"open", "translate", "build", "render", "write"}
    assert all(size is None or size > 1 << 20 for size in frame["memory"].values())
    assert main.main(["record", "stage.usda", "a.exr", "--verbose", "--quiet"]) == 2


def test_temporary_failures_have_a_status_of_their_own(folder, monkeypatch, capsys):
    progress = {"failed": True, "error": "out of memory", "temporary": True, "deviceFailed": False, "samplesDone": 0}

    class Failing:
        def __init__(self, temporary):
            self.state = dict(progress, temporary=temporary, statistics={}, backend="embree")

        def __getattr__(self, name):
            return lambda *_: True if name == "wait" else self.state

    for temporary, status in ((True, 75), (False, 1)):
        monkeypatch.setattr(_patina, "make_renderer", lambda backend, t=temporary: Failing(t))
        assert main.main(["record", "stage.usda", "a.exr", *SHORT]) == status
        assert "out of memory" in capsys.readouterr().err


@pytest.mark.parametrize("error, temporary", [
    (MemoryError(), True), (OSError(28, "full"), True), (OSError(2, "none"), False), (_patina.TemporaryFailure("full"), True),
    (RuntimeError("x"), False), (errors.CommandError("x"), False), (errors.TemporaryError("x"), True)])
def test_which_errors_may_pass(error, temporary):
    assert errors.is_temporary(error) is temporary
    outer = errors.CommandError("outer")
    outer.__cause__ = error
    assert errors.is_temporary(outer) is temporary


def test_a_full_disk_is_temporary(folder):
    """On a real one of 64 kB, which only a namespace of its own may mount."""
    unshare = shutil.which("unshare")
    own = [unshare, "--user", "--map-root-user", "--mount"] if unshare else []
    if not unshare or subprocess.run([*own, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True).returncode != 0:
        pytest.skip("no namespace in which a small disk could be mounted")
    (folder / "small").mkdir()
    record = shlex.join([sys.executable, "-m", "patina", "record", "stage.usda", "small/a.exr", "-w", "256", "--samples", "1",
                         "--quiet", "--compression", "none", "--checkpointSeconds", "0"])
    done = subprocess.run([*own, "sh", "-c", f"mount -t tmpfs -o size=64k none small && {record}; s=$?; ls -A small; exit $s"],
                          capture_output=True, text=True,
                          env=dict(os.environ, PYTHONPATH=os.pathsep.join(filter(None, sys.path))))  # from another folder
    assert done.returncode == 75 and "No space left on device" in done.stderr and len(done.stderr.splitlines()) == 1, done
    assert done.stdout == ""  # nothing is left behind


@pytest.mark.parametrize("times, spec", [
    ([1.0], "1"), ([3.0, 4.0, 5.0], "3:5"), ([1.0, 4.0, 7.0], "1:7x3"), ([1.0, 2.0], "1,2"), ([7.0, 1.0, 2.0, 3.0], "7,1:3"),
    ([5.0, 4.0, 3.0], "5:3"), ([1.0, 1.5, 2.0], "1:2x0.5"), ([20.0, 21.0, 22.0, 40.0], "20:22,40"),
    ([-2.0, -1.0, 0.0], "-2:0")])
def test_the_frames_that_are_left_as_a_spec(times, spec):
    assert frames.spec_of(times) == spec
    assert frames.expand(spec, 0.0, 0.0)[0] == pytest.approx(times)


def test_the_command_that_goes_on_is_ready_for_a_shell(monkeypatch):
    class Arguments:
        argv = ["record", "a stage.usda", "a.##.png", "--frames", "1:10x3", "-f=2"]
        frames = "1:10x3"

    monkeypatch.setenv("PATINA_COMMAND", "./patina")
    words = shlex.split(goOn.command(Arguments, [4.0, 7.0, 10.0]))
    assert words[:4] == ["./patina", "record", "a stage.usda", "a.##.png"] and words[-3:] == ["--frames", "4:10x3", "--resume"]
    assert "1:10x3" not in words


def test_an_interrupted_sequence_goes_on_by_the_command_that_it_prints(folder, monkeypatch, capsys):
    whole = ("--frames", "1:4", "-w", "24", "--samples", "256", "--maxDepth", "1", "--quiet")
    assert main.main(["record", "stage.usda", "whole.#.exr", *whole]) == 0
    count = []

    def end(renderer):
        if len({round(n) for n in count}) < 1 and os.path.exists("a.2.exr"):  # in the third frame
            count.append(1)
            os.kill(os.getpid(), signal.SIGTERM)

    monkeypatch.delenv("PATINA_COMMAND", raising=False)
    with monkeypatch.context() as inner:
        watched(inner, end)
        assert main.main(["record", "stage.usda", "a.#.exr", *whole]) == 75
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    command = shlex.split(said.partition("--resume continues: ")[2])
    assert command[0] == "patina" and command[command.index("--frames") + 1] == "3,4"
    assert main.main(command[1:]) == 0
    for frame in range(1, 5):
        assert np.array_equal(pixels(f"a.{frame}.exr"), pixels(f"whole.{frame}.exr"))


def test_a_render_leaves_no_stage_open(tmp_path, monkeypatch):
    """Whoever renders the file again, in the same process, finds what it says by then."""
    import gc

    from pxr import Sdf

    monkeypatch.chdir(tmp_path)
    (tmp_path / "own.usda").write_text(STAGE)
    gc.disable()  # a cycle of objects would be found at any time
    try:
        assert main.main(["record", "own.usda", "a.exr", *SHORT, "--quiet"]) == 0
        assert Sdf.Layer.Find("own.usda") is None
    finally:
        gc.enable()
