"""What lights can do, drawn by the rasterizer and by the path tracer: the answer has to be the same.

Every stage is a floor with a block on it under one kind of light. The limits are about twice what was measured with these
very settings; both images are made of fixed seeds, so that a difference is a change of the code.
"""
import os

import numpy as np
import pytest

import bothBackEnds
from patina.chart import sweepsSky

STAGE = """#usda 1.0
(
    defaultPrim = "World"
    upAxis = "Y"
    metersPerUnit = 1
)
def Xform "World"
{
    def Camera "camera"
    {
        float2 clippingRange = (0.01, 1000)
        float focalLength = 24
        float horizontalAperture = 20.955
        float verticalAperture = 20.955
        matrix4d xformOp:transform = ((1, 0, 0, 0), (0, 0.6, -0.8, 0), (0, 0.8, 0.6, 0), (0, 5.6, 4.2, 1))
        uniform token[] xformOpOrder = ["xformOp:transform"]
    }
    def Mesh "floor"
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)]
        uniform token subdivisionScheme = "none"
        color3f[] primvars:displayColor = [(0.6, 0.6, 0.6)]
    }
    def Cube "block"
    {
        double size = 0.8
        double3 xformOp:translate = (0.5, 0.4, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        color3f[] primvars:displayColor = [(0.6, 0.3, 0.2)]
    }
%s
}
"""

PROFILE = """IESNA:LM-63-1995
TILT=NONE
1 1000 1 5 5 1 1 0 0 0
1.0 1.0 100
0 20 40 60 90
0 90 180 270 360
1000 900 500 100 0
1000 600 200 50 0
1000 300 100 20 0
1000 600 400 50 0
1000 900 500 100 0
"""

ASIDE = """        double3 xformOp:translate = (-2.2, 3.5, 2.5)
        float3 xformOp:rotateXYZ = (-50, -40, 0)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
"""


def light(kind, text, name="light", api="", place=ASIDE):
    prepend = f'(\n        prepend apiSchemas = ["{api}"]\n    )\n' if api else ""
    return f'    def {kind} "{name}" {prepend}\n    {{\n{text}\n{place}    }}\n'


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


def _image(folder):
    import _patina

    values = np.zeros((8, 8, 3), np.float32)
    values[:, :3] = (0.1, 0.2, 1.0)
    values[2:4, 5:7] = (20.0, 10.0, 2.0)
    _patina.write_image(os.path.join(folder, "image.exr"), values, ["R", "G", "B"])


def many_domes():
    """More domes than a pass takes, each of its own colour."""
    return "".join(light("DomeLight", f"        color3f inputs:color = ({0.01 * (i % 7)}, 0.02, {0.002 * (40 - i)})", f"sky{i}",
                         place="") for i in range(40))


