# SPDX-License-Identifier: Apache-2.0
"""Features of lights, drawn by the rasterizer and by the path tracer: the answer has to be the same, by equivalence.py.

Every stage is a floor with a block on it under one kind of light.
"""
import dataclasses

import numpy as np
import pytest

import equivalence
import floorLights
import inProcess
import sameImage
from floorLights import STAGE, light, write
from patina.chart import sweepsSky
from patina.experiment import LUMINANCE, relative_error
from usda import floor, mesh, preview, prim

pytestmark = pytest.mark.usefixtures("opengl")

NO_HEADLIGHT = "--disableCameraLight"


def linked(only, which):
    return f"uniform bool collection:{which}:includeRoot = 0", f"rel collection:{which}:includes = [{only}]"


def many_links():
    """More links than a machine word has bits; each light has its own, the last ones light the block alone."""
    return "".join(light("SphereLight", *linked("</World/block>" if i > 64 else "</World/floor>", "lightLink"),
                         name=f"light{i}", intensity=4, radius=0.1, specular=0.5 + 0.001 * i,
                         place={"at": (-2 + 0.06 * i, 2.5, 0.4)}) for i in range(68))


def many_domes():
    """More domes than a pass takes, each of its own colour."""
    return "".join(light("DomeLight", name=f"sky{i}", color=(0.01 * (i % 7), 0.02, 0.002 * (40 - i)), place={})
                   for i in range(40))


PROFILED = "asset inputs:shaping:ies:file = @./lamp.ies@"
IMAGE = "asset inputs:texture:file = @./image.exr@"
BALL = {"intensity": 40, "radius": 0.2}
CASES = {
    "profile": light("SphereLight", PROFILED, intensity=0.05, radius=0.2, apis=("ShapingAPI",)),
    "profileNormalized": light("DiskLight", PROFILED, "float inputs:shaping:ies:angleScale = 0.3",
                               "bool inputs:shaping:ies:normalize = 1", intensity=100, radius=0.3, apis=("ShapingAPI",)),
    "rectImage": light("RectLight", IMAGE, intensity=3, width=2, height=1),
    "shadowLink": light("SphereLight", *linked("</World/floor>", "shadowLink"), **BALL),
    "lightLink": light("SphereLight", *linked("</World/floor>", "lightLink"), **BALL),
    "manyLinks": many_links(),
    "shadowDistance": light("SphereLight", "float inputs:shadow:distance = 0.7", "float inputs:shadow:falloff = 0.5",
                            apis=("ShadowAPI",), **BALL),
    "shadowColor": light("SphereLight", "color3f inputs:shadow:color = (0.5, 0.1, 0.1)", apis=("ShadowAPI",), **BALL),
    "line": light("CylinderLight", "bool treatAsLine = 1", intensity=40, length=2, radius=0.02),
    "sun": light("DistantLight", intensity=2, angle=0),
    "twoDomes": (light("DomeLight", name="sky", color=(0.2, 0.3, 0.6), place={})
                 + light("DomeLight", IMAGE, name="dome", intensity=0.5, place={})),
    "manyDomes": many_domes(),
}
# A card where the block is: of a block, the near side alone would be known (test_byDesign.py).
CARD = mesh("card", [(0.1, 0.2, 0.4), (0.9, 0.2, 0.4), (0.9, 0.8, -0.4), (0.1, 0.8, -0.4)])
STAGES = {"shadowDistance": floorLights.world(floorLights.FLOOR, CARD, "%s")}
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


GLOSSY = preview("metal", inside="/World", diffuseColor=(0.9, 0.9, 0.9), metallic=1, roughness=0.35)


@pytest.mark.parametrize("angle", [4, 30, 120])
def test_wide_suns_are_shadowed_where_samples_of_the_material_find_them(angle, tmp_path):
    """Without a dome nothing else asks what hides far away light from such samples. The block stands in its mirror image."""
    sun = light("DistantLight", intensity=10, angle=angle, place={"turn": (-50, 170, 0)})
    mirror = floor("floor", 3, color=(0.6, 0.6, 0.6), bind="World/metal")
    power = dataclasses.replace(equivalence.FULL, widest=10 * equivalence.MARGIN)
    stage = floorLights.world(mirror, floorLights.BLOCK, sun, GLOSSY)
    sameImage.assert_same(write(tmp_path, stage), None, NO_HEADLIGHT, power=power)


INSIDE = prim("Sphere", "bulb", radius=0.3, at=(-1, 2, 0))


@pytest.mark.parametrize("kind", ["SphereLight", "CylinderLight"])
def test_what_is_inside_of_a_light_casts_nothing(kind, tmp_path):
    """Samples of a sphere light lie inside of it, but it shines from its surface."""
    lamp = light(kind, radius=0.4, intensity=4, place={"at": (-1, 2, 0)})
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
