# SPDX-License-Identifier: Apache-2.0
"""Values with a colour space have the colour that the renderer shows, on sliders and in what is saved."""
import numpy as np
import pytest

import _patina
from patina.view import layers, live

SRGB = [0.5, 0.25, 0.75]
LINEAR = [((v + 0.055) / 1.055) ** 2.4 for v in SRGB]  # IEC 61966-2-1


def network_of(space):
    network = _patina.Network("/m")
    network.add_node("/m/s", "ND_surface_unlit")
    network.set_input("/m/s", "emission_color", "color3", SRGB, space)
    network.set_terminal("surface", "/m/s", "out")
    return network


def emission(network):
    return _patina.MaterialProbe(network).emission(np.array([[0, 0, 1]], np.float32))[0]


@pytest.mark.parametrize("space, expected", [("srgb_rec709_scene", LINEAR), ("", SRGB), ("nobody knows", SRGB)])
def test_sliders_begin_at_the_colour_that_is_shown(space, expected):
    network = network_of(space)
    found, _ = live.live_inputs(network)
    slider = next(i for i in found if i.name == "emission_color")
    assert slider.value == pytest.approx(expected, abs=1e-6)
    moved = live.with_live(network, found, [found.index(slider)])
    assert emission(network) == pytest.approx(expected, abs=1e-6)
    assert emission(moved) == pytest.approx(expected, abs=1e-6)


def test_what_is_saved_is_linear(tmp_path):
    lines = [line for prim in layers.whole_material("m", network_of("srgb_rec709_scene"), [], str(tmp_path))["prims"]
             for line in prim["lines"] if "emission_color" in line]
    numbers = [float(x) for x in lines[0].partition("= (")[2].rstrip(")").split(",")]
    assert numbers == pytest.approx(LINEAR, abs=1e-6)