# Name: lights, largest bias of the mean, largest relative difference of an 8x8 block.
CASES = {
    "profile": (light("SphereLight", '        float inputs:intensity = 0.05\n        float inputs:radius = 0.2\n'
                      '        asset inputs:shaping:ies:file = @./lamp.ies@', api="ShapingAPI"), 0.02, 0.1),
    "profileNormalized": (light("DiskLight", '        float inputs:intensity = 100\n        float inputs:radius = 0.3\n'
                                '        asset inputs:shaping:ies:file = @./lamp.ies@\n'
                                '        float inputs:shaping:ies:angleScale = 0.3\n'
                                '        bool inputs:shaping:ies:normalize = 1', api="ShapingAPI"), 0.02, 0.1),
    "rectImage": (light("RectLight", '        float inputs:intensity = 3\n        float inputs:width = 2\n'
                        '        float inputs:height = 1\n        asset inputs:texture:file = @./image.exr@'), 0.08, 0.15),
    "shadowLink": (light("SphereLight", "        float inputs:intensity = 40\n        float inputs:radius = 0.2\n"
                         + linked("</World/floor>", "shadowLink")), 0.02, 0.1),
    "lightLink": (light("SphereLight", "        float inputs:intensity = 40\n        float inputs:radius = 0.2\n"
                        + linked("</World/floor>", "lightLink")), 0.02, 0.2),
    "manyLinks": (many_links(), 0.04, 0.35),
    "shadowDistance": (light("SphereLight", "        float inputs:intensity = 40\n        float inputs:radius = 0.2\n"
                             "        float inputs:shadow:distance = 0.7\n        float inputs:shadow:falloff = 0.5",
                             api="ShadowAPI"), 0.02, 0.15),
    "shadowColor": (light("SphereLight", "        float inputs:intensity = 40\n        float inputs:radius = 0.2\n"
                          "        color3f inputs:shadow:color = (0.5, 0.1, 0.1)", api="ShadowAPI"), 0.02, 0.1),
    "line": (light("CylinderLight", "        float inputs:intensity = 40\n        float inputs:length = 2\n"
                   "        float inputs:radius = 0.02\n        bool treatAsLine = 1"), 0.02, 0.1),
    "sun": (light("DistantLight", "        float inputs:intensity = 2\n        float inputs:angle = 0"), 0.02, 0.1),
    "twoDomes": (light("DomeLight", "        color3f inputs:color = (0.2, 0.3, 0.6)", "sky", place="")
                 + light("DomeLight", "        asset inputs:texture:file = @./image.exr@\n"
                         "        float inputs:intensity = 0.5", "dome", place=""), 0.03, 0.15),
    "manyDomes": (many_domes(), 0.02, 0.1),
}


@pytest.fixture(scope="module", autouse=True)
def opengl():
    reason = bothBackEnds.without_opengl()
    if reason:
        pytest.skip(reason)


def pair(folder, lights, *arguments, samples=48, stage=STAGE):
    (folder / "stage.usda").write_text(stage % lights)
    (folder / "lamp.ies").write_text(PROFILE)
    _image(str(folder))
    images = []
    for backend, extra in (("raster", arguments), ("embree", ("--maxDepth", "1"))):
        image = str(folder / (backend + ".exr"))
        bothBackEnds.record(str(folder / "stage.usda"), image, "--backend", backend, "--samples", str(samples), "-w", "48",
                            "--disableCameraLight", *extra)
        images.append(bothBackEnds.pixels(image))
    return images


@pytest.mark.parametrize("name", sorted(CASES))
def test_light_is_the_path_tracers(name, tmp_path):
    lights, bias, worst = CASES[name]
    # Few texels of the image give nearly all of its light.
    raster, traced = pair(tmp_path, lights, samples=192 if name == "rectImage" else 48)
    assert traced.mean() > 0.01, "the light is off"
    found = bothBackEnds.numbers(raster, traced)
    assert abs(found["bias"]) <= bias, found
    assert found["worst"] <= worst, found


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
    stage = stage.replace('        point3f[] points', "        rel material:binding = </World/metal>\n        point3f[] points", 1)
    raster, traced = pair(tmp_path, sun + GLOSSY, samples=96, stage=stage)
    found = bothBackEnds.numbers(raster, traced)
    assert abs(found["bias"]) <= 0.02 and found["worst"] <= 0.12, found


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
    (tmp_path / "with").mkdir()
    (tmp_path / "without").mkdir()
    full, traced = pair(tmp_path / "with", lamp + INSIDE)
    empty, _ = pair(tmp_path / "without", lamp)
    found = bothBackEnds.numbers(full, traced)
    assert abs(found["bias"]) <= 0.01 and found["worst"] <= 0.1, found
    # The ball stretches what shadow maps hold, so that depths are rounded otherwise: 1e-3 of the values.
    # A tenth of the light's samples in its shadow would be a hundred times that.
    np.testing.assert_allclose(full, empty, atol=2e-3)


