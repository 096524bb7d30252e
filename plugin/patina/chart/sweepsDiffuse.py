# SPDX-License-Identifier: Apache-2.0
"""Diffuse models and sheen in a white furnace, their rings and their reciprocity."""
import numpy as np

from patina.chart import probes
from patina.chart.sweeps import Sweep
from patina.chart.sweepsEnergy import reciprocity

MODELS = ("eon", "qualitative", "fujii", "lambert")
FUJII_LOSS = 0.5 - 2.0 / (3.0 * np.pi)


def fujii(roughness, wo, wi):
    """f of white by Fujii's model, whose first term EON has too: A + B s / t."""
    s = float(wo[0] @ wi[0] - wo[0, 2] * wi[0, 2])
    t = max(wo[0, 2], wi[0, 2]) if s > 0.0 else 1.0
    return (1.0 + roughness * s / t) / (1.0 + FUJII_LOSS * roughness) / np.pi


def fujii_albedo(roughness, mu):
    """What it reflects of light from a cosine, in closed form."""
    sine = np.sqrt(1.0 - mu * mu)
    g = sine * (np.arccos(mu) - sine * mu) + 2.0 / 3.0 * (sine / mu * (1.0 - sine ** 3) - sine)
    return (1.0 + roughness * g / np.pi) / (1.0 + FUJII_LOSS * roughness)


def _albedo(roughness, model, cosine):
    if model == "fujii":
        return float(fujii_albedo(roughness, cosine))
    return probes.albedo(_diffuse(roughness, model), probes.towards(cosine))


def _diffuse(roughness, model):
    return probes.lobe("oren_nayar_diffuse_bsdf", {"diffuse": model}, color=(1.0,) * 3, roughness=float(roughness))


def _burley(roughness):
    return probes.lobe("burley_diffuse_bsdf", color=(1.0,) * 3, roughness=float(roughness))


def _furnace(count):
    x = list(np.linspace(0.0, 1.0, count))
    wo = probes.towards(0.2)
    curves = {m: [_albedo(r, m, 0.2) for r in x] for m in MODELS}
    curves["burley"] = [probes.albedo(_burley(r), wo) for r in x]
    return Sweep("rough white diffuse", "diffuse",
                 "The qualitative model and Fujii's lose light between the facets; Burley's gains it where rough.", "roughness",
                 x, "albedo at cosine 0.2", curves, truth=1.0, chosen="eon", bound=2e-3, failing="qualitative", shows=10)


def _grazing(count):
    x = list(np.logspace(-3, 0, count))
    curves = {m: [_albedo(1.0, m, c) for c in x] for m in MODELS}
    curves["burley"] = [probes.albedo(_burley(1.0), probes.towards(c)) for c in x]
    return Sweep("diffuse at grazing views", "diffuse",
                 "Burley's model of roughness 1 gains half again of the light at the horizon.", "cosine", x,
                 "albedo, roughness 1", curves, truth=1.0, chosen="eon", bound=2e-3, failing="burley", log_x=True, shows=50)


def _ring(count):
    """Where a minimum switches, the slope of f over the azimuth jumps."""
    x = list(np.linspace(60.0, 120.0, 2 * (count // 2) + 1))  # 90 is among them
    step, wo = 0.5, probes.towards(0.9)
    def bend(model):
        probe = None if model == "fujii" else _diffuse(1.0, model)
        def f(degrees):
            wi = probes.towards(0.3, np.radians(degrees))
            return fujii(1.0, wo, wi) if model == "fujii" else float(probe.eval(wo, wi)[0][0, 0])
        return [abs(f(d + step) - 2.0 * f(d) + f(d - step)) / np.radians(step) for d in x]
    curves = {m: bend(m) for m in ("eon", "qualitative", "fujii")}
    return Sweep("ring of the qualitative model", "diffuse", "The slope jumps where the minimum of its two terms switches.",
                 "azimuth between view and light in degrees", x, "jump of the slope, per radian", curves, truth=0.0,
                 chosen="eon", bound=0.015, failing="qualitative", shows=2)


def _sheen(roughness, mode):
    return probes.lobe("sheen_bsdf", color=(1.0,) * 3, roughness=float(roughness), mode=mode)


def _sheen_reciprocal(count):
    x = list(np.linspace(0.1, 1.0, count))
    curves = {m: [reciprocity(_sheen(r, m)) for r in x] for m in ("conty_kulla", "zeltner")}
    curves["lambert"] = [reciprocity(_diffuse(0.0, "lambert")) for _ in x]
    return Sweep("reciprocity of sheen", "sheen",
                 "Zeltner's fit hangs on the view alone; Conty and Kulla's lobe is divided by its albedo there.", "roughness",
                 x, "defect, over the mean value", curves, truth=0.0, chosen="conty_kulla", bound=0.01, failing="zeltner",
                 shows=10)


def _sheen_narrow(count):
    x = list(np.linspace(0.0, 0.3, count))
    wo = probes.towards(0.05)
    curves = {m: [probes.albedo(_sheen(r, m), wo) for r in x] for m in ("conty_kulla", "zeltner")}
    # The published lobe without division by its albedo: Charlie's distribution over 4 (o + i - o i).
    published = []
    for r in x:
        a = max(r, 0.01)
        z = (np.arange(64) + 0.5) / 64
        t = np.pi * (np.arange(96) + 0.5) / 96
        total = 0.0
        for cos in z:
            s = np.sqrt(1.0 - cos * cos)
            h = np.stack([np.sqrt(1 - 0.05 ** 2) + s * np.cos(t), s * np.sin(t), np.full_like(t, 0.05 + cos)])
            hz = h[2] / np.linalg.norm(h, axis=0)
            d = (2.0 + 1.0 / a) * (1.0 - hz ** 2) ** (0.5 / a) / (2.0 * np.pi)
            total += float((d / (4.0 * (0.05 + cos - 0.05 * cos)) * cos).mean()) * 2.0 * np.pi / 64
        published.append(total)
    curves["as published"] = published
    return Sweep("sheen at low roughness", "sheen", "Charlie's lobe without bounds: a white one gains light at grazing views.",
                 "roughness", x, "albedo at cosine 0.05", curves, truth=[min(v, 1.0) for v in published], chosen="conty_kulla",
                 bound=0.05, failing="as published", shows=10)


def sweeps(count):
    return [_furnace(count), _grazing(count), _ring(count), _sheen_reciprocal(count), _sheen_narrow(count)]
