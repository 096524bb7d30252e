# SPDX-License-Identifier: Apache-2.0
"""Mixed surface shaders, back shaders and unlit surfaces, from stage to picture."""
import numpy as np
import pytest

from test_features import distant, glow, lambert, quad, render
from usda import material

FACING = distant("sun")


def unlit(name, **inputs):
    return material(name, {"surface": ("ND_surface_unlit", inputs)})


def two_sided(name):
    """Front diffuse 0.5, back emitting green."""
    return material(name, {
        "diffuse": ("ND_oren_nayar_diffuse_bsdf", {"color": (0.5, 0.5, 0.5)}),
        "front": ("ND_surface", {"bsdf": "<diffuse>"}),
        "behind": ("ND_surface_unlit", {"emission_color": (0, 1, 0)}),
        "surface": ("ND_surfacematerial", {"surfaceshader": "<front>", "backsurfaceshader": "<behind>"})})


def test_the_back_has_its_own_shader(tmp_path):
    turned = 'uniform token orientation = "leftHanded"'
    image = render(tmp_path, FACING, two_sided("both"), quad("front", 0, 0.9, -1, "both"),
                   quad("turned", 0, 0.9, 1, "both", turned))
    assert image[10:22, 4:12].mean() == pytest.approx(0.5, rel=0.01)  # one light of two is chosen each time
    assert image[16, 24] == pytest.approx([0, 1, 0], abs=1e-4)


def test_the_back_lights_what_is_behind(tmp_path):
    # A sheet whose back glows lies between the camera and a wall, and only the wall is lit by it.
    image = render(tmp_path, two_sided("both"), lambert("white", 0.5), quad("wall", -1.5, 2.4, 0),
                   quad("sheet", 0, 0.3, 0, "both"), samples=256)
    assert image[16, 16].max() < 0.05  # lit by the wall alone
    assert image[20, 16][1] > 0.01 and image[20, 16][0] == 0.0


def test_mixed_surfaces_show_both(tmp_path):
    body = material("mixed", {
        "diffuse": ("ND_oren_nayar_diffuse_bsdf", {"color": (0.8, 0.8, 0.8)}),
        "a": ("ND_surface", {"bsdf": "<diffuse>", "opacity": 0.5}),
        "b": ("ND_surface_unlit", {"emission_color": (0, 0, 1)}),
        "surface": ("ND_mix_surfaceshader", {"fg": "<a>", "bg": "<b>", "mix": 0.25})})
    # 0.25 * 0.5 of the diffuse part, 0.75 of the blue one, and 0.125 of the red behind.
    image = render(tmp_path, FACING, body, glow("red", (1, 0, 0)), quad("sheet", 0, 2.4, 0, "mixed"),
                   quad("wall", -3, 4, 0, "red"), samples=512)
    mean = image[8:24, 8:24].mean(axis=(0, 1))
    assert mean == pytest.approx([0.1 + 0.125, 0.1, 0.1 + 0.75], rel=0.01)


def test_what_passes_light_still_glows(tmp_path):
    pane = unlit("tinted", emission_color=(0, 0.25, 0), transmission=1, transmission_color=(1, 0.5, 1), opacity=1)
    image = render(tmp_path, pane, glow("bright", (1, 1, 1)), quad("pane", 0, 2.4, 0, "tinted"),
                   quad("wall", -3, 4, 0, "bright"), samples=64)
    # Light passes by chance 5/6, the mean of the channels. Six standard errors of 64 pixels: no one test in 10^8.
    error = 6 * np.sqrt((1 / 6) / (5 / 6) / (64 * 64))
    assert image[12:20, 12:20].mean(axis=(0, 1)) == pytest.approx([1, 0.75, 1], abs=error)


def test_half_present_lamps_light_by_half(tmp_path):
    # Light and path samples must agree on what a lamp that is half there gives.
    def lit(opacity):
        lamp = unlit("half", emission_color=(5, 5, 5), opacity=opacity)
        image = render(tmp_path, lamp, lambert("white", 0.5), quad("wall", -1, 2.4, 0),
                       quad("lamp", 4, 0.5, 2, "half"), samples=256, arguments=("--maxDepth", 1))
        return image[8:24, :16].mean()
    assert lit(0.5) == pytest.approx(0.5 * lit(1), rel=0.02)
