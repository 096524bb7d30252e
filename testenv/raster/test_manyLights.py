# SPDX-License-Identifier: Apache-2.0
"""Stages of so many lights that each pixel takes a few: the mean of the passes is that of all lights.

Where lights are many, the path tracer has the truth. Where they are just enough, so has the rasterizer with one light less,
which evaluates all: the one more is dark. equivalence.py says how they are compared.
"""
import dataclasses
import itertools

import pytest

pytest.importorskip("scipy.stats", reason="SciPy is not installed")

import equivalence  # noqa: E402
import inProcess  # noqa: E402
import sameImage  # noqa: E402
from floorLights import STAGE, light, write  # noqa: E402
from materialText import material  # noqa: E402
from test_lights import linked  # noqa: E402

pytestmark = pytest.mark.usefixtures("opengl")

NO_HEADLIGHT = "--disableCameraLight"
POWER = dataclasses.replace(equivalence.FULL, samples=8)  # a pass draws hundreds of shadow maps
WIDTH = 24


def place(x, y, z, turn=(-90, 0, 0)):
    return (f"        double3 xformOp:translate = ({x:g}, {y:g}, {z:g})\n        float3 xformOp:rotateXYZ = {turn}\n"
            '        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]\n')


def grid(number):
    """:returns: places above the floor and around it, at different heights; the camera sees none: edges of lights are noise"""
    found = []
    for i in itertools.count():
        x, y, z = -3.2 + 6.4 * (i * 0.618034 % 1), 0.5 + 2 * (i * 0.754878 % 1), -3.2 + 6.4 * (i * 0.569840 % 1)
        depth = 0.8 * (5.6 - y) + 0.6 * (4.2 - z)
        if max(abs(x), abs(0.6 * (y - 5.6) - 0.8 * (z - 4.2))) > 0.44 * depth + 0.5:
            found.append((x, y, z))
        if len(found) == number:
            return found


SHAPED = 'asset inputs:shaping:ies:file = @./lamp.ies@\n        float inputs:intensity = '
KINDS = (  # type, inputs, API
    ("SphereLight", "float inputs:intensity = 30\n        float inputs:radius = 0.06", ""),
    ("RectLight", "float inputs:intensity = 4\n        float inputs:width = 0.9\n        float inputs:height = 0.05", ""),
    ("DiskLight", "float inputs:intensity = 10\n        float inputs:radius = 0.15", ""),
    ("CylinderLight", "float inputs:intensity = 4\n        float inputs:length = 0.8\n        float inputs:radius = 0.04", ""),
    ("SphereLight", "float inputs:intensity = 1\n        bool treatAsPoint = 1\n        float inputs:radius = 0.2", ""),
    ("CylinderLight", "float inputs:intensity = 12\n        float inputs:length = 0.7\n        float inputs:radius = 0.01\n"
     "        bool treatAsLine = 1", ""),
    ("DiskLight", "float inputs:intensity = 40\n        float inputs:radius = 0.1\n"
     "        float inputs:shaping:cone:angle = 35\n        float inputs:shaping:cone:softness = 0.4", "ShapingAPI"),
    ("SphereLight", SHAPED + "0.02\n        float inputs:radius = 0.1", "ShapingAPI"),
)


def kinds(number, chosen=KINDS, more=lambda i: ""):
    lights = ""
    for i, (x, y, z) in enumerate(grid(number)):
        kind, inputs, api = chosen[i % len(chosen)]
        color = f"        color3f inputs:color = ({0.4 + 0.6 * (i % 2)}, 0.7, {1 - 0.3 * (i % 3)})\n"
        lights += light(kind, color + "        " + inputs + "\n" + more(i), f"light{i}", api, place(x, y, z))
    return lights


def signs(i):
    """Every third light is dark or takes light away, every fifth one lights or shadows one of both things."""
    text = ""
    if i % 3 == 0:
        text += f"        float inputs:exposure = {-40 if i % 2 else -1}\n"
    if i % 5 == 0:
        text += linked("</World/floor>" if i % 2 else "</World/block>", "lightLink" if i % 4 else "shadowLink") + "\n"
    return text


