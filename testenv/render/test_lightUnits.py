# SPDX-License-Identifier: Apache-2.0
"""The radiance of a white Lambertian floor under each light, against closed forms (see lightStages)."""
import math

import pytest

from lightStages import CASES, light, stage
from patina.experiment import LUMINANCE
from rendering import color, shot


def floor(folder, lamp, size, samples):
    """:returns: the image of a floor under a light"""
    return color(shot(folder, stage(lamp), "--camera", "/camera", "--imageWidth", size, "--imageHeight", size,
                      "--samples", samples))


@pytest.mark.parametrize("name", CASES)
def test_floor_under_a_light(tmp_path, name):
    text, irradiance = CASES[name]
    found = floor(tmp_path, text, 16, 1024).mean()
    # The camera sees 0.02 units of the floor: nothing varies. 262144 stratified samples.
    assert found == pytest.approx(0.5 * irradiance / math.pi, rel=5e-3, abs=1e-7)


def test_colour_temperature_6500_is_nearly_white(tmp_path):
    found = []
    for extra in ({}, {"enableColorTemperature": True, "colorTemperature": 6500}):
        lamp = light("DomeLight", intensity=1, place={}, **extra)
        found.append(floor(tmp_path, lamp, 8, 64).mean(axis=(0, 1)))
    assert found[1] == pytest.approx(found[0], rel=0.1)


@pytest.mark.parametrize("kelvin, warm", [(2000, True), (12000, False)])
def test_colour_temperature_tints_and_keeps_luminance(tmp_path, kelvin, warm):
    lamp = light("DomeLight", intensity=1, enableColorTemperature=True, colorTemperature=kelvin, place={})
    r, g, b = floor(tmp_path, lamp, 8, 256).mean(axis=(0, 1))
    assert (r > b) == warm
    assert LUMINANCE @ (r, g, b) == pytest.approx(0.5, rel=0.02)
