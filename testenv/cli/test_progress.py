"""What a render says of itself while it lasts."""
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


def test_while_the_driver_compiles_it_says_how_far_it_is(monkeypatch):
    compiling = {"materialsReady": 12.0, "materialsWanted": 47.0}
    assert shown(monkeypatch, statistics=compiling, secondsLeft=20.0) == (
        "shot.exr: compiled 12 of 47 materials, about 20 s left\n")
    assert shown(monkeypatch, statistics=compiling) == "shot.exr: compiled 12 of 47 materials\n"
    ready = {"materialsReady": 47.0, "materialsWanted": 47.0}
    assert shown(monkeypatch, statistics=ready) == "shot.exr: preparing for 25 s\n"
    assert shown(monkeypatch, statistics={**ready, "materialsDrawn": 3.0}) == (
        "shot.exr: preparing for 25 s, drawn 3 of 47 materials\n")
