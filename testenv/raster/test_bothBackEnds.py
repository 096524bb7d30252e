# SPDX-License-Identifier: Apache-2.0
"""Both back ends draw the same picture of every stage, tile by tile (equivalence.py says how that is decided).

Test scenes, emitters out of view, and stages that were not made for this. All seeds are fixed, so that the same comes every
time. A failing pair leaves a page with both images and their difference.
"""
import dataclasses
import os

import numpy as np
import pytest

import equivalence
import equivalentStages
import pairs
import pairsPage
import sameImage

pytestmark = pytest.mark.usefixtures("opengl")

CASES = {case.name: case for case in equivalentStages.cases()}


def hold(case, folder, power):
    """Fails where the back ends differ, and where that cannot be said."""
    path = equivalentStages.path_of(case, folder)
    if path is None:
        pytest.skip("no such file in $PATINA_ASSETS")
    verdict, raster, traced = sameImage.decide(path, None, *case.arguments, depth=case.depth,
                                               power=dataclasses.replace(power, tile=case.tile))
    print(f"{case.name}: {len(raster)} renders, largest difference {100 * np.abs(verdict.difference).max():.2f} %, half "
          f"intervals {100 * np.median(verdict.half):.2f} % (median) to {100 * verdict.half.max():.2f} %")
    if verdict.differs.any() or verdict.open:
        _fail(case, verdict.text(), raster.mean(axis=0), traced.mean(axis=0), folder)


def _fail(case, said, raster, traced, folder):
    row = {"name": case.name, "raster": raster, "rasterSeconds": 0.0, "command": f"./patina test testenv/raster -k {case.name}",
           "traced": {case.depth: {"image": traced, "seconds": 0.0, **pairs.numbers(raster, traced)}}}
    page = pairsPage.write([row], str(folder), f"{case.name}: {said}")
    pytest.fail(f"{case.name}: {said}\n{page}")


@pytest.mark.parametrize("name", [name for name, case in CASES.items() if case.tier == "full"])
def test_both_draw_the_same(name, tmp_path):
    hold(CASES[name], tmp_path, equivalence.FULL)


@pytest.mark.parametrize("name", CASES)
def test_both_draw_the_same_looked_at_closely(name, tmp_path):
    hold(CASES[name], tmp_path, equivalence.LONG)


def test_a_third_of_the_stages_were_not_made_for_this():
    for tiers in (("full",), ("full", "long")):
        sorts = [case.sort for case in CASES.values() if case.tier in tiers]
        assert 3 * sorts.count("asset") >= len(sorts), tiers


def test_a_failing_pair_leaves_a_page(tmp_path):
    white = np.ones((8, 8, 3))
    with pytest.raises(pytest.fail.Exception, match="1 of 3: tile row 0"):
        _fail(equivalentStages.Case("<b>x", "scene", "x"), "1 of 3: tile row 0", white, 0 * white, tmp_path)
    text = (tmp_path / "index.html").read_text()
    assert text.count("<img") == 3 and "&lt;b&gt;x" in text and "<b>x" not in text


def test_aovs_are_the_path_tracers(tmp_path):
    import _patina

    stage = pairs.SCENES + "/texturedMesh.usda"
    found = {}
    for backend in ("raster", "embree"):
        image = os.path.join(str(tmp_path), backend + ".exr")
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
