# SPDX-License-Identifier: Apache-2.0
"""Area lights by linearly transformed cosines: near the path tracer's answer, without noise, and samples where they must be.

Both images are made of fixed seeds, so that a difference is a change of the code.
"""
import numpy as np
import pytest

import floorLights
import inProcess
from floorLights import light
import usda

pytestmark = pytest.mark.usefixtures("opengl")

OUTLINES = {"areaLight": "linearlyTransformedCosines"}


def behind(kind, name, x, color, **inputs):
    """A light that the floor mirrors."""
    return light(kind, name=name, color=color, intensity=8, **inputs, place={"at": (x, 2.5, -3), "turn": (-140, 0, 0)})


# A channel each, but for the disk.
LIGHTS = (behind("RectLight", "rect", 0, (1, 0, 0), width=1.6, height=0.8)
          + behind("SphereLight", "sphere", 0, (0, 1, 0), radius=0.5)
          + behind("CylinderLight", "tube", -1, (0, 0, 1), length=2, radius=0.3)
          + behind("DiskLight", "disk", 1.6, (0, 0, 0.7), radius=0.4))


def preview(roughness, metallic):
    return "UsdPreviewSurface", {"diffuseColor": (0.4, 0.3, 0.2), "roughness": roughness, "metallic": metallic}


FLOOR, BLOCK = preview(0.5, 1), preview(0.35, 0)
BRUSHED = ("ND_open_pbr_surface_surfaceshader", {
    "base_color": (0.6, 0.5, 0.4), "base_metalness": 1, "specular_roughness": 0.4, "specular_roughness_anisotropy": 0.8})


def stage_of(folder, *arguments, lights=LIGHTS, floor=FLOOR, block=BLOCK):
    text = floorLights.world(
        usda.floor("floor", 3, color=(0.6, 0.6, 0.6), bind="World/ofFloor"),
        usda.prim("Cube", "block", size=0.8, at=(0.5, 0.4, 0), color=(0.6, 0.3, 0.2), bind="World/ofBlock"),
        lights,
        *(usda.material(name, {"surface": shader}, "/World") for name, shader in (("ofFloor", floor), ("ofBlock", block))))
    return inProcess.Stage(floorLights.write(folder, text), "-w", 48, "--disableCameraLight", *arguments)


def test_outlines_keep_the_tolerance_that_they_would_be_taken_for_and_have_no_noise(tmp_path):
    """They are taken where their error in the table is at most 0.4 of the tolerance: each channel has to be within it."""
    truth = stage_of(tmp_path, "--samples", 256, "--maxDepth", 1).image(7)
    drawn = stage_of(tmp_path, "--backend", "raster")
    outlines = drawn.image(0, samples=16, tolerance=1.0, methods=OUTLINES)
    error = max(c["error"] for plan in drawn.state["plans"].values()
                for c in plan["choices"] if c["point"] == "areaLight")
    for channel in range(3):
        assert truth[..., channel].mean() > 0.01, "a light is off"
        off = np.abs(outlines - truth)[..., channel] / (truth[..., channel] + 0.01)
        assert 0.0 < off.mean() <= error / 0.4, (channel, off.mean(), error)
    noise = {name: np.mean((drawn.image(1, samples=1, methods=methods) - outlines) ** 2 / (outlines ** 2 + 0.01))
             for name, methods in (("outline", OUTLINES), ("sampled", {}))}
    assert noise["outline"] < noise["sampled"], noise


def test_what_has_no_outline_is_sampled(tmp_path):
    """To the last bit: a profile, a cone, an image on a light, and then lobes that no transform stands for."""
    shaped = (light("SphereLight", "asset inputs:shaping:ies:file = @./lamp.ies@", name="profile", apis=("ShapingAPI",),
                    intensity=0.05, radius=0.2)
              + light("DiskLight", "float inputs:shaping:cone:angle = 20", name="cone", apis=("ShapingAPI",), intensity=30,
                      radius=0.3)
              + light("RectLight", "asset inputs:texture:file = @./image.exr@", name="picture", intensity=3))
    for name, changes in (("lights", {"lights": shaped}), ("lobes", {"floor": BRUSHED, "block": BRUSHED})):
        (tmp_path / name).mkdir()
        stage = stage_of(tmp_path / name, "--backend", "raster", "--samples", 2, **changes)
        sampled = stage.image(0)
        assert sampled.mean() > 0.003, "the light is off"
        assert np.array_equal(stage.image(0, methods=OUTLINES), sampled), name
