# SPDX-License-Identifier: Apache-2.0
"""Reflectances: Schlick's curve and its dip against the equations, and the equations where they degenerate."""
import numpy as np

from patina.chart import probes
from patina.chart.sweeps import Sweep

ALUMINIUM = ((1.5, 0.98, 0.6), (7.6, 6.6, 5.4))


def dielectric(cosine, eta):
    """Fresnel's equations; eta: ior of the far side over that of the near one."""
    inside = 1.0 - (1.0 - cosine ** 2) / eta ** 2
    if inside <= 0.0:
        return 1.0
    t = np.sqrt(inside)
    s = (cosine - eta * t) / (cosine + eta * t)
    p = (t - eta * cosine) / (t + eta * cosine)
    return 0.5 * (s * s + p * p)


def conductor(cosine, n, k):
    """The same with a complex ior."""
    m = complex(n, k) ** 2
    t = np.sqrt(m - (1.0 - cosine ** 2))
    s = (cosine - t) / (cosine + t)
    p = (m * cosine - t) / (m * cosine + t) if abs(m * cosine + t) > 0.0 else 1.0
    return 0.5 * (abs(s) ** 2 + abs(p) ** 2)


def conductor_unguarded(cosine, n, k):
    """The textbook form by the ratio k / n in single precision, with nothing against n = 0."""
    with np.errstate(all="ignore"):
        c, n, k = np.float32(cosine), np.float32(n), np.float32(k)
        ratio = k / n
        c2, s2 = c * c, np.float32(1.0) - c * c
        t0 = n * n * (np.float32(1.0) - ratio * ratio) - s2
        ab = np.sqrt(t0 * t0 + np.float32(4.0) * n ** 4 * ratio * ratio)
        a = np.sqrt(np.float32(0.5) * (ab + t0))
        s = (ab + c2 - 2 * a * c) / (ab + c2 + 2 * a * c)
        p = s * (c2 * ab + s2 * s2 - 2 * a * c * s2) / (c2 * ab + s2 * s2 + 2 * a * c * s2)
        return float(np.float32(0.5) * (s + p))


def _by_model(make, exact, wo, x):
    """The lobe itself, Schlick's curve of its reflectance at normal incidence, and that with a dip which meets the exact
    reflectance at 82 degrees (Kutz et al. 2021).

    :param exact: (x, cosine) -> reflectance per channel
    """
    curves = {"exact": [probes.albedo(make(v), wo(v)) for v in x], "schlick": [], "f82": []}
    for v in x:
        f0, at82 = np.array(exact(v, 1.0)), np.array(exact(v, 1.0 / 7.0))
        dip = at82 / (f0 + (1.0 - f0) * (6.0 / 7.0) ** 5)
        for name, color82 in (("schlick", np.ones(3)), ("f82", dip)):
            probe = probes.lobe("generalized_schlick_bsdf", color0=tuple(map(float, f0)), color82=tuple(map(float, color82)),
                                roughness=(0.0, 0.0))
            curves[name].append(probes.albedo(probe, wo(v)))
    return curves


def _glass(ior, mode="R"):
    return probes.lobe("dielectric_bsdf", ior=float(ior), roughness=(0.0, 0.0), scatter_mode=mode)


def _of_glass(ior, cosine):
    return [dielectric(cosine, ior)] * 3


