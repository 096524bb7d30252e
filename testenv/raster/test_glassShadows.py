# SPDX-License-Identifier: Apache-2.0
"""Light that reaches a floor through refracting things, which cast a part of a shadow: closed forms with a sun overhead."""
import numpy as np
import pytest

import inProcess
from usda import material
import usda

pytestmark = pytest.mark.usefixtures("opengl")

# The camera sees the floor below the slab, and not the slab.
STAGE = usda.stage(
    usda.camera(flat=(20, 20), focalLength=50, clippingRange=(0.1, 4), at=(0, 2, 0), turn=(-90, 0, 0)),
    usda.prim("DistantLight", "sun", angle=0, turn="(%(turn)s, 0, 0)"),
    usda.floor("floor", 9, color=(0.5, 0.5, 0.5)),
    "%(object)s", "%(materials)s")

SLAB = usda.prim("Cube", "slab", bind="material", at=(0, 5, 0), scale=(20, 0.1, 20))


def floor(folder, thing, turn=-90, **inputs):
    """:returns: what the floor reflects, shape (3,), of the rasterizer"""
    nodes = {"ior": ("float", "1.5"), "roughness": ("float2", "(0, 0)"), "scatter_mode": ("string", "RT"), **inputs}
    glass = material("material", {
        "glass": ("ND_dielectric_bsdf", {f"{kind} {name}": value for name, (kind, value) in nodes.items()}),
        "surface": ("ND_surface", {"bsdf": "<glass>"}),
    })
    text = STAGE % {"object": thing, "materials": glass, "turn": turn}
    image = inProcess.shot(folder, text, "--backend", "raster", "--samples", "64", "-w", "32", "--disableCameraLight")
    return inProcess.pixels(image).mean(axis=(0, 1))


def fresnel(cosine, ior):
    """:returns: unpolarised reflectance of a dielectric, from outside"""
    inside = np.sqrt(1 - (1 - cosine ** 2) / ior ** 2)
    s = (cosine - ior * inside) / (cosine + ior * inside)
    p = (ior * cosine - inside) / (ior * cosine + inside)
    return (s * s + p * p) / 2


# Inputs, angle of the sun from the zenith in degrees, share of both faces for an index of refraction of 1.5.
CASES = {
    "clear": ({}, 0, 1.0),
    "slanting": ({}, 60, 1.0),
    "tinted": ({"tint": ("color3f", "(0.5, 0.5, 0.5)")}, 0, 0.25),
    "rough": ({"roughness": ("float2", "(0.1, 0.1)")}, 0, 1.0),
}


@pytest.mark.parametrize("name", sorted(CASES))
def test_a_slab_of_glass_lets_light_through(tmp_path, name):
    """1024 pixels of 64 passes: the chances leave 0.2 % of standard deviation, the limit is 1 %."""
    inputs, degrees, share = CASES[name]
    (tmp_path / "without").mkdir()
    open_sky = floor(tmp_path / "without", "", degrees - 90)
    found = floor(tmp_path, SLAB, degrees - 90, **inputs) / open_sky
    expected = share * (1 - fresnel(np.cos(np.radians(degrees)), 1.5)) ** 2
    np.testing.assert_allclose(found, expected, atol=0.01)


def test_what_only_reflects_casts_a_whole_shadow(tmp_path):
    assert floor(tmp_path, SLAB, scatter_mode=("string", "R")).max() == 0.0
