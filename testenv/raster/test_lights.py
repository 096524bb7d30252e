# SPDX-License-Identifier: Apache-2.0
"""Features of lights, drawn by the rasterizer and by the path tracer: the answer has to be the same, by equivalence.py.

Every stage is a floor with a block on it under one kind of light.
"""
import dataclasses

import numpy as np
import pytest

pytest.importorskip("scipy.stats", reason="SciPy is not installed")

import equivalence  # noqa: E402
import inProcess  # noqa: E402
import sameImage  # noqa: E402
from floorLights import STAGE, light, write  # noqa: E402
from patina.chart import sweepsSky  # noqa: E402
from patina.experiment import LUMINANCE, relative_error  # noqa: E402

pytestmark = pytest.mark.usefixtures("opengl")

NO_HEADLIGHT = "--disableCameraLight"


def linked(only, which):
    return f"""        uniform bool collection:{which}:includeRoot = 0
        rel collection:{which}:includes = [{only}]"""


def many_links():
    """More links than a machine word has bits; each light has its own, the last ones light the block alone."""
    return "".join(light("SphereLight", "        float inputs:intensity = 4\n        float inputs:radius = 0.1\n"
                         + linked("</World/block>" if i > 64 else "</World/floor>", "lightLink"), f"light{i}",
                         place=f"""        double3 xformOp:translate = ({-2 + 0.06 * i}, 2.5, 0.4)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        float inputs:specular = {0.5 + 0.001 * i}
""") for i in range(68))


def many_domes():
    """More domes than a pass takes, each of its own colour."""
    return "".join(light("DomeLight", f"        color3f inputs:color = ({0.01 * (i % 7)}, 0.02, {0.002 * (40 - i)})", f"sky{i}",
                         place="") for i in range(40))


CASES = {
    "profile": light("SphereLight", '        float inputs:intensity = 0.05\n        float inputs:radius = 0.2\n'
                      '        asset inputs:shaping:ies:file = @./lamp.ies@', api="ShapingAPI"),
    "profileNormalized": light("DiskLight", '        float inputs:intensity = 100\n        float inputs:radius = 0.3\n'
                                '        asset inputs:shaping:ies:file = @./lamp.ies@\n'
                                '        float inputs:shaping:ies:angleScale = 0.3\n'
                                '        bool inputs:shaping:ies:normalize = 1', api="ShapingAPI"),
    "rectImage": light("RectLight", '        float inputs:intensity = 3\n        float inputs:width = 2\n'
                        '        float inputs:height = 1\n        asset inputs:texture:file = @./image.exr@'),
    "shadowLink": light("SphereLight", "        float inputs:intensity = 40\n        float inputs:radius = 0.2\n"
                         + linked("</World/floor>", "shadowLink")),
    "lightLink": light("SphereLight", "        float inputs:intensity = 40\n        float inputs:radius = 0.2\n"
                        + linked("</World/floor>", "lightLink")),
    "manyLinks": many_links(),
    "shadowDistance": light("SphereLight", "        float inputs:intensity = 40\n        float inputs:radius = 0.2\n"
                             "        float inputs:shadow:distance = 0.7\n        float inputs:shadow:falloff = 0.5",
                             api="ShadowAPI"),
    "shadowColor": light("SphereLight", "        float inputs:intensity = 40\n        float inputs:radius = 0.2\n"
                          "        color3f inputs:shadow:color = (0.5, 0.1, 0.1)", api="ShadowAPI"),
    "line": light("CylinderLight", "        float inputs:intensity = 40\n        float inputs:length = 2\n"
                   "        float inputs:radius = 0.02\n        bool treatAsLine = 1"),
    "sun": light("DistantLight", "        float inputs:intensity = 2\n        float inputs:angle = 0"),
    "twoDomes": light("DomeLight", "        color3f inputs:color = (0.2, 0.3, 0.6)", "sky", place="")
                 + light("DomeLight", "        asset inputs:texture:file = @./image.exr@\n"
                         "        float inputs:intensity = 0.5", "dome", place=""),
    "manyDomes": many_domes(),
}
# A card where the block is: of a block, the near side alone would be known (test_byDesign.py).
STAGES = {"shadowDistance": STAGE.replace(STAGE[STAGE.index('    def Cube "block"'):STAGE.index("%s")], """    def Mesh "card"
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0.1, 0.2, 0.4), (0.9, 0.2, 0.4), (0.9, 0.8, -0.4), (0.1, 0.8, -0.4)]
        uniform token subdivisionScheme = "none"
    }
""")}
# Few texels of the image give nearly all of its light, so that each render is noisier.
LESS = dataclasses.replace(equivalence.FULL, widest=10 * equivalence.MARGIN, looks=(6, 12))
POWER = {"rectImage": dataclasses.replace(LESS, samples=96, looks=(6, 12, 18)), "manyDomes": LESS,
         "manyLinks": dataclasses.replace(LESS, samples=8)}
SMALL = {"manyDomes": 24, "manyLinks": 24}  # hundreds of shadow maps for each pass


@pytest.mark.parametrize("name", sorted(CASES))
def test_light_is_the_path_tracers(name, tmp_path):
    power = POWER.get(name, equivalence.FULL)
    sameImage.assert_same(write(tmp_path, STAGES.get(name, STAGE) % CASES[name]), None, NO_HEADLIGHT, power=power,
                          width=SMALL.get(name, sameImage.WIDTH))


