# SPDX-License-Identifier: Apache-2.0
"""Portals guide the samples of a dome: the picture stays, its noise falls."""
import json

import numpy as np
import pytest
from scipy import stats

from rendering import SCENES, color, record
import usda

PORTALS = "        rel portals = </World/window>\n"
SEEDS, SAMPLES = 16, 16
SIGNIFICANCE = 1e-5


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    """:returns: with and without portals: seeds x height x width x 3"""
    folder = tmp_path_factory.mktemp("portals")
    with open(SCENES + "/portals.usda", encoding="utf-8") as file:
        text = file.read().replace("@textures/", f"@{SCENES}/textures/")
    assert PORTALS in text
    made = []
    for name, stage in (("with", text), ("without", text.replace(PORTALS, ""))):
        path = folder / f"{name}.usda"
        path.write_text(stage)
        images = []
        for seed in range(SEEDS):
            image = folder / f"{name}{seed}.exr"
            record(path, image, "--imageWidth", 32, "--samples", SAMPLES, "--seed", seed, "--camera", "/World/camera")
            images.append(color(image))
        made.append(np.array(images))
    return made


def test_the_mean_is_the_same(pictures):
    """Two-sample t-test (Welch) on the mean of each picture; seeds are 0 to 15 of either."""
    guided, plain = (p.mean(axis=(1, 2, 3)) for p in pictures)
    found = stats.ttest_ind(guided, plain, equal_var=False)
    assert found.pvalue > SIGNIFICANCE, (guided.mean(), plain.mean(), found)
    # The test sees a difference of 5 %: that of half the samples that portals do not guide.
    assert 0.05 * plain.mean() > 5.0 * np.hypot(guided.std(ddof=1), plain.std(ddof=1)) / np.sqrt(SEEDS)


def test_there_is_less_noise(pictures):
    """The variance of a pixel between seeds, over the image, is smaller: the window fills a small part of the sky."""
    guided, plain = (p.var(axis=0, ddof=1).mean() for p in pictures)
    assert guided < plain, (guided, plain)


def test_what_is_no_portal_is_named(tmp_path):
    stage, statistics = tmp_path / "stage.usda", tmp_path / "statistics.json"
    stage.write_text(usda.stage(
        usda.prim("DomeLight", "sky", "rel portals = [</nowhere>, </ball>, </flat>]"),
        usda.prim("Sphere", "ball"),
        usda.prim("PortalLight", "flat", width=0),
        usda.prim("PortalLight", "lonely"),
        up=""))
    record(stage, tmp_path / "image.exr", "--imageWidth", 4, "--samples", 1, f"--json={statistics}")
    said = [w["prim"] + " " + w["message"] for w in json.loads(statistics.read_text())["warnings"]]
    for text in ("/sky /nowhere is no PortalLight", "/sky /ball is no PortalLight", "/sky /flat has no size",
                 "/lonely prims of type PortalLight"):
        assert any(line.startswith(text) for line in said), (text, said)
    assert not any(line.startswith("/flat") for line in said)
