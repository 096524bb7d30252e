# SPDX-License-Identifier: Apache-2.0
"""Energy, in every test scene and by both back ends: under a white sky, with no other light, nothing is brighter than the
sky, and where nothing stands in the way the sky shows.

Fixed seeds; a block's mean of 16 samples of a white sky scatters by less than the allowance, since no sample is far above 1.
"""
import numpy as np
import pytest
from pxr import Sdf, Usd, UsdLux

import pairs

pytestmark = pytest.mark.usefixtures("opengl")

BLOCK = 1.02   # brightest 8x8 block
IMAGE = 1.002  # mean of the image
DARK = {"portals": 0.0}  # a room: its one window is a small part of what a point sees
LIT = 0.05  # of the sky's radiance, by the brightest pixel of all others
WIDTH, SAMPLES = 32, 16
# The same objects under a light of each kind: without it they are one scene, so one of them stands for all.
ONE_SCENE = ("lightRect", "lightCylinder", "lightDisk", "lightDistant", "lightDome", "lightSphere", "lightSpot")
NAMES = [name for name in pairs.names() if name not in ONE_SCENE[1:]]


def under_a_white_sky(name, path):
    """Writes a stage over the scene whose only light is a dome of radiance 1; no material glows."""
    scene = f"{pairs.SCENES}/{name}.usda"
    layer = Sdf.Layer.CreateNew(str(path))
    layer.subLayerPaths.append(scene)
    stage = Usd.Stage.Open(layer)
    source = Usd.Stage.Open(scene)
    for key in ("defaultPrim", "upAxis", "metersPerUnit", "timeCodesPerSecond", "startTimeCode", "endTimeCode"):
        if source.HasAuthoredMetadata(key):
            stage.SetMetadata(key, source.GetMetadata(key))
    for prim in list(stage.Traverse()):
        if prim.HasAPI(UsdLux.MeshLightAPI):
            UsdLux.LightAPI(prim).CreateIntensityAttr(0.0)
        elif prim.HasAPI(UsdLux.LightAPI):
            prim.SetActive(False)
        glow = prim.GetAttribute("inputs:emissiveColor")
        if glow:
            glow.Set((0.0, 0.0, 0.0))
    dome = UsdLux.DomeLight.Define(stage, "/WhiteSky")
    dome.CreateIntensityAttr(1.0)
    stage.GetRootLayer().Save()
    return str(path)


@pytest.mark.parametrize("backend", ["raster", "embree"])
@pytest.mark.parametrize("name", NAMES)
def test_nothing_outshines_a_white_sky(name, backend, tmp_path):
    stage, image = under_a_white_sky(name, tmp_path / "white.usda"), str(tmp_path / "white.exr")
    pairs.record(stage, image, "--backend", backend, "--samples", str(SAMPLES), "-w", str(WIDTH))
    found = pairs.pixels(image)
    assert np.isfinite(found).all() and found.max() > DARK.get(name, LIT), "nothing is lit"
    h, w = (n // 8 * 8 for n in found.shape[:2])
    blocks = found[:h, :w].reshape(h // 8, 8, w // 8, 8, 3).mean(axis=(1, 3))
    assert blocks.max() <= BLOCK and found.mean() <= IMAGE, (blocks.max(), found.mean())


@pytest.mark.parametrize("name", ONE_SCENE[1:])
def test_without_its_light_it_is_the_same_scene(name, tmp_path):
    prims = []
    for scene in (ONE_SCENE[0], name):
        stage = Usd.Stage.Open(under_a_white_sky(scene, tmp_path / f"{scene}.usda"))
        prims.append({str(prim.GetPath()): (prim.GetTypeName(), prim.GetAppliedSchemas(), {
            **{a.GetName(): a.Get() for a in prim.GetAuthoredAttributes()},
            **{r.GetName(): r.GetTargets() for r in prim.GetAuthoredRelationships()}}) for prim in stage.Traverse()})
    assert len(prims[0]) > 5 and prims[0] == prims[1]
