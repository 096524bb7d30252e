# SPDX-License-Identifier: Apache-2.0
"""Refraction in the rasterizer, through surfaces that transmit: closed forms with a white sky of radiance 1."""
import numpy as np
import pytest

import inProcess
from usda import material
import usda

pytestmark = pytest.mark.usefixtures("opengl")

STAGE = usda.stage(
    usda.camera(flat=(20, 20), focalLength=50, clippingRange=(0.1, 1000), at=(0, 0, 10)),
    usda.prim("DomeLight", "sky", intensity=1),
    usda.prim("%(shape)s", "object", "%(geometry)s", bind="material"),
    usda.card("wall", 9, z=-3, bind="red", visibility="%(wall)s"),
    "%(materials)s")


def _materials(terminal, absorption, scattering):
    red = material("red", {
        "surface": ("ND_surface_unlit", {"emission_color": (0.5, 0.25, 0.125)})})
    return red + material("material", {
        "vdf": ("ND_anisotropic_vdf", {"vector3f absorption": absorption, "vector3f scattering": scattering}),
        "glass": ("ND_dielectric_bsdf", {"ior": 1.5, "roughness": (0, 0), "scatter_mode": "RT"}),
        "layer": ("ND_layer_vdf", {"top": "<glass>", "base": "<vdf>"}),
        "surface": ("ND_surface", {"bsdf": "<layer>"}),
        "volume": ("ND_volume", {"vdf": "<vdf>"}),
    }, **{terminal: terminal})


def _middle(tmp_path, samples=4, terminal="volume", absorption="(0, 0, 0)", scattering="(0, 0, 0)", **parts):
    """:returns: the mean of the pixels in the middle of the image"""
    words = {"shape": "Cube", "geometry": "double size = 0.8", "wall": "invisible"}
    words.update(parts, materials=_materials(terminal, absorption, scattering))
    found = inProcess.pixels(inProcess.shot(tmp_path, STAGE % words, "--backend", "raster", "--samples", samples, "-w", "24"))
    h, w = found.shape[:2]
    return found[h // 2 - 3:h // 2 + 3, w // 2 - 3:w // 2 + 3].mean(axis=(0, 1))


def test_fog_absorbs_by_its_thickness(tmp_path):
    sigma = np.array([0.25, 1.0, 2.0])
    np.testing.assert_allclose(_middle(tmp_path, absorption="(0.25, 1, 2)"), np.exp(-0.8 * sigma), rtol=2e-3)


def test_white_fog_loses_nothing(tmp_path):
    np.testing.assert_allclose(_middle(tmp_path, samples=32, scattering="(0.5, 1, 2)"), 1.0, rtol=0.05)


def test_fog_shows_what_is_behind(tmp_path):
    sigma = np.array([0.25, 1.0, 2.0])
    found = _middle(tmp_path, absorption="(0.25, 1, 2)", wall="inherited")
    np.testing.assert_allclose(found, np.exp(-0.8 * sigma) * [0.5, 0.25, 0.125], rtol=2e-3)


GLASS = {"terminal": "surface", "shape": "Sphere", "geometry": "double radius = 0.6"}


def test_clear_glass_in_even_light_is_not_seen(tmp_path):
    np.testing.assert_allclose(_middle(tmp_path, samples=32, **GLASS), 1.0, rtol=0.02)


def test_glass_shows_the_wall_behind(tmp_path):
    found = _middle(tmp_path, samples=64, wall="inherited", **GLASS)
    # Head-on 4 % is reflected, from the white sky. Rays that leave the screen find that sky too, hence the tolerance.
    np.testing.assert_allclose(found, 0.96 * np.array([0.5, 0.25, 0.125]) + 0.04, rtol=0.2)


@pytest.mark.parametrize("sigma", [0.5, 2.0])
def test_coloured_glass_absorbs_along_the_bent_path(tmp_path, sigma):
    found = _middle(tmp_path, samples=32, absorption=f"({sigma}, {sigma}, {sigma})", terminal="surface")
    np.testing.assert_allclose(found, 0.04 + 0.96 * np.exp(-0.8 * sigma), rtol=0.05)