def sweeps(count):
    """:param count: points of each sweep"""
    found = []
    for name, fails, cosine, x in (
            ("ior near 1", "Schlick's curve rises to 1 at grazing angles however weak the interface is.", 0.1,
             list(1.0 + np.logspace(-4, -0.3, count))),
            ("ior above 2", "Schlick's curve has no Brewster angle, whose dip grows with the ior.", 0.3,
             list(np.linspace(1.6, 5.0, count)))):
        curves = _by_model(_glass, _of_glass, lambda _: probes.towards(cosine), x)
        found.append(Sweep(f"Fresnel, {name}", "Fresnel", fails, "ior", x, f"reflectance at cosine {cosine}", curves,
                           truth=[dielectric(cosine, v) for v in x], chosen="exact", bound=1e-5, failing="schlick", shows=1000))
    x = list(np.linspace(50.0, 89.9, count))
    metal = lambda v: probes.lobe("conductor_bsdf", ior=ALUMINIUM[0], extinction=ALUMINIUM[1], roughness=(0.0, 0.0))
    of_metal = lambda v, cosine: [conductor(cosine, n, k) for n, k in zip(*ALUMINIUM)]
    found.append(Sweep("Fresnel, aluminium near 82 degrees", "Fresnel", "The reflectance of metals dips before it rises; "
                       "Schlick's curve does not, f82 meets the dip at one angle.", "degrees", x, "reflectance",
                       _by_model(metal, of_metal, probes.at_degrees, x),
                       truth=[conductor(np.cos(np.radians(v)), ALUMINIUM[0][0], ALUMINIUM[1][0]) for v in x], chosen="exact",
                       bound=1e-5, failing="schlick", shows=1000))
    x = list(np.linspace(30.0, 60.0, count))
    inside = lambda v: -probes.at_degrees(v) * [-1, 1, 1]
    found.append(Sweep("Fresnel, total internal reflection", "Fresnel", "From inside, Schlick's curve over the incident cosine "
                       "misses that all is reflected beyond the critical angle.", "degrees inside", x, "reflectance",
                       {"exact": [1.0 - probes.albedo(_glass(1.5, "T"), inside(v)) for v in x],
                        "schlick, incident cosine": [0.04 + 0.96 * (1.0 - np.cos(np.radians(v))) ** 5 for v in x]},
                       truth=[dielectric(np.cos(np.radians(v)), 1.0 / 1.5) for v in x], chosen="exact", bound=1e-4,
                       failing="schlick, incident cosine", switch=float(np.degrees(np.arcsin(1.0 / 1.5))), shows=1000))
    x = list(np.linspace(0.2, 1.0, count))
    found.append(Sweep("Fresnel, ior below 1", "Fresnel",
                       "Where the far side is thinner, total reflection begins; Schlick's curve knows none.", "ior", x,
                       "reflectance at cosine 0.5",
                       {"exact": [probes.albedo(_glass(v), probes.towards(0.5)) for v in x],
                        "schlick, incident cosine": [((v - 1) / (v + 1)) ** 2 * (1 - 0.5 ** 5) + 0.5 ** 5 for v in x]},
                       truth=[dielectric(0.5, v) for v in x], chosen="exact", bound=1e-4, failing="schlick, incident cosine",
                       switch=float(np.sqrt(0.75)), shows=1000))
    return found + _degenerate(count)


def _degenerate(count):
    found, x = [], [0.0, *np.logspace(-12, 0, count - 1)]
    for name, label, cosine, pairs in (("k to 0", "k", 0.3, [(1.5, k) for k in x]),
                                       ("n to 0, k 0", "n", 1.0, [(n, 0.0) for n in x])):
        curves = {"exact": [probes.albedo(probes.lobe("conductor_bsdf", ior=(n,) * 3, extinction=(k,) * 3,
                                                      roughness=(0.0, 0.0)), probes.towards(cosine)) for n, k in pairs],
                  # n = 0 is what breaks it: the sweep of k is with a vanishing n there.
                  "unguarded": [conductor_unguarded(cosine, 0.0 if label == "k" else n, k) for n, k in pairs]}
        found.append(Sweep(f"conductor, {name}", "Fresnel",
                           "Forms that divide by n or take roots of rounded differences give no numbers.", label, x,
                           f"reflectance at cosine {cosine}", curves, truth=[conductor(cosine, n, k) for n, k in pairs],
                           chosen="exact", bound=1e-4, failing="unguarded", log_x=True))
    return found
