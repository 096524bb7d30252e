# SPDX-License-Identifier: Apache-2.0
"""The conformance run tells how each way ends, goes on after stages that fail, and sees hosts that disagree."""
import os
import sys

import numpy as np
import pytest

import agreement
import conformanceResults
import found
import hydraBuild
import page
import peers
import run
import watched
import ways
from usda import mesh, prim, stage

TRIANGLE = stage(
    mesh("triangle", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], scheme="", meta=("prepend references = @paint.usda@</paint>",)),
    up="")
PAINT = stage(prim("", "paint", color=(1, 0, 0)), up="")


def write(folder, **texts):
    for name, text in texts.items():
        (folder / f"{name}.usda").write_text(text, encoding="utf-8")


def test_a_run_goes_on_after_what_fails(tmp_path, capsys):
    stages, output = tmp_path / "stages", tmp_path / "output"
    stages.mkdir()
    write(stages, triangle=TRIANGLE, paint=PAINT, broken='#usda 1.0\ndef Mesh "triangle" {', nothing="#usda 1.0\n")
    arguments = [str(stages), "--output", str(output), "--size", "16x12", "--samples", "1", "--ways",
                 "embree,delegate,sceneIndex"]
    assert run.main(arguments) == 0
    rows = run.read(str(output / "results.jsonl"))
    assert set(rows) == {f"stages/{name}.usda" for name in ("triangle", "paint", "broken", "nothing")}
    assert rows["stages/broken.usda"]["ways"]["read"]["status"] == "message"
    assert rows["stages/nothing.usda"]["listed"] == "nothing to draw"
    assert rows["stages/paint.usda"]["listed"] == "nothing to draw; a part of triangle.usda"
    drawn = rows["stages/triangle.usda"]
    hydra = [] if hydraBuild.missing() else list(ways.COMPARED)
    assert {name: way["status"] for name, way in drawn["ways"].items()} == dict.fromkeys(["embree", *hydra], "ok")
    assert [drawn["pairs"][name]["word"] for name in hydra] == ["same"] * len(hydra)
    assert "triangle.usda" in (output / "index.html").read_text(encoding="utf-8")
    capsys.readouterr()
    assert run.main(arguments) == 0
    assert "4 stages, of which 4 are finished" in capsys.readouterr().out
    if not hydra:
        pytest.skip(f"the command line alone: {hydraBuild.missing()}")


@pytest.mark.parametrize("program, word, reason", [
    ("pass", "ok", ""),
    ("import sys; sys.exit('patina: no such camera')", "message", "patina: no such camera"),
    ("import os; os.abort()", "crash", "signal 6 (SIGABRT)"),
    ("1 / 0", "crash", "ZeroDivisionError: division by zero"),
    ("import os; os._exit(3)", "crash", ""),
    ("bytearray(1 << 33)", "memory", "MemoryError"),
    ("import time; time.sleep(60)", "timeout", None)])
def test_endings_of_a_way(program, word, reason):
    ending = watched.run([sys.executable, "-c", program], seconds=1.0 if word == "timeout" else 60.0, gigabytes=4.0)
    assert ending.word() == word
    assert reason is None or ending.reason() == reason
    assert ending.seconds < 30.0
    assert word != "timeout" or ending.peak > 1 << 20  # others may have ended before their memory is seen


def test_pictures_with_values_that_are_no_numbers_are_told(tmp_path, monkeypatch):
    import _patina

    image = np.ones((4, 4, 3), np.float32)
    image[1, 2] = np.nan
    kept = str(tmp_path / "kept.exr")
    _patina.write_image(kept, image)
    copy = [sys.executable, "-c", f"import shutil; shutil.copy({kept!r}, {str(tmp_path / 'embree.1.exr')!r})"]
    monkeypatch.setattr(ways.Way, "command", lambda *_: copy)
    _, row = ways.draw(ways.WAYS["embree"], {}, str(tmp_path), 1, 1, {"seconds": 60.0})
    assert row["status"] == "NaN" and row["message"] == "1 of 16 pixels are no numbers"


def noisy(value, seed, spread=0.05):
    return np.random.default_rng(seed).normal(value, spread, (16, 16, 3))


def test_agreement():
    def decide(value):
        return agreement.decide(noisy(value, 0), noisy(1.0, 0), lambda seed: noisy(value, seed), lambda seed: noisy(1.0, seed))

    assert decide(1.0)["word"] == "same"
    assert decide(1.005)["word"] == "agrees"
    assert decide(1.2)["word"] == "differs" and decide(1.2)["worst"] == pytest.approx(0.18, abs=0.05)
    other = agreement.decide(noisy(1.0, 301, 2.0), noisy(1.0, 302, 2.0), lambda seed: noisy(1.0, 300 + seed, 2.0),
                             lambda seed: noisy(1.0, 300 + seed, 2.0))
    assert other["word"] == "undecided" and "noise" in other["text"]


def test_a_coarse_mesh_keeps_the_mean():
    ball, smaller, other = (np.full((16, 16, 3), 0.5) for _ in range(3))
    ball[4:12, 4:12], smaller[4:12, 5:12], other[4:12, 4:12] = 1.0, 1.0, (1.0, 0.0, 0.0)
    assert agreement.is_coarse(smaller, ball)
    assert not agreement.is_coarse(ball, ball) and not agreement.is_coarse(other, ball)


def test_pictures_of_peers_are_found(tmp_path):
    tests = tmp_path / "testenv" / "testA"
    for folder in ("baseline", "sub"):
        os.makedirs(tests / folder)
    (tmp_path / "CMakeLists.txt").write_text(
        'pxr_register_test(testAs\n    COMMAND "testDrawing -stage sub/a.usda -write out.png"\n    TESTENV testA\n)\n',
        encoding="utf-8")
    for name in ("baseline/out.png", "baseline/b_001.png", "baseline/a.png"):
        (tests / name).write_bytes(b"")
    assert peers.of(str(tests / "sub" / "a.usda")) == [str(tests / "baseline" / name) for name in ("out.png", "a.png")]
    assert peers.of(str(tests / "b.usda")) == []


def test_pictures_of_peers_keep_their_colours(tmp_path):
    import _patina
    from patina.chart import png

    _patina.write_image(str(tmp_path / "peer.png"), np.full((480, 640, 3), 0.2, np.float32))
    assert page.peer(str(tmp_path / "peer.png")) == png.encode(np.full((120, 160, 3), 0.2))
    assert page.peer(str(tmp_path / "none.png")) is None


def test_counts_of_one_set_replace_its_own(tmp_path):
    file, options = str(tmp_path / "results.json"), {"samples": 1, "size": (8, 8)}
    way = {"status": "crash", "seconds": 1.0, "memory": 7, "message": "signal 11", "warnings": []}
    row = {"name": "a/x.usda", "listed": "", "ways": {"embree": way}, "pairs": {}}
    conformanceResults.update([row], ["a"], options, file)
    conformanceResults.update([dict(row, name="b/y.usda", ways={}, listed="nothing to draw")], ["b"], options, file)
    kept = conformanceResults.read(file)
    assert kept["a"]["counts"]["ways"] == {"embree": {"crash": 1}} and kept["b"]["counts"]["listed"] == 1
    assert kept["a"]["lines"] == [["x.usda", "embree", "crash"]]


def test_a_set_may_have_a_name_of_its_own(tmp_path):
    write(tmp_path, triangle=TRIANGLE)
    each = found.Set(f"own={tmp_path}")
    assert each.label(each.stages[0]) == "own/triangle.usda"
