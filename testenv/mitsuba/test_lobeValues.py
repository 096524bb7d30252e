# SPDX-License-Identifier: Apache-2.0
"""Values of single lobes against Mitsuba 3's plugins, direction by direction.

Mitsuba shadows by the product of both G1, our Smith lobes by the height-correlated form and
Cook-Torrance by V-cavities; the known factor between them is divided out, so that distribution,
Fresnel equations, Jacobians and normalisation are compared to float precision.
"""
import io
import json
import math
import sys

import numpy as np
import pytest

mi = pytest.importorskip("mitsuba", reason="Mitsuba 3 is not installed")

import mtlx
from patina.cli import main

GOLD = ((0.183, 0.421, 1.373), (3.424, 2.346, 1.77))


@pytest.fixture(autouse=True)
def scalar():
    """One direction at a time; the variant is one for the whole process, so it is put back."""
    before = mi.variant()
    mi.set_variant("scalar_rgb")
    yield
    if before is not None:
        mi.set_variant(before)


def directions(count, transmits):
    """:returns: pairs of unit vectors, at least 2 degrees above or below the horizon; the seed is fixed"""
    random = np.random.default_rng(7)
    v = random.normal(size=(8 * count, 2, 3))
    v /= np.linalg.norm(v, axis=2, keepdims=True)
    if not transmits:
        v[:, :, 2] = np.abs(v[:, :, 2])
    return v[np.all(np.abs(v[:, :, 2]) > 0.035, axis=1)][:count]


def ours(tmp_path, capsys, monkeypatch, node, inputs, pairs):
    """f times the cosine of each pair, bare single scattering"""
    path = tmp_path / "lobe.mtlx"
    path.write_text(mtlx.document(mtlx.lobe("material", node, {f"{kind} {name}": value for name, kind, value in inputs})))
    text = "\n".join(" ".join(f"{x:.9g}" for x in pair.ravel()) for pair in pairs)
    monkeypatch.setattr(sys, "stdin", io.StringIO(text))
    assert main.main(["bsdf", "eval", str(path), "--wo", "-", "--wi", "-", "--method",
                      "energyCompensation=none", "--json"]) == 0
    values = [json.loads(line)["f"] for line in capsys.readouterr().out.splitlines()]
    return np.array(values) * np.abs(pairs[:, 1, 2:3])


def theirs(plugin, pairs):
    bsdf = mi.load_dict(plugin)
    # Our transmission is in flux form: radiance without the factor 1 / eta^2.
    context = mi.BSDFContext(mi.TransportMode.Importance)
    values = []
    for wo, wi in pairs:
        si = mi.SurfaceInteraction3f()
        si.wi = mi.Vector3f(*wo)
        values.append(np.array(bsdf.eval(context, si, mi.Vector3f(*wi)), dtype=np.float64).ravel())
    return np.array(values)


def smith_lambda(w, ax, ay):
    """GGX, Heitz 2014"""
    a2 = (ax * w[:, 0]) ** 2 + (ay * w[:, 1]) ** 2
    return 0.5 * (np.sqrt(1.0 + a2 / w[:, 2] ** 2) - 1.0)


def correlated(pairs, ax, ay):
    """height-correlated over separable masking"""
    o, i = smith_lambda(pairs[:, 0], ax, ay), smith_lambda(pairs[:, 1], ax, ay)
    return ((1.0 + o) * (1.0 + i) / (1.0 + o + i))[:, None]


def compare(a, b):
    assert np.isfinite(a).all() and (b > 1e-4).sum() > 100
    np.testing.assert_allclose(a, b, rtol=5e-3, atol=2e-5)


