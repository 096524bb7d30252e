# SPDX-License-Identifier: Apache-2.0
"""`patina check`: passes what is right, and finds each kind of mistake in materials made wrong on purpose."""
import json
import math
import types

import numpy as np
import pytest
import scipy.stats

import mtlx
from patina import significance
from patina.cli import binnedDensity, check, main

DOCUMENT = mtlx.document(mtlx.lobe("matte", "oren_nayar_diffuse_bsdf", {"color": (0.8, 0.8, 0.8)}),
                         mtlx.shader("plastic", inputs={"specular_roughness": 0.3}, node="p"))


@pytest.fixture
def document(tmp_path):
    path = tmp_path / "two.mtlx"
    path.write_text(DOCUMENT)
    return str(path)


class Lambert:
    """A white Lambertian surface in numpy, with mistakes to order."""

    constant = True

    def __init__(self, albedo=1.0, density=1.0, power=1.0, weight=1.0, nan=False, tilt=0.0):
        self.white, self.density, self.power = albedo, density, power
        self.weight, self.nan, self.tilt = weight, nan, tilt

    def eval(self, wo, wi):
        same = (wo[:, 2] * wi[:, 2]) > 0.0
        f = np.where(same, self.white / math.pi, 0.0)[:, None] * np.ones(3)
        f = f * (1.0 + self.tilt * np.abs(wo[:, :1]))
        if self.nan:
            f[np.abs(wi[:, 2]) < 1e-4] = np.nan
        return f, np.where(same, np.abs(wi[:, 2]) / math.pi * self.density, 0.0)

    def sample(self, wo, u):
        z = np.sqrt(1.0 - u[:, 0].astype(float) ** self.power) * np.where(wo[:, 2] < 0.0, -1.0, 1.0)
        r, phi = np.sqrt(np.maximum(0.0, 1.0 - z * z)), 2.0 * math.pi * u[:, 1]
        wi = np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=1).astype(np.float32)
        f, pdf = self.eval(wo, wi)
        good = pdf > 0.0
        weight = np.where(good, f[:, 0] * np.abs(wi[:, 2]) / np.maximum(pdf, 1e-9), 0.0) * self.weight
        return {"wi": wi, "weight": weight[:, None] * np.ones(3), "pdf": pdf, "event": np.where(good, 1, 0)}

    def albedo(self, wo):
        return np.full((len(wo), 3), self.white)

    def emission(self, wo):
        return np.zeros((len(wo), 3))


def failed(probe, **changes):
    arguments = types.SimpleNamespace(samples=16384, places=1, tolerance=0.01, reciprocal=True, seed=0)
    arguments.__dict__.update(changes)
    outcomes = check.check(probe, arguments)
    assert set(outcomes) == set(check.CHECKS)
    return {kind for kind, outcome in outcomes.items() if outcome["failed"]}


def test_a_right_material_passes():
    assert failed(Lambert()) == set()


@pytest.mark.parametrize("mistake, kind", [
    (dict(albedo=1.1), "energy"), (dict(density=1.1), "pdf"), (dict(density=0.5), "pdf"), (dict(power=0.9), "chi2"),
    (dict(weight=0.9), "weight"), (dict(nan=True), "finite"), (dict(tilt=0.2), "reciprocity")])
def test_each_mistake_is_found(mistake, kind):
    assert kind in failed(Lambert(**mistake))


@pytest.mark.parametrize("tilt, reciprocal, state", [(0.2, False, "note"), (0.2, True, "FAIL"), (0.0, False, "ok")])
def test_reciprocity_is_only_reported_by_default(tilt, reciprocal, state):
    """What is not reciprocal is no failure, and is not called right either."""
    arguments = types.SimpleNamespace(samples=1024, places=1, tolerance=0.01, reciprocal=reciprocal, seed=0)
    found = check.check(Lambert(**({"tilt": tilt} if tilt else {})), arguments)["reciprocity"]
    assert found["state"] == state and found["failed"] == (state == "FAIL")
    assert (found["worst"] > 0.01) == (tilt > 0)
    assert ("by design" in found["text"]) == (state == "note")


def test_tail_of_chi_squared():
    for freedom in (1, 2, 7, 100, 511):
        for x in (1e-3, 0.5, 1.0, 1.5, 3.0):
            value = freedom * x
            expected = pytest.approx(scipy.stats.chi2.sf(value, freedom), rel=1e-8, abs=1e-300)
            assert significance.chi_squared_tail(value, freedom) == expected


