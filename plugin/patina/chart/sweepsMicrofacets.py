# SPDX-License-Identifier: Apache-2.0
"""Microfacets at their limits: alpha 0, one alpha 0, anisotropy in tables, grazing views, samplers, last random numbers."""
import numpy as np

from patina.chart import probes
from patina.chart.sweeps import Sweep
from patina.chart.sweepsFresnel import dielectric

MIRROR = 1e-3  # ALPHA_MIRROR of shaders/lib/degenerate.glsl
LAST = 1.0 - 2.0 ** -24
WHITE = {"color0": (1.0,) * 3}
SINGLE = {"energyCompensation": "none"}


def white_metal(alpha, methods=SINGLE, **more):
    pair = alpha if isinstance(alpha, tuple) else (alpha, alpha)
    return probes.lobe("generalized_schlick_bsdf", methods, roughness=tuple(map(float, pair)), **WHITE, **more)


def ggx_unguarded(h, ax, ay):
    """GGX's density of a unit normal in single precision by slopes, with nothing against alpha 0 or a normal that lies flat."""
    with np.errstate(all="ignore"):
        h, ax, ay = np.float32(h), np.float32(ax), np.float32(ay)
        tan2 = (np.float32(1.0) - h[2] * h[2]) / (h[2] * h[2])
        phi2 = h[0] * h[0] + h[1] * h[1]
        x2 = h[0] * h[0] / phi2 / (ax * ax) + h[1] * h[1] / phi2 / (ay * ay)
        return float(np.float32(1.0) / (np.float32(np.pi) * ax * ay * h[2] ** 4 * (np.float32(1.0) + tan2 * x2) ** 2))


def _mirror_switch(count):
    """A rough dielectric becomes a mirror; without, the density cancels in 1 - cos^2."""
    x = sorted([*np.logspace(-7, -1.5, count - 2), 0.999 * MIRROR, 1.001 * MIRROR])
    wo = probes.towards(0.5)
    unguarded = []
    for a in x:
        # Mean of f cos / pdf at normals one alpha from the axis, each built from float directions again.
        ratios = []
        for turn in np.linspace(0.1, 6.1, 48):
            h = np.array([a * np.cos(turn), a * np.sin(turn), 1.0])
            h = h / np.linalg.norm(h)
            wi = np.float32(2.0 * (wo[0] @ h) * h - wo[0])
            built = np.float32(wo[0]) + wi
            built = built / np.linalg.norm(built)
            ratios.append(ggx_unguarded(built, a, a) * np.pi * a * a * 4.0)
        unguarded.append(float(np.mean(ratios)) * dielectric(0.5, 1.5))
    sampled = [probes.sampled(probes.lobe("dielectric_bsdf", ior=1.5, roughness=(a, a)), wo, 512) for a in x]
    return Sweep("alpha to 0, mirror switch", "facets",
                 "The half vector of float directions has no digits left for the density of a narrow lobe.", "alpha", x,
                 "albedo at cosine 0.5", {"with a mirror": sampled, "half vector in float": unguarded},
                 truth=dielectric(0.5, 1.5), chosen="with a mirror", bound=0.005 * dielectric(0.5, 1.5),
                 failing="half vector in float", switch=MIRROR, log_x=True, shows=2.0)


def _one_alpha_zero(count):
    x = [0.0, *np.logspace(-8, -1, count - 1)]
    wo = probes.towards(0.6, 0.7)
    limit = probes.albedo(white_metal((MIRROR, 0.4), {**SINGLE, "directionalAlbedo": "quadrature"}), wo)
    h = np.array([0.0, 0.2, 1.0]) / np.linalg.norm([0.0, 0.2, 1.0])
    with np.errstate(all="ignore"):
        unguarded = [limit * (lambda d: d / d)(ggx_unguarded(h, a, 0.4)) for a in x]
    truth = [probes.albedo(white_metal((max(a, MIRROR), 0.4), {**SINGLE, "directionalAlbedo": "quadrature"}), wo) for a in x]
    return Sweep("one alpha to 0", "facets", "The density divides by the product of both alphas.", "alpha x (alpha y 0.4)", x,
                 "albedo", {"raised to the mirror's alpha": [probes.albedo(white_metal((a, 0.4)), wo) for a in x],
                            "unguarded density": unguarded},
                 truth=truth, chosen="raised to the mirror's alpha", bound=2e-2, failing="unguarded density", switch=MIRROR,
                 log_x=True)


