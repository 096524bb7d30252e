# SPDX-License-Identifier: Apache-2.0
"""The meanings of a layer, against a walk between the interfaces: how far a varnish is from what MaterialX defines."""
import numpy as np

from patina.chart import probes
from patina.chart.sweeps import Sweep
from patina.cli import layers


def _stack(name, fails, label, x, make, cosine, bound, walks):
    """:param make: x -> interfaces and base, as layers.STACKS has them"""
    generator = np.random.default_rng(probes.SEED)
    wo = probes.towards(cosine)
    curves, truth = {"albedoScaling": [], "returned": [], "positionFree": []}, []
    for v in x:
        interfaces, base = make(v)
        for method in ("albedoScaling", "returned"):
            curves[method].append(probes.albedo(layers.scaled(interfaces, base, {"layering": method}), wo))
        curves["positionFree"].append(probes.sampled(layers.scaled(interfaces, base, {"layering": "positionFree"}), wo, walks))
        truth.append(float(layers.walk(layers.parts(interfaces, base, {}), wo[0], walks, generator)[0][0]))
    return Sweep(name, "layers", fails, label, x, f"albedo at cosine {cosine}", curves, truth=truth, chosen="positionFree",
                 bound=bound, failing="albedoScaling", shows=2)


def sweeps(count):
    base = list(np.linspace(0.1, 1.0, count))
    rough = list(np.linspace(0.0, 0.9, count))
    ior = list(np.linspace(1.1, 2.4, count))
    walks = 1000 * min(count, 20)
    return [
        _stack("layer over grey",
               "Albedo scaling counts light that an interface sends back down as leaving: grey is brighter.",
               "colour of the base", base, lambda v: ([(1.5, 0.0)], (float(v),) * 3), 0.8, 0.03, walks),
        _stack("layer over roughness", "The same, whatever the roughness of the interface.", "alpha",
               rough, lambda v: ([(1.5, float(v))], (0.5,) * 3), 0.8, 0.03, walks),
        _stack("layer over its ior", "The more the interface reflects inwards, the more is counted twice.", "ior", ior,
               lambda v: ([(float(v), 0.0)], (0.5,) * 3), 0.8, 0.03, walks)]
