# SPDX-License-Identifier: Apache-2.0
"""Classic lobes at grazing angles: Ward, Cook and Torrance's V-cavities, Phong and Blinn."""
from math import erf

import numpy as np

from patina.chart import probes
from patina.chart.sweeps import Sweep


def _ward(count):
    x = list(np.logspace(-3, 0, count))
    lobes = {form: probes.lobe("patina_ward_bsdf", color=(1.0,) * 3, roughness=(0.3, 0.3), form=form)
             for form in ("bounded", "exact")}
    albedos = {form: [probes.albedo(lobe, probes.towards(c)) for c in x] for form, lobe in lobes.items()}
    weights = {form: [float(probes.samples(lobe, probes.towards(c), 2048)["weight"][:, 0].max()) for c in x]
               for form, lobe in lobes.items()}
    return [Sweep("Ward at grazing views", "classic", "1 / sqrt(cos cos) of the published form grows without bound.", "cosine",
                  x, "albedo, white", albedos, truth=[min(v, 1.0) for v in albedos["bounded"]], chosen="bounded", bound=1e-3,
                  failing="exact", log_x=True, log_y=True, shows=100),
            Sweep("weights of Ward's samples", "classic",
                  "The weight is about sqrt(cos i / cos o): fireflies at grazing views.", "cosine", x,
                  "largest weight of a sample", weights, truth=1.0, chosen="bounded", bound=1.01, failing="exact", log_x=True,
                  log_y=True, shows=3)]


def smith_beckmann(cos_o, cos_i, alpha):
    """f of a white Beckmann metal with height-correlated masking, both directions in one plane on either side."""
    o = np.array([np.sqrt(1.0 - cos_o ** 2), cos_o])
    i = np.array([-np.sqrt(1.0 - cos_i ** 2), cos_i])
    h = (o + i) / np.linalg.norm(o + i)
    tan2 = (h[0] / h[1]) ** 2
    d = np.exp(-tan2 / alpha ** 2) / (np.pi * alpha ** 2 * h[1] ** 4)
    def smith(c):
        a = c / (alpha * np.sqrt(max(1.0 - c * c, 1e-12)))
        return 0.5 * (erf(a) - 1.0 + np.exp(-a * a) / (a * np.sqrt(np.pi)))
    return d / (1.0 + smith(cos_o) + smith(cos_i)) / (4.0 * cos_o * cos_i)


def _v_cavity(count):
    x = list(np.linspace(10.0, 88.0, count))
    alpha = 0.4
    metal = {"ior": (0.0,) * 3, "extinction": (10.0,) * 3}
    def f(probe, degrees):
        wo = probes.at_degrees(degrees)
        return float(probe.eval(wo, wo * np.float32([-1, 1, 1]))[0][0, 0] * wo[0, 2])
    smith = probes.lobe("conductor_bsdf", {"energyCompensation": "none"}, roughness=(alpha, alpha), distribution="beckmann",
                        **metal)
    cavity = probes.lobe("patina_cook_torrance_bsdf", color=(1.0,) * 3, roughness=alpha, **metal)
    curves = {"Smith": [f(smith, d) for d in x], "V-cavities": [f(cavity, d) for d in x]}
    truth = [smith_beckmann(np.cos(np.radians(d)), np.cos(np.radians(d)), alpha) * np.cos(np.radians(d)) for d in x]
    return Sweep("V-cavities at grazing angles", "classic", "All facets form one kind of groove: the mirror direction is "
                 "hardly masked, with a kink where the minimum switches.", "degrees, view and light", x,
                 "f cos, Beckmann alpha 0.4", curves, truth=truth, chosen="Smith", bound=6e-3 * max(truth),
                 failing="V-cavities", log_y=True, shows=10)


def _phong(count):
    x = list(np.logspace(-2, 0, count))
    def found(kind, c, exponent):
        return probes.sampled(probes.lobe(kind, color=(1.0,) * 3, exponent=exponent), probes.towards(c), 2048)
    curves = {"Blinn-Phong, normalised": [found("patina_blinn_phong_bsdf", c, 20.0) for c in x],
              "Phong, normalised": [found("patina_phong_bsdf", c, 20.0) for c in x]}
    # Without the factor: what (n + 1) / 2 pi over the cosine gives, as many have written it.
    z = (np.arange(400) + 0.5) / 400
    unbounded = []
    for c in x:
        t = np.pi * (np.arange(200) + 0.5) / 200
        r = np.sqrt(1 - z[:, None] ** 2) * np.cos(t[None]) * np.sqrt(1 - c * c) + z[:, None] * c
        unbounded.append(float((np.maximum(r, 0.0) ** 20).mean() * 2.0 * np.pi * 21.0 / (2.0 * np.pi) / max(c, 1e-9)))
    curves["Phong, over the cosine"] = unbounded
    return Sweep("Phong at grazing views", "classic", "Divided by the cosine, Phong's lobe gains without bound.", "cosine", x,
                 "albedo, white", curves, truth=1.0, chosen="Blinn-Phong, normalised", bound=1.0,
                 failing="Phong, over the cosine", log_x=True, log_y=True, shows=5)


def sweeps(count):
    return [*_ward(count), _v_cavity(count), _phong(count)]
