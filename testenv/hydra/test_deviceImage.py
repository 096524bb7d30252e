# SPDX-License-Identifier: Apache-2.0
"""The rasterizer's image in an interactive host, which stays on the device, beside that of the film."""
import os

import numpy as np
import pytest

import hydraBuild
import stages
from rendering import pixels

# 3: smoothed; 20: past the first image and the smoothing. Light that is taken away; a lens; fibres, which have a box of their own.
CASES = [("shaderball", 3), ("lightDome", 1), ("lightDome", 20), ("lightNegative", 20), ("depthOfField", 20), ("hair", 3)]
SIZE = "48x32"


def drawn(tmp_path, scene, samples, interactive, aovs):
    """:returns: the channels of all AOVs"""
    image = tmp_path / f"{interactive}.exr"
    hydraBuild.run_host(os.path.join(stages.SCENES, f"{scene}.usda"), image, "--camera", "/World/camera", "--size", SIZE,
                        "--set", "backend=raster", "--set", f"samples={samples}", "--set", f"interactive={interactive}",
                        *(word for aov in aovs for word in ("--aov", aov)))
    return pixels(image).astype(np.float64)


@pytest.mark.parametrize("scene, samples", CASES)
def test_is_the_films(tmp_path, scene, samples):
    aovs = ("color=float32vec4", "depth=float32", "cameraDepth=float32", "elementId=int32", "Neye=float32vec3")
    device, film = (drawn(tmp_path, scene, samples, interactive, aovs) for interactive in ("true", "false"))
    assert film[..., :3].std() > 0.01 and len(np.unique(film[..., 6])) > 1
    # Sums of so many floats, each with roundings of its own, beside sums in double.
    bound = 4 * (samples + 4) * 2.0 ** -24
    for channel in range(film.shape[2]):
        largest = np.abs(film[..., channel]).max()
        assert np.abs(device[..., channel] - film[..., channel]).max() <= bound * largest, channel


@pytest.mark.parametrize("form, step", [("float16vec4", 2.0 ** -10), ("float16vec3", 2.0 ** -10), ("unorm8vec4", 1 / 255),
                                        ("float32vec3", 1e-6)])
def test_in_every_form(tmp_path, form, step):
    device, film = (drawn(tmp_path, "shaderball", 1, interactive, [f"color={form}"]) for interactive in ("true", "false"))
    assert device.shape == film.shape
    assert np.abs(device - film).max() <= 1.01 * step * max(1.0, film.max())
