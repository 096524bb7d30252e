"""Where things are does not change what they look like: far from the world's origin, beside casters that are far away,
on displaced polygons; and the AOVs of both back ends are the same. Images are of fixed seeds; the limits are two to three
times what was measured (means: more). Comments say what blocks were without what a case is for.
"""
import numpy as np
import pytest

import pairs
from test_bothBackEnds import opengl  # noqa: F401  skips where there is none

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


def draw(folder, backend, *extra, far=0.0, floor="", more="", end="", samples=24):
    stage, image = folder / "places.usda", folder / f"{backend}{far:g}.exr"
    stage.write_text(STAGE % {"far": far, "up": 0.2 * far, "back": -far, "floor": floor, "more": more} + end)
    pairs.record(str(stage), str(image), "--backend", backend, "--samples", str(samples), "-w", "48", *extra,
                 *(("--maxDepth", "1", "--seed", "7") if backend == "embree" else ()))
    return image


def blocks(image):
    h, w = (n // 8 * 8 for n in image.shape[:2])
    return image[:h, :w].reshape(h // 8, 8, w // 8, 8, 3).mean(axis=(1, 3, 4))


def worst(a, b):
    """:returns: largest relative difference of a block of 8x8 pixels, and that of the means"""
    a, b = pairs.pixels(a), pairs.pixels(b)
    return (float(np.max(np.abs(blocks(a) - blocks(b)) / (blocks(b) + 0.05 * b.mean()))), float(abs(a.mean() / b.mean() - 1)))


@pytest.mark.parametrize("far", [1e3, 1e4])
def test_far_from_the_origin(tmp_path, far):
    block, mean = worst(draw(tmp_path, "raster", far=far), draw(tmp_path, "raster"))
    assert block < 0.01 and mean < 0.001  # all in the world's coordinates: 0.039 and 0.31


def test_a_caster_far_away_takes_no_shadow(tmp_path):
    block, mean = worst(draw(tmp_path, "raster", more=CARD), draw(tmp_path, "embree", more=CARD))
    assert block < 0.08 and mean < 0.02  # depths over the whole scene: 0.78


def test_polygons_are_displaced(tmp_path):
    bound = {"floor": "        rel material:binding = </bumps>", "end": BUMPS}
    block, mean = worst(draw(tmp_path, "raster", **bound), draw(tmp_path, "embree", **bound))
    assert block < 0.1 and mean < 0.02  # not refined: 0.38
    flat = pairs.pixels(draw(tmp_path, "embree"))
    assert np.abs(flat - pairs.pixels(tmp_path / "raster0.exr")).mean() > 0.02


def test_materials_know_places_in_the_world(tmp_path):
    """Bumps stand in the world: other places show others, the same ones in both back ends."""
    bound = {"floor": "        rel material:binding = </bumps>", "end": BUMPS, "far": 1000.0}
    block, mean = worst(draw(tmp_path, "raster", **bound), draw(tmp_path, "embree", **bound))
    assert block < 0.1 and mean < 0.02


def test_aovs_are_those_of_the_path_tracer(tmp_path):
    import _patina

    aovs = ("--aov", "all", "--aov", "primvars:displayColor")
    found = {}
    for backend in ("raster", "embree"):
        image = _patina.read_image(str(draw(tmp_path, backend, *aovs, far=500.0, samples=16)))
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
