# SPDX-License-Identifier: Apache-2.0
"""The planner's choice along a sweep: where it switches, the method before would have too large a predicted error."""
from patina.chart import probes
from patina.chart.sweeps import Sweep
from patina.cli.compiled import _patina

TOLERANCE = 0.01


def _switch(x, chosen):
    """:returns: the first place where the choice changes, or None"""
    return next((0.5 * (x[i] + x[i - 1]) for i in range(1, len(x)) if chosen[i] != chosen[i - 1]), None)


def _sweep(name, fails, label, x, point, methods, truth, failing, make, wo, more=None, **keywords):
    """:param make: x -> (category, inputs)"""
    more, curves, chosen = more or {}, {m: [] for m in methods}, []
    for v in x:
        category, inputs = make(v)
        made = probes.network(category, **inputs)
        for m in methods:
            curves[m].append(probes.albedo(_patina.MaterialProbe(made, {**more, point: m}), wo))
        chosen.append(probes.planned(made, point, TOLERANCE))
    for missing in set(chosen) - set(methods):
        curves[missing] = [probes.albedo(_patina.MaterialProbe(probes.network(make(v)[0], **make(v)[1]),
                                                                       {**more, point: missing}), wo) for v in x]
    return Sweep(name, "plan", fails, label, x, "albedo", curves, truth=curves[truth], chosen=chosen, bound=TOLERANCE,
                 failing=failing, switch=_switch(x, chosen), **keywords)


def _grid(low, high, count):
    return [low + (high - low) * i / (count - 1) for i in range(count)]


def sweeps(count):
    """Tolerance 1 %: errors of albedos stay below it, wherever what is cheapest is taken."""
    wo = probes.towards(0.4)
    return [
        _sweep("planned compensation over alpha", "Without compensation what is lost grows with alpha.", "alpha",
               _grid(0.02, 0.9, count), "energyCompensation", ("turquin", "kullaConty", "none"), "turquin", "none",
               lambda v: ("conductor_bsdf", {"roughness": (float(v),) * 2}), wo),
        _sweep("planned albedo over alpha", "Karis's curve is too dark while the lobe is narrow.", "alpha",
               _grid(0.02, 0.9, count),
               "directionalAlbedo", ("table", "fit", "karis", "quadrature"), "quadrature", "karis",
               lambda v: ("dielectric_bsdf", {"ior": 1.5, "roughness": (float(v),) * 2}), probes.towards(0.15)),
    ]