def _anisotropy(count):
    x = list(np.logspace(0, 2, count))
    wo = probes.towards(0.2)
    pairs = [(min(0.3 * np.sqrt(r), 1.0), 0.3 / np.sqrt(r)) for r in x]
    curves = {"table": [probes.albedo(white_metal(p), wo) for p in pairs],
              "sqrt(ax ay)": [probes.albedo(white_metal(float(np.sqrt(p[0] * p[1]))), wo) for p in pairs]}
    truth = [probes.albedo(white_metal(p, {**SINGLE, "directionalAlbedo": "quadrature"}), wo) for p in pairs]
    return Sweep("anisotropy in tables", "facets",
                 "One mean alpha in place of both: masking along the view is that of another lobe.", "alpha x / alpha y", x,
                 "albedo, white metal, cosine 0.2", curves, truth=truth, chosen="table", bound=2e-2, failing="sqrt(ax ay)",
                 log_x=True, shows=2.0)


def _grazing(count):
    x = [0.0, *np.logspace(-9, 0, count - 1)]
    alpha = 0.5
    truth, unguarded = [], []
    for mu in x:
        with np.errstate(all="ignore"):
            m = np.float32(mu)
            tan2 = (np.float32(1.0) - m * m) / (m * m)
            g1 = np.float32(2.0) / (np.float32(1.0) + np.sqrt(np.float32(1.0) + np.float32(alpha * alpha) * tan2))
            unguarded.append(float(g1 / m))
        truth.append(2.0 / (mu + np.sqrt(alpha ** 2 + (1.0 - alpha ** 2) * mu * mu)))
    # With light along the normal the density of visible facets is D(h) / 4 times what is looked for.
    probe, found = white_metal(alpha), []
    for mu in x:
        wo = probes.towards(mu)
        h = wo[0].astype(float) + (0.0, 0.0, 1.0)
        z2 = h[2] ** 2 / (h @ h)
        density = alpha ** 2 / (np.pi * (1.0 - z2 * (1.0 - alpha ** 2)) ** 2)
        found.append(float(probe.eval(wo, probes.towards(1.0))[1][0]) * 4.0 / density)
    return Sweep("grazing views", "facets", "Smith's masking over the cosine, by slopes: 0 / 0 at the horizon.", "cosine", x,
                 "G1 / cosine, alpha 0.5", {"by lengths": found, "by slopes": unguarded}, truth=truth, chosen="by lengths",
                 bound=4e-3, failing="by slopes", log_x=True)


def all_facets(alpha, wo, count):
    """:returns: weights of samples of a white metal that draw from all facets by their density (Walter et al. 2007), 0 where
    one is lost; of the points that probes.samples() takes"""
    u, v = probes.points(count).T[:2]
    r, phi = alpha * np.sqrt(v / (1.0 - v)), 2.0 * np.pi * u
    m = np.stack([r * np.cos(phi), r * np.sin(phi), np.ones(count)], 1)
    m /= np.linalg.norm(m, axis=1, keepdims=True)
    c = m @ wo[0].astype(float)
    z = 2.0 * c * m[:, 2] - wo[0, 2]  # of the light
    def length(z):
        return np.sqrt(alpha ** 2 + (1.0 - alpha ** 2) * z * z)
    lit = (c > 0.0) & (z > 0.0)
    shadowed = 2.0 * wo[0, 2] * np.where(lit, z, 1.0) / (wo[0, 2] * length(z) + np.where(lit, z, 1.0) * length(wo[0, 2]))
    return np.where(lit, shadowed * c / (wo[0, 2] * m[:, 2]), 0.0)


def _weights(alpha, method, wo, count):
    if method == "fullNdf":
        return all_facets(alpha, wo, count)
    return probes.samples(white_metal(alpha, {**SINGLE, "sampling": method}), wo, count)["weight"][:, 0].astype(np.float64)


SAMPLERS = ("vndf", "boundedVndf", "fullNdf")


