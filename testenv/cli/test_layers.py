# SPDX-License-Identifier: Apache-2.0
"""Layers as they are meant beside a random walk, which meets closed forms: `returned` is at most half as far from it as albedo
scaling, and positionFree is a walk itself."""
import json
import math

import numpy as np
import pytest

from patina.cli import layers, main

SAMPLES = 6000
RETURNED = {"layering": "returned"}


def fresnel(c, eta):
    g = np.sqrt(np.maximum(eta * eta + c * c - 1.0, 0.0))
    s, p = (c - g) / (c + g), (eta * eta * c - g) / (eta * eta * c + g)
    return 0.5 * (s * s + p * p)


@pytest.mark.parametrize("eta", [1.3, 1.5, 2.0])
@pytest.mark.parametrize("grey", [1.0, 0.5, 0.2])
def test_walk_meets_the_closed_form(eta, grey):
    """A smooth interface over Lambert: a geometric series of diffuse light between both."""
    c = (np.arange(20000) + 0.5) / 20000
    inside = 1.0 - (1.0 - np.mean(2.0 * c * fresnel(c, eta))) / eta ** 2
    generator = np.random.default_rng(5)
    probes = layers.parts([(eta, 0.0)], (grey,) * 3, {})
    for degrees in (0.0, 60.0):
        t = math.radians(degrees)
        r = float(fresnel(math.cos(t), eta))
        expected = r + (1.0 - r) * grey * (1.0 - inside) / (1.0 - grey * inside)
        found, error = layers.walk(probes, (math.sin(t), 0.0, math.cos(t)), SAMPLES, generator)
        assert abs(found[1] - expected) < 4.0 * error[1] + 1e-4, (degrees, found, expected)


def test_walk_through_one_interface_and_a_black_base_is_its_reflection():
    probes = layers.parts([(1.5, 0.0)], (0.0,) * 3, {})
    found, error = layers.walk(probes, (0.0, 0.0, 1.0), SAMPLES, np.random.default_rng(1))
    assert abs(found[0] - 0.04) < 4.0 * error[0]


@pytest.mark.parametrize("stack", list(layers.STACKS))
def test_layers_are_off_by_half_of_those_that_ignore_what_comes_back(stack):
    """Over white both are exact. Of three angles and channels, the walk's noise is 4 standard errors: 1 in 1700 by
    chance, with numbers that are the same in every run."""
    interfaces, base = layers.STACKS[stack]
    generator = np.random.default_rng(0)
    count = 0
    for degrees, ours, true, noise in layers.compare(interfaces, base, RETURNED, SAMPLES, generator):
        wo = np.array([[math.sin(math.radians(degrees)), 0.0, math.cos(math.radians(degrees))]], np.float32)
        others = layers.scaled(interfaces, base, {}).albedo(wo)[0]
        assert np.all(np.abs(ours - true) < 0.5 * np.abs(others - true) + 4.0 * noise + 0.002), (degrees, ours, others, true)
        assert np.all(ours <= others + 1e-4)
        count += 1
    assert count == len(layers.ANGLES)


@pytest.mark.parametrize("alpha", [0.2, 0.4])
def test_dielectric_over_a_colour(alpha):
    """Albedo scaling is 35 to 72 % brighter than the walk here at alpha 0.2."""
    base = (0.7, 0.4, 0.2)
    for degrees, ours, true, noise in layers.compare([(1.5, alpha)], base, RETURNED, SAMPLES, np.random.default_rng(4)):
        assert np.all(np.abs(ours / true - 1.0) < 0.2 + 4.0 * noise / true), (degrees, ours, true)


def test_film_over_white_loses_nothing():
    """Light that the film takes from green and blue at 60 degrees goes through, by either meaning."""
    builder = layers._Builder()
    film = builder.node("ND_dielectric_bsdf", {"roughness": ("vector2", (0.0, 0.0)), "thinfilm_ior": ("float", 2.0),
                                               "thinfilm_thickness": ("float", 420.0)})
    bsdf = builder.node("ND_layer_bsdf", top=film, base=builder.base((1.0,) * 3))
    wo = np.array([[math.sin(math.radians(60)), 0.0, 0.5]], np.float32)
    for methods in ({}, RETURNED):
        assert builder.probe(bsdf, methods).albedo(wo)[0] == pytest.approx([1.0] * 3, abs=2e-3)
    assert builder.probe(bsdf, {"layerTransmittance": "largest"}).albedo(wo)[0] == pytest.approx([1.0, 0.87, 0.94], abs=0.02)


@pytest.mark.parametrize("stack", list(layers.STACKS))
def test_position_free_layers_are_the_walk(stack):
    """Both walk the same way, in code of their own. Differences of 4.5 standard errors happen once in 150000 times, and
    numbers are the same in every run."""
    interfaces, base = layers.STACKS[stack]
    generator = np.random.default_rng(3)
    layered = layers.scaled(interfaces, base, {"layering": "positionFree"})
    assert layered.stochastic
    probes = layers.parts(interfaces, base, {})
    for degrees in layers.ANGLES:
        t = math.radians(degrees)
        wo = np.array([math.sin(t), 0.0, math.cos(t)], np.float32)
        true, noise = layers.walk(probes, wo, SAMPLES, generator)
        found = layered.sample(np.tile(wo, (SAMPLES, 1)), generator.random((SAMPLES, 4), dtype=np.float32))["weight"]
        own = found.std(axis=0) / math.sqrt(SAMPLES)
        assert np.all(np.abs(found.mean(axis=0) - true) < 4.5 * np.hypot(noise, own) + 1e-4), (degrees, true)


def test_command(capsys):
    assert main.main(["check", "--layers", "--samples", "1024"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 1 + len(layers.STACKS) * len(layers.ANGLES)
    assert main.main(["check", "--layers", "--samples", "1024", "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["layers"]) == len(lines) - 1
    assert main.main(["check"]) == 2
    assert main.main(["check", "--layers", "some.mtlx"]) == 2
