# SPDX-License-Identifier: Apache-2.0
"""Patina and Mitsuba 3 render the same scenes and agree within noise.

Both render every scene several times with independent seeds. The mean of each 8x8 tile of each
image is one observation, so a tile gives two small samples that Welch's t-test compares; the
smallest p-value over all tiles and channels is held against a significance of 1 % for the scene,
with Šidák's correction. A scene fails only if two of three seed sets are rejected.
"""
import json
import os
import tempfile

import numpy as np
import pytest
from scipy import stats

mi = pytest.importorskip("mitsuba", reason="Mitsuba 3 is not installed")
from pxr import Usd

import exportScene
import inProcess
from patina.regression import welch
from patina.significance import sidak

SCENES = os.path.join(os.path.dirname(__file__), "..", "scenes")
WIDTH, HEIGHT = 96, 64
SIGNIFICANCE = 0.01

# scene, prims that are left out (lights that would stand in front of a dome: Mitsuba's lights block
# what is behind them, ours let it through), samples, attributes that are set
CASES = {
    "diffuseBox": ([], 128, {}),
    "lightSphere": ([], 128, {}),
    "lightDisk": ([], 128, {}),
    "lightRect": ([], 128, {}),
    "lightCylinder": ([], 128, {}),
    "lightDistant": ([], 128, {"/World/light.inputs:angle": 0.0, "/World/light.inputs:intensity": 3.0}),
    "lightDome": ([], 128, {"/World/light.inputs:texture:file": None}),
    # Mitsuba shadows by G1(wi) G1(wo), ours is height-correlated: they differ where alpha is large.
    # Tangents of meshes without texture coordinates are each renderer's own: isotropic only.
    "roughConductor": (["/World/sky"], 256, {"/World/materials/m2/metal.inputs:roughness": (0.2, 0.2),
                                             "/World/materials/m3/metal.inputs:roughness": (0.05, 0.05),
                                             "/World/materials/m4/metal.inputs:roughness": (0.15, 0.15)}),
    "roughDielectricSlab": ([], 512, {}),
    "texturedDiffuse": ([], 128, {}),
    "depthOfField": (["/World/sky"], 256, {}),
    "instances": (["/World/sky"], 128, {}),
    "media": (["/World/sky"], 128, {}),
}


def make_stage(name, folder):
    """A flat copy of a test scene with the changes of its case. Spheres become meshes in both."""
    without, samples, values = CASES[name]
    stage = Usd.Stage.Open(os.path.join(SCENES, name + ".usda"))
    for path, value in values.items():
        if value is None:
            stage.GetPropertyAtPath(path).Block()
        else:
            stage.GetPropertyAtPath(path).Set(value)
    for path in without:
        stage.GetPrimAtPath(path).SetActive(False)
    exportScene.replace_by_meshes(stage)
    path = os.path.join(folder, name + ".usda")
    stage.Export(path)
    return path, samples


def render_patina(path, samples, seeds):
    return inProcess.references(path, seeds, "--imageWidth", WIDTH, "--imageHeight", HEIGHT, "--samples", samples,
                                "--filterRadius", 0.5, "--method", "energyCompensation=none")


def render_mitsuba(path, samples, seeds, folder):
    if mi.variant() is None:
        mi.set_variant("llvm_ad_rgb" if "llvm_ad_rgb" in mi.variants() and os.environ.get("PATINA_MITSUBA_LLVM")
                       else "scalar_rgb")
    scene = mi.load_dict(exportScene.export(mi, Usd.Stage.Open(path), folder, WIDTH, HEIGHT, samples))
    return np.array([np.array(mi.render(scene, seed=seed))[..., :3] for seed in seeds])


def smallest_p(ours, theirs):
    """The smallest p-value of Welch's test over tiles and channels, and how many there are."""
    a, b = welch.tiles(ours), welch.tiles(theirs)
    # Tiles that never vary (background) must be equal; rounding is all that may differ.
    still = (a.std(axis=0) < 1e-9) & (b.std(axis=0) < 1e-9)
    assert np.allclose(a.mean(axis=0)[still], b.mean(axis=0)[still], rtol=1e-4, atol=1e-6)
    p = stats.ttest_ind(a, b, axis=0, equal_var=False).pvalue[~still]
    return float(np.nanmin(p)), p.size


@pytest.mark.parametrize("name", CASES)
def test_agrees_with_mitsuba(name):
    rejected = []
    with tempfile.TemporaryDirectory() as folder:
        path, samples = make_stage(name, folder)
        for attempt in range(3):
            seeds = [1000 * attempt + k for k in range(6)]
            ours = render_patina(path, samples, seeds)
            theirs = render_mitsuba(path, samples, [s + 500 for s in seeds], folder)
            p, count = smallest_p(ours, theirs)
            limit = sidak(SIGNIFICANCE, count)
            bias = float((ours.mean() - theirs.mean()) / theirs.mean())
            print(json.dumps({"scene": name, "smallest p": p, "limit": limit, "relative mean error": bias}))
            rejected.append(p < limit)
            if rejected.count(True) == 2 or rejected.count(False) == 2:
                break
    assert rejected.count(True) < 2, f"{name}: {rejected.count(True)} of {len(rejected)} seed sets rejected"