SKY = (light("DomeLight", "        color3f inputs:color = (0.05, 0.08, 0.2)", "sky", place="")
       + light("DistantLight", "        float inputs:intensity = 0.4\n        float inputs:angle = 4", "sun"))
FAR = STAGE.replace('def Xform "World"\n{', """def Xform "World"
{
    double3 xformOp:translate = (200000, -50000, 70000)
    float3 xformOp:scale = (100, 100, 100)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]""")
FAR = FAR.replace("metersPerUnit = 1\n", "metersPerUnit = 0.01\n")
DIM = [(k, t.replace("float inputs:intensity = ", "float inputs:intensity = -") if i % 4 == 1 else t, a)
       for i, (k, t, a) in enumerate(KINDS)]


MATERIALS = {  # outputs of the material, its nodes
    "mirror": ({"mtlx:surface": "surface"}, {
        "metal": ("ND_conductor_bsdf", {"float2 roughness": "(0.01, 0.01)"}),
        "surface": ("ND_surface", {"token bsdf": "<metal>"})}),
    "coat": ({"mtlx:surface": "surface"}, {
        "coat": ("ND_dielectric_bsdf", {"float ior": "1.5", "float2 roughness": "(0.1, 0.1)", "string scatter_mode": '"R"'}),
        "paint": ("ND_oren_nayar_diffuse_bsdf", {"color3f color": "(0.5, 0.2, 0.1)"}),
        "layer": ("ND_layer_bsdf", {"token top": "<coat>", "token base": "<paint>"}),
        "surface": ("ND_surface", {"token bsdf": "<layer>"})}),
    "milk": ({"mtlx:surface": "surface", "mtlx:volume": "volume"}, {
        "vdf": ("ND_anisotropic_vdf", {"vector3f absorption": "(0.1, 0.2, 0.4)", "vector3f scattering": "(1, 1, 1)"}),
        "glass": ("ND_dielectric_bsdf", {"float ior": "1.4", "float2 roughness": "(0.2, 0.2)", "string scatter_mode": '"RT"'}),
        "layer": ("ND_layer_vdf", {"token top": "<glass>", "token base": "<vdf>"}),
        "surface": ("ND_surface", {"token bsdf": "<layer>"}),
        "volume": ("ND_volume", {"token vdf": "<vdf>"})}),
}


def bound(stage, name):
    """:returns: the stage with a block of a material"""
    block = 'def Cube "block"'
    stage = stage.replace(f"{block}\n    {{", f'{block} (prepend apiSchemas = ["MaterialBindingAPI"])\n    {{\n'
                          "        rel material:binding = </material>")
    return stage + material("material", *MATERIALS[name])


CASES = {
    "kinds": STAGE % (kinds(48) + SKY),
    "linksAndSigns": STAGE % (kinds(36, DIM, signs) + SKY),
    "farInCentimetres": FAR % kinds(24, KINDS[:3]),
}


@pytest.mark.parametrize("name", sorted(CASES))
def test_pixels_that_choose_lights_find_the_path_tracers_light(name, tmp_path):
    sameImage.assert_same(write(tmp_path, CASES[name]), None, NO_HEADLIGHT, power=POWER, width=WIDTH)


@pytest.mark.parametrize("name", sorted(MATERIALS))
def test_choosing_among_just_enough_lights_changes_no_mean(name, tmp_path):
    """Materials that the two back ends do not draw alike are held to what the rasterizer draws where it takes all lights."""
    renders = []
    for folder, dark in (("choosing", 1), ("all", 0)):
        (tmp_path / folder).mkdir()
        lights = kinds(16, KINDS[:5]) + dark * light("SphereLight", "        float inputs:intensity = 0", "dark")
        stage = inProcess.Stage(write(tmp_path / folder, bound(STAGE % lights, name)), "--backend", "raster", "-w", 32,
                                "--samples", POWER.samples, NO_HEADLIGHT)
        renders.append(lambda seeds, stage=stage: [stage.image(seed) for seed in seeds])
    verdict, chosen, _ = equivalence.decide(*renders, POWER)
    assert chosen.mean() > 1e-3, "the light is off"
    assert not verdict.differs.any() and not verdict.open, verdict.text()
