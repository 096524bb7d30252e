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

pytest.importorskip("scipy.stats", reason="SciPy is not installed")

import equivalence  # noqa: E402
import inProcess  # noqa: E402
import pairs  # noqa: E402
import sameImage  # noqa: E402
from materialText import material  # noqa: E402

pytestmark = pytest.mark.usefixtures("opengl")

STAGE = """#usda 1.0
(
    upAxis = "Y"
)
def Xform "World"
{
    double3 xformOp:translate = (%(far)g, %(up)g, %(back)g)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Camera "camera"
    {
        float2 clippingRange = (0.1, 1000)
        float focalLength = 24
        float horizontalAperture = 20.955
        float verticalAperture = 15.7
        matrix4d xformOp:transform = ((1, 0, 0, 0), (0, 0.8, -0.6, 0), (0, 0.6, 0.8, 0), (0, 3.6, 4.8, 1))
        uniform token[] xformOpOrder = ["xformOp:transform"]
    }
    def Mesh "floor" (
        prepend apiSchemas = ["MaterialBindingAPI"]
    )
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-4, 0, 4), (4, 0, 4), (4, 0, -4), (-4, 0, -4)]
        texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (
            interpolation = "vertex"
        )
        color3f[] primvars:displayColor = [(0.6, 0.55, 0.5)]
        uniform token subdivisionScheme = "none"
%(floor)s
    }
    def Sphere "ball"
    {
        double radius = 0.8
        double3 xformOp:translate = (-0.9, 0.8, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        color3f[] primvars:displayColor = [(0.2, 0.4, 0.7)]
    }
    def Cube "block"
    {
        double size = 1
        double3 xformOp:translate = (0.9, 0.5, 0.4)
        float3 xformOp:rotateXYZ = (0, 30, 0)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
        color3f[] primvars:displayColor = [(0.7, 0.3, 0.2)]
    }
    def RectLight "key"
    {
        float inputs:intensity = 12
        double3 xformOp:translate = (-2, 4, 2)
        float3 xformOp:rotateXYZ = (-55, -35, 0)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
    }
    def DistantLight "sun"
    {
        float inputs:intensity = 2
        float inputs:angle = 2
        float3 xformOp:rotateXYZ = (-40, 35, 0)
        uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
    }
    def DomeLight "sky"
    {
        float inputs:intensity = 0.4
    }
%(more)s
}
"""

# Sines of the place, so that bumps are where the world is, not the prim.
BUMPS = """
def Material "bumps"
{
    token outputs:mtlx:surface.connect = </bumps/surface.outputs:out>
    token outputs:mtlx:displacement.connect = </bumps/displacement.outputs:out>
    def Shader "diffuse"
    {
        uniform token info:id = "ND_oren_nayar_diffuse_bsdf"
        color3f inputs:color = (0.6, 0.55, 0.5)
        token outputs:out
    }
    def Shader "surface"
    {
        uniform token info:id = "ND_surface"
        token inputs:bsdf.connect = </bumps/diffuse.outputs:out>
        token outputs:out
    }
    def Shader "place"
    {
        uniform token info:id = "ND_position_vector3"
        uniform string inputs:space = "world"
        float3 outputs:out
    }
    def Shader "wide"
    {
        uniform token info:id = "ND_multiply_vector3FA"
        float3 inputs:in1.connect = </bumps/place.outputs:out>
        float inputs:in2 = 4
        float3 outputs:out
    }
    def Shader "wave"
    {
        uniform token info:id = "ND_sin_vector3"
        float3 inputs:in.connect = </bumps/wide.outputs:out>
        float3 outputs:out
    }
    def Shader "x"
    {
        uniform token info:id = "ND_extract_vector3"
        float3 inputs:in.connect = </bumps/wave.outputs:out>
        int inputs:index = 0
        float outputs:out
    }
    def Shader "displacement"
    {
        uniform token info:id = "ND_displacement_float"
        float inputs:displacement.connect = </bumps/x.outputs:out>
        float inputs:scale = 0.25
        token outputs:out
    }
}
"""

CARD = """    def Mesh "card"
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-1e7, 1e7, 1e7), (1e7, 1e7, 1e7), (1e7, 1.1e7, 1e7), (-1e7, 1.1e7, 1e7)]
        uniform token subdivisionScheme = "none"
    }"""


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
    text = material("matte", {"mtlx:surface": "surface"}, {
        "lobe": ("ND_oren_nayar_diffuse_bsdf", {"color3f color": "(0.6, 0.5, 0.4)"}),
        "surface": ("ND_surface", {"token bsdf": "<lobe>"})})
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
    import _patina

    aovs = ("--aov", "all", "--aov", "primvars:displayColor")
    found, stage = {}, matte(write(tmp_path, 500.0))
    for backend in ("raster", "embree"):
        file = str(tmp_path / (backend + ".exr"))
        pairs.record(stage, file, "--backend", backend, "--samples", "16", "-w", "48", "--maxDepth", "1",
                     "--filterRadius", "0.1", *aovs)
        image = _patina.read_image(file)
        found[backend] = dict(zip(image.channels, np.moveaxis(np.array(image.pixels), -1, 0)))
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