GLOSSY = """    def Material "metal"
    {
        token outputs:surface.connect = </World/metal/surface.outputs:surface>
        def Shader "surface"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0.9, 0.9, 0.9)
            float inputs:metallic = 1
            float inputs:roughness = 0.35
            token outputs:surface
        }
    }
"""


@pytest.mark.parametrize("angle", [4, 30, 120])
def test_wide_suns_are_shadowed_where_samples_of_the_material_find_them(angle, tmp_path):
    """Without a dome nothing else asks what hides far away light from such samples. The block stands in its mirror image."""
    sun = light("DistantLight", f"        float inputs:intensity = 10\n        float inputs:angle = {angle}",
                place="        float3 xformOp:rotateXYZ = (-50, 170, 0)\n"
                      '        uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]\n')
    stage = STAGE.replace('def Mesh "floor"', 'def Mesh "floor" (prepend apiSchemas = ["MaterialBindingAPI"])')
    stage = stage.replace('        point3f[] points', "        rel material:binding = </World/metal>\n        point3f[] points",
                          1)
    power = dataclasses.replace(equivalence.FULL, widest=10 * equivalence.MARGIN)
    sameImage.assert_same(write(tmp_path, stage % (sun + GLOSSY)), None, NO_HEADLIGHT, power=power)


INSIDE = """    def Sphere "bulb"
    {
        double radius = 0.3
        double3 xformOp:translate = (-1, 2, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
"""


@pytest.mark.parametrize("kind", ["SphereLight", "CylinderLight"])
def test_what_is_inside_of_a_light_casts_nothing(kind, tmp_path):
    """Samples of a sphere light lie inside of it, but it shines from its surface."""
    place = '        double3 xformOp:translate = (-1, 2, 0)\n        uniform token[] xformOpOrder = ["xformOp:translate"]\n'
    lamp = light(kind, "        float inputs:radius = 0.4\n        float inputs:intensity = 4", place=place)
    drawn, power = [], dataclasses.replace(equivalence.FULL, widest=10 * equivalence.MARGIN)
    for name, lights in (("with", lamp + INSIDE), ("without", lamp)):
        (tmp_path / name).mkdir()
        drawn.append(sameImage.assert_same(write(tmp_path / name, STAGE % lights), None, NO_HEADLIGHT, power=power)[0])
    # The ball stretches what shadow maps hold, so that edges of shadows fall otherwise by a part of a texel, of which a pixel
    # has four: that is in few pixels, and a tenth of the light's samples in the ball's shadow would be in all.
    assert np.median(np.abs(drawn[0] - drawn[1]) / (drawn[1] + 0.01)) < 0.1 * equivalence.MARGIN


def test_few_samples_of_a_ball_are_even():
    """Places on the surface of a sphere light, half of which face away, leave 1.8 % with 16 passes; those inside, at most
    half."""
    stage, images = inProcess.scene("lightSphere"), {}
    for backend, samples in (("raster", 16), ("embree", 512)):
        images[backend] = inProcess.Stage(stage, "--backend", backend, "--samples", samples, "-w", 64, "--maxDepth", 1).image(0)
    off = np.abs(images["raster"] - images["embree"]).mean(axis=2) / (images["embree"].mean(axis=2) + 0.02)
    assert np.median(off) <= 0.009, float(np.median(off))


DOMES = ("lightDome", "roughConductor")


@pytest.fixture(scope="module")
def skies():
    """Scene -> its converged direct light, and how to rasterize it."""
    return {name: (inProcess.references(inProcess.scene(name), [7], "-w", 64, "--samples", 256, "--maxDepth", 1)[0],
                   inProcess.Stage(inProcess.scene(name), "--backend", "raster", "-w", 64)) for name in DOMES}


@pytest.mark.parametrize("scene", DOMES)
@pytest.mark.parametrize("method", ["filtered", "harmonics", "prefiltered"])
def test_a_method_of_domes_keeps_the_tolerance_that_it_would_be_taken_for(method, scene, skies):
    """A method is taken where its error in the table is at most 0.4 of the tolerance: the whole image has to be within it."""
    truth, stage = skies[scene]
    image = stage.image(0, samples=32, tolerance=1.0, methods={"domeLight": method}) @ LUMINANCE
    plans = stage.state["plans"].values()
    error = max(c["error"] for plan in plans for c in plan["choices"] if c["point"] == "domeLight")
    off = relative_error(image, truth @ LUMINANCE)
    assert 0.0 < off <= error / 0.4, (off, error)


def test_harmonics_have_a_window_against_ringing():
    """A ball under a sky with one bright texel: bare harmonics of order 2 ring, and what is below zero is black."""
    sky = sweepsSky.one_texel()
    truth, ringing = sweepsSky.irradiance(sky), np.maximum(sweepsSky.irradiance(sky, 2), 0.0)
    drawn = sweepsSky.render(sky, sweepsSky.DIFFUSE, "raster", 16, "--method", "domeLight=harmonics")
    assert np.abs(drawn - truth).mean() < 0.4 * np.abs(ringing - truth).mean()
