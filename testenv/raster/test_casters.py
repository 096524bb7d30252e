# SPDX-License-Identifier: Apache-2.0
"""Shadows that both back ends find alike: of what is cut out by a texture, and on surfaces that bend towards the light."""
import os

import numpy as np
import pytest

import floorLights
import sameImage
from usda import ST, floor, material, mesh, prim

pytestmark = pytest.mark.usefixtures("opengl")

STAGE = floorLights.world("%s")
# The panel shows its back to the camera, which looks through it.
PANEL = (
    prim("DomeLight", "sky")
    + floor("floor", 9, color=(0.6, 0.6, 0.6))
    + mesh("panel", [(-1.5, 0.5, -1.5), (1.5, 0.5, -1.5), (1.5, 0.5, 1.5), (-1.5, 0.5, 1.5)], bind="World/cut", st=ST)
    + material("cut", {
        "surface": ("UsdPreviewSurface", {"opacityThreshold": 0.5, "float opacity": "<image>"}),
        "image": ("UsdUVTexture", {"file": "holes.exr", "token sourceColorSpace": "raw", "float2 st": "<st>"},
                  "float r"),
        "st": ("UsdPrimvarReader_float2", {"varname": "st"})}, inside="/World"))
STAIRS = (
    prim("DistantLight", "sun", angle=2, intensity=300, turn="(%s, 0, 0)")
    + prim("Mesh", "stairs", faceVertexCounts="%s", faceVertexIndices="%s", points="%s", subdivisionScheme="%s",
           color=(0.6, 0.6, 0.6)))


def _write(folder, contents):
    (folder / "stage.usda").write_text(STAGE % contents)
    return str(folder / "stage.usda")


def _extruded(profile, turn, scheme):
    """:param profile: (z, y) along the stairs
    :param turn: of the sun about x, in degrees; -90 is straight above"""
    points = [(x, y, z) for z, y in profile for x in (-2.0, -1.0, 0.0, 1.0, 2.0)]
    faces = [(5 * k + i, 5 * k + i + 1, 5 * k + i + 6, 5 * k + i + 5) for k in range(len(profile) - 1) for i in range(4)]
    return STAIRS % (turn, [4] * len(faces), [i for face in faces for i in face], points, scheme)


def test_a_cutout_casts_the_same_shadow_however_light_is_found(tmp_path):
    """Three of eight texels are there: in the mean, which a blurred texture shows, the panel is not."""
    import _patina

    y, x = np.mgrid[0:64, 0:64]
    there = ((x // 2 + 3 * (y // 2)) % 8 < 3).astype(np.float32)
    _patina.write_image(os.path.join(str(tmp_path), "holes.exr"), np.repeat(there[..., None], 3, axis=2), ["R", "G", "B"])
    drawn, _ = sameImage.assert_same(_write(tmp_path, PANEL), width=24)
    assert drawn[12, 12, 1] < 0.8 * drawn[12, 1, 1]  # there is a shadow


def test_a_surface_that_bends_towards_the_light_does_not_hide_itself(tmp_path):
    """Steps with rounded corners, whose treads and risers all face the sun: no point is in shadow."""
    profile = [(2.4, 0.0)]
    for i in range(8):
        z, y, r = 2.1 - 0.5 * i, 0.2 * i, 0.04
        profile += [(z + r, y), (z, y), (z, y + r), (z, y + 0.2 - r), (z, y + 0.2), (z - r, y + 0.2)]
    sameImage.assert_same(_write(tmp_path, _extruded(profile, -75, "catmullClark")), None, "--disableCameraLight", width=32)


def test_grooves_as_narrow_as_texels_do_not_hide_themselves(tmp_path):
    """Both walls of every groove face the sun, at 60 degrees: no point is in shadow, and a texel (0.02 wide here) says
    nothing of its neighbours."""
    profile = [(1.5 - 0.018 * i, 0.031 * (i % 2)) for i in range(167)]
    sameImage.assert_same(_write(tmp_path, _extruded(profile, -90, "none")), None, "--disableCameraLight", width=32)