def test_few_samples_of_a_ball_are_even(tmp_path):
    """Places on the surface of a sphere light, half of which face away, leave 1.8 % with 16 passes."""
    stage, images = os.path.join(bothBackEnds.SCENES, "lightSphere.usda"), {}
    for backend, samples in (("raster", 16), ("embree", 512)):
        image = str(tmp_path / (backend + ".exr"))
        bothBackEnds.record(stage, image, "--backend", backend, "--samples", str(samples), "-w", "64", "--maxDepth", "1")
        images[backend] = bothBackEnds.pixels(image)
    off = np.abs(images["raster"] - images["embree"]).mean(axis=2) / (images["embree"].mean(axis=2) + 0.02)
    assert np.median(off) <= 0.005, float(np.median(off))


# Method: scene, largest bias of the mean, largest relative difference of an 8x8 block. What remains is the method's own.
METHODS = [
    ("filtered", "lightDome", 0.05, 0.3),
    ("filtered", "roughConductor", 0.1, 0.6),
    ("harmonics", "lightDome", 0.1, 0.4),
    ("harmonics", "roughConductor", 0.1, 0.6),
    ("prefiltered", "lightDome", 0.1, 0.4),
    ("prefiltered", "roughConductor", 0.15, 0.8),
]


@pytest.fixture(scope="module")
def references(tmp_path_factory):
    """Scene -> what the path tracer shows of it, and how noisy a pass of the sampling method is."""
    folder, found = tmp_path_factory.mktemp("references"), {}
    for scene in ("lightDome", "roughConductor"):
        image = str(folder / (scene + ".exr"))
        stage = os.path.join(bothBackEnds.SCENES, scene + ".usda")
        bothBackEnds.record(stage, image, "--backend", "embree", "--samples", "128", "-w", "64", "--maxDepth", "1")
        found[scene] = bothBackEnds.pixels(image)
    return found


@pytest.mark.parametrize("method,scene,bias,worst", METHODS)
def test_other_methods_of_domes_are_near(method, scene, bias, worst, references, tmp_path):
    stage, image = os.path.join(bothBackEnds.SCENES, scene + ".usda"), str(tmp_path / "image.exr")
    bothBackEnds.record(stage, image, "--backend", "raster", "--samples", "8", "-w", "64", "--method", "domeLight=" + method)
    found = bothBackEnds.numbers(bothBackEnds.pixels(image), references[scene])
    assert abs(found["bias"]) <= bias, found
    assert found["worst"] <= worst, found


def test_one_filtered_pass_has_less_noise_than_one_sampled_pass(references, tmp_path):
    stage, error = os.path.join(bothBackEnds.SCENES, "roughConductor.usda"), {}
    for method in ("sampled", "filtered"):
        image = str(tmp_path / (method + ".exr"))
        bothBackEnds.record(stage, image, "--backend", "raster", "--samples", "1", "-w", "64", "--method",
                            "domeLight=" + method)
        error[method] = bothBackEnds.numbers(bothBackEnds.pixels(image), references["roughConductor"])["relMSE"]
    assert error["filtered"] < error["sampled"], error


def test_harmonics_ring_only_without_a_window():
    """A ball under a sky with one bright texel, whose harmonics of order 2 are known: what is below zero is black."""
    sky = sweepsSky.one_texel()
    truth, ringing = sweepsSky.irradiance(sky), np.maximum(sweepsSky.irradiance(sky, 2), 0.0)
    error = {}
    for method in ("harmonics", "harmonicsUnwindowed"):
        drawn = sweepsSky.render(sky, sweepsSky.DIFFUSE, "raster", 16, "--method", "domeLight=" + method)
        error[method] = float(np.abs(drawn - truth).mean() / truth.mean())
        if method == "harmonicsUnwindowed":
            assert np.abs(drawn - ringing).max() < 0.05 * ringing.max()
    assert error["harmonics"] < 0.4 * error["harmonicsUnwindowed"], error
