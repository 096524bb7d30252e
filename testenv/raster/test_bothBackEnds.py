"""Every test scene through both back ends, beside the path tracer's direct light.

The budgets (budgets.json) are what was measured with these very settings and seeds, and a little more: a failure is a
change of the code. A failing pair leaves a page with both images, their difference and the command that makes it again.
"""
import os

import numpy as np
import pytest

import budgets
import pairs
import pairsPage

HELD = budgets.load()


@pytest.fixture(scope="module", autouse=True)
def opengl():
    reason = pairs.without_opengl()
    if reason:
        pytest.skip(reason)


def _fail(row, folder, said):
    page = pairsPage.write([row], str(folder), f"{row['name']}: {said}")
    pytest.fail(f"{said}\n{row['command']}\n{page}")


@pytest.mark.parametrize("name", pairs.names())
def test_each_scene_is_within_its_budget(name, tmp_path):
    entry = HELD["scenes"].get(name)
    assert entry and "quick" in entry, f"{name} has no budget: bothBackEnds.py FOLDER {name} --update quick"
    row = pairs.pair(name, str(tmp_path), **HELD["quick"], depths=(pairs.depth_of(entry),))
    (found,) = row["traced"].values()
    for key, most in entry["quick"].items():
        if abs(found[key]) > most:
            _fail(row, tmp_path, f"{key} is {found[key]:+.4f}, the budget {most}")


@pytest.mark.parametrize("name", ["lightDistant", "texturedDiffuse"])
def test_many_samples_look_alike(name, tmp_path):
    """Two scenes that hold the bound and take little time; not all do (budgets.json)."""
    row = pairs.pair(name, str(tmp_path), 1024, 64, depths=(pairs.DIRECT,))
    found = row["traced"][pairs.DIRECT]["flip"]
    if found is None:
        pytest.skip("flip-evaluator is not installed")
    if found > budgets.LARGEST_FLIP:
        _fail(row, tmp_path, f"FLIP is {found:.4f}, above {budgets.LARGEST_FLIP}")


def test_every_scene_has_more_than_a_picture():
    """A budget says that the back ends agree, not that they are right."""
    assert sorted(HELD["scenes"]) == pairs.names()
    for name, entry in HELD["scenes"].items():
        assert entry["checks"], name
        assert entry["same"] or entry.get("why"), name
        for check in entry["checks"]:
            assert os.path.isfile(os.path.join(pairs.ROOT, *check.split("/"))), (name, check)


def test_recorded_pairs_with_the_same_answer_look_alike():
    """What 1024 samples gave, where that was measured. Where the path tracer's own noise is above the bound, both are held
    against many more of its samples: the rasterizer is within the bound there, or not farther off than the path tracer."""
    for name, entry in HELD["scenes"].items():
        if not entry["same"] or entry.get("full", {}).get("flip", 0) <= budgets.LARGEST_FLIP:
            continue
        truth = entry["truth"]
        assert entry["why"] and truth["samples"] >= 16384, name
        assert truth["raster"] <= max(budgets.LARGEST_FLIP, truth["traced"]), (name, truth)


def test_budgets_only_go_down():
    entry = {"quick": {"bias": 0.02}}
    assert budgets.settle(entry, "quick", {"bias": 0.5})  # refused
    assert entry["quick"]["bias"] == 0.02
    assert not budgets.settle(entry, "quick", {"bias": -0.001})
    assert entry["quick"]["bias"] < 0.02
    assert not budgets.settle(entry, "quick", {"bias": 0.5}, reason="a light was wrong before")
    assert entry["quick"]["bias"] > 0.5 and "a light was wrong before" in entry["raised"][0]


def test_a_failing_pair_leaves_a_page(tmp_path):
    white = np.ones((8, 8, 3))
    row = {"name": "<b>x", "command": pairs.command("x", 1, 8), "raster": white, "rasterSeconds": 1.0,
           "traced": {pairs.DIRECT: {"image": 0 * white, "seconds": 1.0, **pairs.numbers(white, 0 * white)}}}
    with pytest.raises(pytest.fail.Exception, match="bothBackEnds.py OUTPUT x"):
        _fail(row, tmp_path, "FLIP is 1")
    text = (tmp_path / "index.html").read_text()
    assert text.count("<img") == 3 and "&lt;b&gt;x" in text and "<b>x" not in text


def test_aovs_are_the_path_tracers(tmp_path):
    import _patina

    stage = pairs.SCENES + "/texturedMesh.usda"
    found = {}
    for backend in ("raster", "embree"):
        image = str(tmp_path / (backend + ".exr"))
        aovs = [x for name in ("depth", "normal", "primId", "instanceId") for x in ("--aov", name)]
        pairs.record(stage, image, "--backend", backend, "--samples", "2", "--filterRadius", "0", "-w", "96", *aovs)
        read = _patina.read_image(image)
        found[backend] = {c: np.array(read.pixels)[..., i] for i, c in enumerate(read.channels)}
    assert set(found["raster"]) == set(found["embree"])
    for channel, values in found["raster"].items():
        if channel in "RGBA":
            continue
        same = np.isclose(values, found["embree"][channel], rtol=1e-3, atol=2e-3)
        assert same.mean() > 0.985, (channel, same.mean())  # silhouettes may fall to either side