def test_diffuse(tmp_path, capsys, monkeypatch):
    pairs = directions(200, False)
    a = ours(tmp_path, capsys, monkeypatch, "patina_lambert_bsdf", [("color", "color3", "0.5, 0.25, 0.75")], pairs)
    compare(a, theirs({"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.5, 0.25, 0.75]}}, pairs))


@pytest.mark.parametrize("ax, ay", [(0.1, 0.1), (0.3, 0.3), (0.8, 0.8), (0.15, 0.5)])
def test_rough_conductor(tmp_path, capsys, monkeypatch, ax, ay):
    pairs = directions(400, False)
    a = ours(tmp_path, capsys, monkeypatch, "conductor_bsdf", [
        ("ior", "color3", ", ".join(map(str, GOLD[0]))), ("extinction", "color3", ", ".join(map(str, GOLD[1]))),
        ("roughness", "vector2", f"{ax}, {ay}")], pairs)
    b = theirs({"type": "roughconductor", "distribution": "ggx", "alpha_u": ax, "alpha_v": ay,
                "eta": {"type": "rgb", "value": list(GOLD[0])}, "k": {"type": "rgb", "value": list(GOLD[1])}}, pairs)
    compare(a, b * correlated(pairs, ax, ay))


@pytest.mark.parametrize("alpha", [0.2, 0.6])
@pytest.mark.parametrize("ior", [1.33, 1.5, 2.0])
def test_rough_dielectric(tmp_path, capsys, monkeypatch, alpha, ior):
    pairs = directions(600, True)
    a = ours(tmp_path, capsys, monkeypatch, "dielectric_bsdf", [
        ("ior", "float", ior), ("roughness", "vector2", f"{alpha}, {alpha}"), ("scatter_mode", "string", "RT")], pairs)
    b = theirs({"type": "roughdielectric", "distribution": "ggx", "alpha": alpha, "int_ior": ior, "ext_ior": 1.0}, pairs)
    compare(a, b * correlated(pairs, alpha, alpha))


def beckmann_g1(w, ax, ay=None):
    """the rational fit that Mitsuba uses (Walter et al. 2007)"""
    slope = np.hypot(ax * w[:, 0], (ax if ay is None else ay) * w[:, 1])
    a = np.abs(w[:, 2]) / np.maximum(slope, 1e-12)
    return np.where(a >= 1.6, 1.0, (3.535 * a + 2.181 * a * a) / (1.0 + 2.276 * a + 2.577 * a * a))


def beckmann_lambda(w, ax, ay):
    """the exact form, Heitz 2014"""
    a = np.abs(w[:, 2]) / np.maximum(np.hypot(ax * w[:, 0], ay * w[:, 1]), 1e-12)
    tail = np.array([math.erfc(x) for x in a])
    return 0.5 * (np.exp(-a * a) / (a * math.sqrt(math.pi)) - tail)


def beckmann_masking(pairs, ax, ay):
    """ours over Mitsuba's"""
    o, i = pairs[:, 0], pairs[:, 1]
    exact = 1.0 / (1.0 + beckmann_lambda(o, ax, ay) + beckmann_lambda(i, ax, ay))
    return (exact / (beckmann_g1(o, ax, ay) * beckmann_g1(i, ax, ay)))[:, None]


@pytest.mark.parametrize("ax, ay", [(0.1, 0.1), (0.5, 0.5), (0.15, 0.5)])
def test_beckmann_conductor(tmp_path, capsys, monkeypatch, ax, ay):
    pairs = directions(400, False)
    a = ours(tmp_path, capsys, monkeypatch, "conductor_bsdf", [
        ("ior", "color3", ", ".join(map(str, GOLD[0]))), ("extinction", "color3", ", ".join(map(str, GOLD[1]))),
        ("roughness", "vector2", f"{ax}, {ay}"), ("distribution", "string", "beckmann")], pairs)
    b = theirs({"type": "roughconductor", "distribution": "beckmann", "alpha_u": ax, "alpha_v": ay,
                "eta": {"type": "rgb", "value": list(GOLD[0])}, "k": {"type": "rgb", "value": list(GOLD[1])}}, pairs)
    compare(a, b * beckmann_masking(pairs, ax, ay))


def test_beckmann_dielectric(tmp_path, capsys, monkeypatch):
    pairs = directions(600, True)
    a = ours(tmp_path, capsys, monkeypatch, "dielectric_bsdf", [
        ("ior", "float", 1.5), ("roughness", "vector2", "0.4, 0.4"), ("scatter_mode", "string", "RT"),
        ("distribution", "string", "beckmann")], pairs)
    b = theirs({"type": "roughdielectric", "distribution": "beckmann", "alpha": 0.4, "int_ior": 1.5, "ext_ior": 1.0},
               pairs)
    compare(a, b * beckmann_masking(pairs, 0.4, 0.4))


@pytest.mark.parametrize("alpha", [0.2, 0.5])
def test_cook_torrance(tmp_path, capsys, monkeypatch, alpha):
    pairs = directions(400, False)
    a = ours(tmp_path, capsys, monkeypatch, "patina_cook_torrance_bsdf", [
        ("ior", "color3", ", ".join(map(str, GOLD[0]))), ("extinction", "color3", ", ".join(map(str, GOLD[1]))),
        ("roughness", "float", alpha)], pairs)
    b = theirs({"type": "roughconductor", "distribution": "beckmann", "alpha": alpha,
                "eta": {"type": "rgb", "value": list(GOLD[0])}, "k": {"type": "rgb", "value": list(GOLD[1])}}, pairs)
    o, i = pairs[:, 0], pairs[:, 1]
    h = o + i
    h /= np.linalg.norm(h, axis=1, keepdims=True)
    c = np.sum(o * h, axis=1)
    cavity = np.minimum(1.0, 2.0 * h[:, 2] * np.minimum(o[:, 2], i[:, 2]) / c)
    compare(a, b * (cavity / (beckmann_g1(o, alpha) * beckmann_g1(i, alpha)))[:, None])
