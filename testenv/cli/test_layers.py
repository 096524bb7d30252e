"""Layers by albedo scaling against a random walk: the walk meets closed forms, and the error of the layers, which
`patina check --layers` prints, keeps its budget."""
import json
import math

import numpy as np
import pytest

pytest.importorskip("_patina")

from patina.cli import layers, main  # noqa: E402

SAMPLES = 6000

# Largest error of albedo scaling per stack, as measured, and the smallest. Layers ignore what an interface sends back
# down, so they are too bright over a base that absorbs, and exact over a white one. The walk's noise, 4 standard
# errors, comes on top.
BUDGETS = {
    "smooth 1.5 over white": (-0.002, 0.002),
    "smooth 1.5 over grey": (0.15, 0.21),
    "smooth 1.5 over blue": (0.13, 0.19),
    "smooth 2.0 over grey": (0.21, 0.30),
    "alpha 0.1 over grey": (0.15, 0.21),
    "alpha 0.4 over grey": (0.13, 0.17),
    "alpha 0.4 over white": (-0.01, 0.01),
    "smooth 1.5 over gold": (0.07, 0.19),
    "alpha 0.4 over gold": (0.07, 0.22),
    "two coats over grey": (0.27, 0.32),
}


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


@pytest.fixture(scope="module")
def rows():
    return layers.report({}, SAMPLES, 0)


@pytest.mark.parametrize("stack", list(layers.STACKS))
def test_error_of_layers_keeps_its_budget(rows, stack):
    low, high = BUDGETS[stack]
    worst = []
    for row in (r for r in rows if r["stack"] == stack):
        errors = np.subtract(row["scaled"], row["walk"])
        c = int(np.argmax(np.abs(errors)))
        noise = 4.0 * row["noise"][c]
        assert low - noise < errors[c] < high + noise, row
        worst.append(errors[c])
    assert len(worst) == len(layers.ANGLES)


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
