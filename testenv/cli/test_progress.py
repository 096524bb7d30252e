# SPDX-License-Identifier: Apache-2.0
"""The progress that a render tells while it lasts."""
import io

from patina.cli import progress


def shown(monkeypatch, **state):
    """:returns: what stands on standard error 25 seconds after the start"""
    clock = [100.0]
    monkeypatch.setattr(progress.time, "monotonic", lambda: clock[0])
    stream = io.StringIO()
    line = progress.Progress("shot.exr", stream=stream)
    clock[0] += 25.0
    line.show({"fraction": 0.0, "samplesDone": 0, "secondsLeft": 0.0, **state})
    return stream.getvalue()


def test_before_the_first_sample_it_says_that_it_prepares(monkeypatch):
    assert shown(monkeypatch) == "shot.exr: preparing for 25 s\n"


def test_then_it_says_what_is_done_and_left(monkeypatch):
    assert shown(monkeypatch, fraction=0.25, samplesDone=16, secondsLeft=75.0) == "shot.exr:  25 %  16 samples  1:15 min left\n"


def test_with_a_tolerance_it_says_how_far_the_noise_is(monkeypatch):
    state = dict(fraction=0.25, samplesDone=16, samplesMean=533.7, secondsLeft=75.0, noise=0.123, noiseWanted=0.1)
    assert shown(monkeypatch, **state) == (
        "shot.exr:  25 %  noise 12 %, 10 % is asked for  533.7 samples  1:15 min left\n")
    assert "noise" not in shown(monkeypatch, **{**state, "noise": -1.0}), "nobody has looked yet"
    assert "denoised error 5 %, 10 % is" in shown(monkeypatch, **state, statistics={"denoisedError": 0.05})


def stepped(monkeypatch, stream):
    clock = [100.0]
    monkeypatch.setattr(progress.time, "monotonic", lambda: clock[0])
    line = progress.Progress("check", stream=stream)
    clock[0] += 25.0
    line.step(1, 6, "material 2 of 6, gold")
    clock[0] += 1.0
    line.step(2, 6, "material 3 of 6, iron")
    return stream.getvalue()


def test_steps_tell_the_time_that_is_left(monkeypatch):
    text = stepped(monkeypatch, io.StringIO())
    assert text == "check:  17 %  2:05 min left  material 2 of 6, gold\n"  # 25 s for each of five; the next is too soon


def test_a_line_never_wraps_on_a_terminal(monkeypatch):
    monkeypatch.setenv("COLUMNS", "50")
    stream = io.StringIO()
    stream.isatty = lambda: True
    progress.Progress("check", stream=stream).step(0, 6, "material 1 of 6, " + "x" * 200)
    assert len(stream.getvalue()) == len("\r\033[K") + 49
    monkeypatch.setenv("COLUMNS", "80")
    stream.truncate(stream.seek(0))
    progress.Progress("/a/" + "b" * 100 + "/shot.exr", stream=stream).show({"fraction": 0.5, "samplesDone": 16,
                                                                            "secondsLeft": 9.0})
    assert len(stream.getvalue()) == len("\r\033[K") + 79 and "/shot.exr [" in stream.getvalue()
    assert stream.getvalue().endswith(" 50 %  16 samples  9 s left")


def test_steps_move_on_a_terminal(monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    stream = io.StringIO()
    stream.isatty = lambda: True
    progress.Progress("check", stream=stream).step(0, 6, "material 1 of 6, clay")
    assert stream.getvalue().endswith("  0 %  material 1 of 6, clay")  # at once
    stream.truncate(stream.seek(0))
    text = stepped(monkeypatch, stream)
    assert text.count("\r\033[K") == 2 and text.endswith(" 33 %  52 s left  material 3 of 6, iron") and "\n" not in text


def test_while_the_driver_compiles_it_says_how_far_it_is(monkeypatch):
    compiling = {"materialsReady": 12.0, "materialsWanted": 47.0}
    assert shown(monkeypatch, statistics=compiling, secondsLeft=20.0) == (
        "shot.exr: compiled 12 of 47 materials, about 20 s left\n")
    assert shown(monkeypatch, statistics=compiling) == "shot.exr: compiled 12 of 47 materials\n"
    ready = {"materialsReady": 47.0, "materialsWanted": 47.0}
    assert shown(monkeypatch, statistics=ready) == "shot.exr: preparing for 25 s\n"
    assert shown(monkeypatch, statistics={**ready, "materialsDrawn": 3.0}) == (
        "shot.exr: preparing for 25 s, drawn 3 of 47 materials\n")
