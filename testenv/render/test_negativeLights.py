# SPDX-License-Identifier: Apache-2.0
"""A light of negative intensity gives minus the picture of the positive one: the power without its sign chooses samples."""
import numpy as np
import pytest

from lightStages import ABOVE, light, stage
from rendering import color, shot
from usda import mesh

def glowing(intensity, color):
    return mesh("light", [(-1, 2, -1), (1, 2, -1), (1, 2, 1), (-1, 2, 1)],
                'uniform token light:materialSyncMode = "noMaterialResponse"', f"float inputs:intensity = {intensity}",
                f"color3f inputs:color = {color}", apis=("MeshLightAPI",))


LIGHTS = {
    "sphere": lambda **inputs: light("SphereLight", place=ABOVE, **inputs),
    "rect": lambda **inputs: light("RectLight", **inputs),
    "distant": lambda **inputs: light("DistantLight", angle=5, **inputs),
    "dome": lambda **inputs: light("DomeLight", place={}, **inputs),
    "mesh": glowing,
}


def picture(folder, name, intensity, *flags, tint=(1.0, 0.5, 0.25)):
    text = stage(LIGHTS[name](intensity=intensity, color=tint))
    return color(shot(folder, text, "--camera", "/camera", "--imageWidth", 8, "--imageHeight", 8, "--samples", 16, *flags))


@pytest.mark.parametrize("backend", ["embree", "raster"])
@pytest.mark.parametrize("name", LIGHTS)
def test_minus_the_picture_of_the_positive_light(tmp_path, name, backend):
    given = picture(tmp_path, name, 3.0, "--backend", backend)
    taken = picture(tmp_path, name, -3.0, "--backend", backend)
    assert given.min() > 0.0
    # The same samples with the other sign: the path tracer's sums round alike, the driver's to floats.
    assert np.abs(given + taken).max() <= (0.0 if backend == "embree" else 1e-5 * given.max())


def test_channels_have_signs_of_their_own(tmp_path):
    mixed = picture(tmp_path, "rect", 3.0, tint=(1.0, -0.5, 0.0))
    assert (mixed[..., 0] > 0.0).all() and (mixed[..., 2] == 0.0).all()
    assert np.allclose(mixed[..., 1], -0.5 * mixed[..., 0], rtol=1e-6)
