# SPDX-License-Identifier: Apache-2.0
"""Stages of so many lights that each pixel takes a few: the mean of the passes is that of all lights.

Where lights are many, the path tracer has the truth. Where they are just enough, so has the rasterizer with one light less,
which evaluates all: the one more is dark. equivalence.py says how they are compared.
"""
import dataclasses
import itertools

import pytest

import equivalence
import floorLights
import inProcess
import sameImage
import usda
from floorLights import STAGE, light, write
from test_lights import linked

pytestmark = pytest.mark.usefixtures("opengl")

NO_HEADLIGHT = "--disableCameraLight"
POWER = dataclasses.replace(equivalence.FULL, samples=8)  # a pass draws hundreds of shadow maps
WIDTH = 24


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


CONE = {"apis": ("ShapingAPI",)}
KINDS = (  # type, lines, inputs
    ("SphereLight", (), {"intensity": 30, "radius": 0.06}),
    ("RectLight", (), {"intensity": 4, "width": 0.9, "height": 0.05}),
    ("DiskLight", (), {"intensity": 10, "radius": 0.15}),
    ("CylinderLight", (), {"intensity": 4, "length": 0.8, "radius": 0.04}),
    ("SphereLight", ("bool treatAsPoint = 1",), {"intensity": 1, "radius": 0.2}),
    ("CylinderLight", ("bool treatAsLine = 1",), {"intensity": 12, "length": 0.7, "radius": 0.01}),
    ("DiskLight", ("float inputs:shaping:cone:angle = 35", "float inputs:shaping:cone:softness = 0.4"),
     {"intensity": 40, "radius": 0.1, **CONE}),
    ("SphereLight", ("asset inputs:shaping:ies:file = @./lamp.ies@",), {"intensity": 0.02, "radius": 0.1, **CONE}),
)


def kinds(number, chosen=KINDS, more=lambda i: ()):
    lights = ""
    for i, (x, y, z) in enumerate(grid(number)):
        kind, lines, inputs = chosen[i % len(chosen)]
        place = {"at": (f"{x:g}", f"{y:g}", f"{z:g}"), "turn": (-90, 0, 0)}
        lights += light(kind, *lines, *more(i), name=f"light{i}", color=(0.4 + 0.6 * (i % 2), 0.7, 1 - 0.3 * (i % 3)),
                        place=place, **inputs)
    return lights


def signs(i):
    """Every third light is dark or takes light away, every fifth one lights or shadows one of both things."""
    lines = (f"float inputs:exposure = {-40 if i % 2 else -1}",) if i % 3 == 0 else ()
    links = linked("</World/floor>" if i % 2 else "</World/block>", "lightLink" if i % 4 else "shadowLink")
    return lines + (links if i % 5 == 0 else ())


SKY = (light("DomeLight", name="sky", color=(0.05, 0.08, 0.2), place={})
       + light("DistantLight", name="sun", intensity=0.4, angle=4))
FAR = STAGE.replace('def Xform "World"\n{', """def Xform "World"
{
    double3 xformOp:translate = (200000, -50000, 70000)
    float3 xformOp:scale = (100, 100, 100)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]""")
FAR = FAR.replace("metersPerUnit = 1\n", "metersPerUnit = 0.01\n")
DIM = [(kind, lines, {**inputs, "intensity": -inputs["intensity"] if i % 4 == 1 else inputs["intensity"]})
       for i, (kind, lines, inputs) in enumerate(KINDS)]


MATERIALS = {  # nodes, and the terminals that are not the surface alone
    "mirror": ({"metal": ("ND_conductor_bsdf", {"roughness": (0.01, 0.01)}),
                "surface": ("ND_surface", {"bsdf": "<metal>"})}, {}),
    "coat": ({"coat": ("ND_dielectric_bsdf", {"ior": 1.5, "roughness": (0.1, 0.1), "scatter_mode": "R"}),
              "paint": ("ND_oren_nayar_diffuse_bsdf", {"color": (0.5, 0.2, 0.1)}),
              "layer": ("ND_layer_bsdf", {"top": "<coat>", "base": "<paint>"}),
              "surface": ("ND_surface", {"bsdf": "<layer>"})}, {}),
    "milk": ({"vdf": ("ND_anisotropic_vdf", {"vector3f absorption": (0.1, 0.2, 0.4), "vector3f scattering": (1, 1, 1)}),
              "glass": ("ND_dielectric_bsdf", {"ior": 1.4, "roughness": (0.2, 0.2), "scatter_mode": "RT"}),
              "layer": ("ND_layer_vdf", {"top": "<glass>", "base": "<vdf>"}),
              "surface": ("ND_surface", {"bsdf": "<layer>"}),
              "volume": ("ND_volume", {"vdf": "<vdf>"})}, {"surface": "surface", "volume": "volume"}),
}


def bound(lights, name):
    """:returns: the stage with a block of a material"""
    nodes, terminals = MATERIALS[name]
    block = usda.prim("Cube", "block", size=0.8, at=(0.5, 0.4, 0), color=(0.6, 0.3, 0.2), bind="material")
    return floorLights.world(floorLights.FLOOR, block, lights) + usda.material("material", nodes, **terminals)


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
        lights = kinds(16, KINDS[:5]) + dark * light("SphereLight", name="dark", intensity=0)
        stage = inProcess.Stage(write(tmp_path / folder, bound(lights, name)), "--backend", "raster", "-w", 32,
                                "--samples", POWER.samples, NO_HEADLIGHT)
        renders.append(lambda seeds, stage=stage: [stage.image(seed) for seed in seeds])
    verdict, chosen, _ = equivalence.decide(*renders, POWER)
    assert chosen.mean() > 1e-3, "the light is off"
    assert not verdict.differs.any() and not verdict.open, verdict.text()