def test_command(document, capsys):
    assert main.main(["check", document, "--samples", "4096"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 2 * len(check.CHECKS)
    assert all(" ok " in line or " reciprocity  note " in line for line in lines)
    assert [line.split()[0] for line in lines if " note " in line] == ["plastic"]
    assert main.main(["check", document + ":plastic", "--samples", "4096", "--reciprocal", "--json"]) == 1
    captured = capsys.readouterr()
    found = json.loads(captured.out)["materials"]
    assert [m["name"] for m in found] == ["plastic"]
    assert found[0]["checks"]["reciprocity"]["failed"]
    reported = [line for line in captured.err.splitlines() if not line.startswith("check: ")]  # progress, on a slow machine
    assert len(reported) == 1 and "reciprocity" in reported[0]
    assert main.main(["check", document, "--samples", "10"]) == 2


def test_results_come_as_they_are_found(document, capsys, monkeypatch):
    """When the second material is looked at, the first one's lines have been printed."""
    shown, real = [], check.check

    def looked_at(*arguments):
        shown.append(capsys.readouterr().out)
        return real(*arguments)

    monkeypatch.setattr(check, "check", looked_at)
    assert main.main(["check", document, "--samples", "1024"]) == 0
    assert [len(text.splitlines()) for text in shown] == [0, len(check.CHECKS)]


def test_every_step_is_counted():
    """So that the time left, which follows from steps, is right."""
    for probe in (Lambert(), type("Varying", (Lambert,), {"constant": False, "move_to": lambda *_: None})()):
        steps = []
        arguments = types.SimpleNamespace(samples=1024, places=2, tolerance=0.01, reciprocal=False, seed=0)
        check.check(probe, arguments, lambda: steps.append(1))
        assert len(steps) == check._steps(probe, arguments)


class Spike:
    """Densities around an axis (von Mises and Fisher): 1 in all, and narrower than points see at first."""

    def __init__(self, sharpness, degrees):
        self.sharpness = sharpness
        self.axis = np.array([math.sin(math.radians(degrees)), 0.0, math.cos(math.radians(degrees))])

    def eval(self, wo, wi):
        away = 0.5 * ((wi.astype(np.float64) - self.axis) ** 2).sum(axis=1)  # 1 - cos, without cancellation
        return None, self.sharpness / (2.0 * math.pi) * np.exp(-self.sharpness * away)

    def sample(self, n, generator):
        away = -np.log(generator.random(n)) / self.sharpness
        phi = 2.0 * math.pi * generator.random(n)
        r = np.sqrt(away * (2.0 - away))
        tangent = np.array([self.axis[2], 0.0, -self.axis[0]])
        return (self.axis * (1.0 - away)[:, None] + tangent * (r * np.cos(phi))[:, None] +
                np.array([0.0, 1.0, 0.0]) * (r * np.sin(phi))[:, None])


@pytest.mark.parametrize("degrees", [0.0, 0.3, 50.0, 89.5])
@pytest.mark.parametrize("sharpness", [30.0, 1e4, 1e6])
def test_narrow_densities_are_integrated(degrees, sharpness):
    """Samples lead to a spike that lies between points, and chance explains their counts per bin (significance 0.1 %)."""
    n, generator = 65536, np.random.default_rng(3)
    spike = Spike(sharpness, degrees)
    wi = spike.sample(n, generator)
    y, x = binnedDensity.coordinates(wi)
    bins, precise = binnedDensity.integrate(spike, np.array([0.0, 0.0, 1.0]), y, x, n)
    assert precise and bins.sum() == pytest.approx(1.0, abs=binnedDensity.PRECISE)
    p = check.chi_squared(binnedDensity.counts(y, x), bins * n, n)
    assert p is None or p > 1e-3  # None: all in one bin


def test_a_density_that_is_too_wide_is_found():
    n, generator = 65536, np.random.default_rng(3)
    y, x = binnedDensity.coordinates(Spike(1e4, 50.2).sample(n, generator))  # near the corner of four bins
    found = [check.chi_squared(binnedDensity.counts(y, x), binnedDensity.integrate(
        Spike(sharpness, 50.2), np.array([0.0, 0.0, 1.0]), y, x, n)[0] * n, n) for sharpness in (1e4, 8e3)]
    assert found[0] > 1e-3 > found[1]