def _samplers(count):
    x = list(np.linspace(0.05, 1.0, count))
    wo = probes.towards(0.05)
    weights = {m: [_weights(a, m, wo, 2048) for a in x] for m in SAMPLERS}
    noise = {m: [float(found.std()) for found in per] for m, per in weights.items()}
    lost = {m: [float((found == 0.0).mean()) for found in per] for m, per in weights.items()}
    return [Sweep("noise of samplers at grazing views", "facets",
                  "Drawing all facets by their density leaves a weight without bound; seen facets leave at most 1.", "alpha", x,
                  "deviation of a sample's weight, cosine 0.05", noise, truth=0.0, chosen="boundedVndf", bound=0.5,
                  failing="fullNdf", log_y=True, shows=2.0),
            Sweep("samples lost below the horizon", "facets",
                  "Facets that are seen, but reflect downwards, are drawn for nothing; bounded caps leave most of them out.",
                  "alpha", x, "share of samples, cosine 0.05", lost, truth=0.0, chosen="boundedVndf", bound=0.25,
                  failing="fullNdf", shows=1.5)]


def _last_numbers(count):
    ends = [0.0, 2.0 ** -32, 2.0 ** -24, 1e-4, 0.1, 0.5, 0.9, 1.0 - 1e-4, LAST]
    probe, wo = probes.lobe("conductor_bsdf", SINGLE, ior=(0.0,) * 3, extinction=(10.0,) * 3, roughness=(0.5, 0.5),
                            distribution="beckmann"), probes.towards(0.7)
    worst, unguarded = [], []
    for u in ends:
        others = (0.0, 0.3, LAST)
        found = probe.sample(np.repeat(wo, 9, axis=0), np.array([(a, b, u, u) if i else (u, a, b, b) for i, (a, b) in enumerate(
            (a, b) for a in others for b in others)], np.float32))
        worst.append(float(found["weight"][:, 0].max()))
        with np.errstate(all="ignore"):
            # Beckmann's slope of -log(1 - u), with u rounded to the next of 2^-23: the last one becomes 1.
            v = np.round(np.float64(u) * 2.0 ** 23) / 2.0 ** 23
            slope2 = np.float32(-np.log(np.float32(1.0 - v))) * np.float32(0.25)
            cos = np.float32(1.0) / np.sqrt(np.float32(1.0) + slope2)
            density = np.exp(-slope2 / np.float32(0.25)) / cos ** 4
            unguarded.append(float(density / density))
    return Sweep("random numbers of 0 and just under 1", "facets",
                 "The last random number, rounded up to 1, makes a normal without density, and a weight of 0 / 0.",
                 "random number", ends, "largest weight", {"guarded": worst, "unguarded": unguarded}, truth=1.0,
                 chosen="guarded", bound=1e-3, failing="unguarded")


def _opposite(count):
    """wi = -wo: the half vector of a refraction through an interface that hardly bends."""
    x = [0.0, *np.logspace(-8, -0.5, count - 1)]
    wo = probes.towards(0.7, 0.4)
    half, kept = [], []
    with np.errstate(all="ignore"):
        for d in x:
            eta = np.float32(1.0) + np.float32(d)
            h = wo[0] - eta * wo[0]
            h = h / np.linalg.norm(h)
            # For wi = -wo exactly the facet is wo itself.
            half.append(float(abs(h @ wo[0])))
    for d in x:
        probe = probes.lobe("dielectric_bsdf", ior=float(1.0 + d), roughness=(0.3, 0.3), scatter_mode="RT")
        f, pdf = probe.eval(wo, -wo)
        s = probes.samples(probe, wo, 512)
        kept.append(float(s["weight"][:, 0].mean()) if np.isfinite([*f[0], *pdf]).all() else np.nan)
    return Sweep("ior to 1, wi = -wo", "facets",
                 "The half vector of exact opposites is 0 / 0 where the interface does not bend.", "ior - 1", x,
                 "albedo of a lossless interface; |h|", {"matched below 1e-4": kept, "unguarded half vector": half}, truth=1.0,
                 chosen="matched below 1e-4", bound=2e-2, failing="unguarded half vector", switch=1e-4, log_x=True)


def sweeps(count):
    return [_mirror_switch(count), _one_alpha_zero(count), _anisotropy(count), _grazing(count), *_samplers(count),
            _last_numbers(count), _opposite(count)]
