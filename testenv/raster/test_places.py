# SPDX-License-Identifier: Apache-2.0
"""Where things are does not change what they look like: far from the world's origin, beside casters that are far away,
on displaced polygons; and the AOVs of both back ends are the same. Comments say how far tiles were off without what a case
is for.
"""
import dataclasses
import os

import numpy as np
import pytest
from pxr import Usd, UsdShade

import equivalence
import inProcess
import pairs
import sameImage
import usda

pytestmark = pytest.mark.usefixtures("opengl")

STAGE = usda.stage(
    usda.prim("Xform", "World",
        usda.camera(lens=(24, 20.955, 15.7), clippingRange=(0.1, 1000),
                    matrix=((1, 0, 0, 0), (0, 0.8, -0.6, 0), (0, 0.6, 0.8, 0), (0, 3.6, 4.8, 1))),
        usda.floor("floor", 4, "%(floor)s", apis=("MaterialBindingAPI",), st=usda.ST, color=(0.6, 0.55, 0.5)),
        usda.prim("Sphere", "ball", radius=0.8, at=(-0.9, 0.8, 0), color=(0.2, 0.4, 0.7)),
        usda.prim("Cube", "block", size=1, at=(0.9, 0.5, 0.4), turn=(0, 30, 0), color=(0.7, 0.3, 0.2)),
        usda.prim("RectLight", "key", intensity=12, at=(-2, 4, 2), turn=(-55, -35, 0)),
        usda.prim("DistantLight", "sun", intensity=2, angle=2, turn=(-40, 35, 0)),
        usda.prim("DomeLight", "sky", intensity=0.4),
        "%(more)s", at="(%(far)g, %(up)g, %(back)g)"))

# Sines of the place, so that bumps are where the world is, not the prim.
BUMPS = usda.material("bumps", {
    "diffuse": ("ND_oren_nayar_diffuse_bsdf", {"color": (0.6, 0.55, 0.5)}),
    "surface": ("ND_surface", {"bsdf": "<diffuse>"}),
    "place": ("ND_position_vector3", {"uniform string space": "world"}, "float3 out"),
    "wide": ("ND_multiply_vector3FA", {"float3 in1": "<place>", "in2": 4}, "float3 out"),
    "wave": ("ND_sin_vector3", {"float3 in": "<wide>"}, "float3 out"),
    "x": ("ND_extract_vector3", {"float3 in": "<wave>", "index": 0}, "float out"),
    "displacement": ("ND_displacement_float", {"float displacement": "<x>", "scale": 0.25})},
    surface="surface", displacement="displacement")

CARD = usda.mesh("card", [(-1e7, 1e7, 1e7), (1e7, 1e7, 1e7), (1e7, 1.1e7, 1e7), (-1e7, 1.1e7, 1e7)])


def write(folder, far=0.0, floor="", more="", end=""):
    stage = folder / f"places{far:g}{'Bumpy' if floor else ''}.usda"
    stage.write_text(STAGE % {"far": far, "up": 0.2 * far, "back": -far, "floor": floor, "more": more} + end)
    return str(stage)


@pytest.mark.parametrize("far", [1e3, 1e4])
def test_far_from_the_origin(tmp_path, far):
    """The same picture as at the origin: in the world's coordinates tiles are off by 0.039 and 0.31 of their values."""
    image = {x: inProcess.Stage(write(tmp_path, x), "--backend", "raster", "--samples", 24, "-w", sameImage.WIDTH).image(0)
             for x in (0.0, far)}
    near, away = (equivalence.tiles([image[x]])[0] for x in (0.0, far))
    assert (np.abs(away - near) <= equivalence.MARGIN * (near + equivalence.FLOOR * near.mean())).all()


def test_a_caster_far_away_takes_no_shadow(tmp_path):
    """Depths over the whole scene would take 0.78 of a tile."""
    power = dataclasses.replace(equivalence.FULL, samples=8)
    sameImage.assert_same(matte(write(tmp_path, more=CARD)), width=24, power=power)


BUMPY = {"floor": "        rel material:binding = </bumps>", "end": BUMPS}


def test_bumps_of_polygons_stand_in_the_world(tmp_path):
    """Polygons are displaced by where they are in the world. Not refined, tiles would be off by 0.38."""
    coarse = ("--method", "subdivision=16px")
    # Few passes, each of which draws 50,000 triangles into the shadow maps: the interval that is asked for stays.
    power = dataclasses.replace(equivalence.FULL, widest=10 * equivalence.MARGIN, looks=(6, 12), samples=2)
    bumpy = sameImage.assert_same(write(tmp_path, 1000.0, **BUMPY), None, *coarse, width=24, power=power)[1]
    flat, here = (inProcess.references(write(tmp_path, **more), [7], "-w", 24, "--samples", 64, "--maxDepth", 1, *coarse)[0]
                  for more in ({}, BUMPY))
    assert np.abs(bumpy - flat).mean() > 0.02 and np.abs(bumpy - here).mean() > 0.02


def matte(path):
    """Binds a material of one lobe to all prims: the albedo of the usual surface takes a minute to compile in software."""
    text = usda.lobe("matte", "oren_nayar_diffuse_bsdf", color=(0.6, 0.5, 0.4))
    with open(os.path.join(os.path.dirname(path), "matte.usda"), "w", encoding="utf-8") as file:
        file.write("#usda 1.0\n" + text)
    stage = Usd.Stage.Open(path)
    stage.GetRootLayer().subLayerPaths.append("matte.usda")
    for name in ("floor", "ball", "block"):
        prim = stage.GetPrimAtPath("/World/" + name)
        UsdShade.MaterialBindingAPI.Apply(prim).Bind(UsdShade.Material(stage.GetPrimAtPath("/matte")))
    stage.GetRootLayer().Save()
    return path


def test_aovs_are_those_of_the_path_tracer(tmp_path):
    aovs = ("--aov", "all", "--aov", "primvars:displayColor")
    found, stage = {}, matte(write(tmp_path, 500.0))
    for backend in ("raster", "embree"):
        file = str(tmp_path / (backend + ".exr"))
        pairs.record(stage, file, "--backend", backend, "--samples", "16", "-w", "48", "--maxDepth", "1",
                     "--filterRadius", "0.1", *aovs)
        found[backend] = inProcess.channels(file)
    assert set(found["raster"]) == set(found["embree"])
    for name, other in found["embree"].items():
        if name in ("A", "R", "G", "B", "sampleCount", "variance"):
            continue
        own = found["raster"][name]
        # Places differ by parts of a pixel, since the path tracer takes the sample next to its centre.
        near = np.abs(own - other) <= 0.02 * np.maximum(np.abs(other), 1.0)
        assert near.mean() > 0.9, (name, near.mean())
        if name.startswith(("albedo", "primvars")):
            assert own.max() > 0.1, name
