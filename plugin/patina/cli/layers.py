# SPDX-License-Identifier: Apache-2.0
"""Layers as they are meant against a position-free random walk (Guo, Hasan and Zhao 2018, "Position-Free Monte Carlo
Simulation for Arbitrary Layered BSDFs"): light bounces between the interfaces and the base, each with its whole
lobes, until it leaves. Nothing lies between the layers and they are infinitely thin, so positions do not matter.
"""
import math

import numpy as np
from patina import networks
from patina.cli.compiled import _patina


ANGLES = (0.0, 45.0, 75.0)
BOUNCES = 400  # at most; roulette ends walks long before
TRANSMIT = 2  # event of samples that cross an interface
WHITE, GREY, BLUE = (1.0,) * 3, (0.5,) * 3, (0.05, 0.2, 0.8)

# interfaces from the top down as (ior, alpha), and the base: a diffuse colour or "gold"
STACKS = {
    "smooth 1.5 over white": ([(1.5, 0.0)], WHITE),
    "smooth 1.5 over grey": ([(1.5, 0.0)], GREY),
    "smooth 1.5 over blue": ([(1.5, 0.0)], BLUE),
    "smooth 2.0 over grey": ([(2.0, 0.0)], GREY),
    "alpha 0.1 over grey": ([(1.5, 0.1)], GREY),
    "alpha 0.4 over grey": ([(1.5, 0.4)], GREY),
    "alpha 0.4 over white": ([(1.5, 0.4)], WHITE),
    "smooth 1.5 over gold": ([(1.5, 0.0)], "gold"),
    "alpha 0.4 over gold": ([(1.5, 0.4)], "gold"),
    "two coats over grey": ([(1.4, 0.0), (1.5, 0.2)], GREY),
}


class _Builder:
    def __init__(self):
        self.network = _patina.Network("/layers")
        self.count = 0

    def node(self, kind, inputs=None, **sources):
        self.count += 1
        return networks.add(self.network, f"/layers/n{self.count}", kind, inputs, **sources)

    def interface(self, ior, alpha, mode):
        return self.node("ND_dielectric_bsdf", {"ior": ("float", ior), "roughness": ("vector2", (alpha, alpha)),
                                                "scatter_mode": ("string", mode)})

    def base(self, base):
        if base == "gold":
            return self.node("ND_conductor_bsdf", {"roughness": ("vector2", (0.2, 0.2))})
        return self.node("ND_oren_nayar_diffuse_bsdf", {"color": ("color3", base)})

    def probe(self, bsdf, methods):
        self.network.set_terminal("surface", self.node("ND_surface", bsdf=bsdf))
        return _patina.MaterialProbe(self.network, methods)


def scaled(interfaces, base, methods):
    """:returns: probe of the stack as the renderer has it: layers by albedo scaling, unless `methods` give another meaning"""
    builder = _Builder()
    bsdf = builder.base(base)
    for ior, alpha in reversed(interfaces):
        bsdf = builder.node("ND_layer_bsdf", top=builder.interface(ior, alpha, "R"), base=bsdf)
    return builder.probe(bsdf, methods)


def parts(interfaces, base, methods):
    """:returns: probes of the interfaces, which reflect and transmit, and of the base

    An ior is relative to what is above its layer, as it is in a network.
    """
    probes = []
    for ior, alpha in interfaces:
        builder = _Builder()
        probes.append(builder.probe(builder.interface(ior, alpha, "RT"), methods))
    builder = _Builder()
    return probes + [builder.probe(builder.base(base), methods)]


def walk(probes, wo, count, generator):
    """:returns: albedo at wo and its standard error, both as arrays of three"""
    alive = np.arange(count)
    level = np.zeros(count, int)
    back = np.tile(np.asarray(wo, np.float32), (count, 1))
    throughput, out = np.ones((count, 3)), np.zeros((count, 3))
    for _ in range(BOUNCES):
        if not len(alive):
            break
        wi, weight, event = np.zeros((len(alive), 3), np.float32), np.zeros((len(alive), 3)), np.zeros(len(alive), int)
        u = generator.random((len(alive), 4), dtype=np.float32)
        for i, probe in enumerate(probes):
            at = np.flatnonzero(level == i)
            if len(at):
                found = probe.sample(np.ascontiguousarray(back[at]), np.ascontiguousarray(u[at]))
                wi[at], weight[at], event[at] = found["wi"], found["weight"], found["event"]
        throughput = throughput * weight
        # Upwards and downwards follow from the side and the event, not from directions that graze.
        up = (back[:, 2] >= 0.0) != ((event & TRANSMIT) != 0)
        level = level + np.where(up, -1, 1)
        going = event != 0
        left = going & (level < 0)
        out[alive[left]] = throughput[left]
        chance = np.minimum(throughput.max(axis=1), 1.0)
        going &= (level >= 0) & (level < len(probes)) & (generator.random(len(alive)) < chance)
        throughput = throughput[going] / np.maximum(chance[going], 1e-30)[:, None]
        alive, level, back = alive[going], level[going], -wi[going]
    return out.mean(axis=0), out.std(axis=0) / math.sqrt(count)


def compare(interfaces, base, methods, count, generator):
    """Yields (degrees, albedo of the layers, albedo of the walk, its standard error)."""
    layered, probes = scaled(interfaces, base, methods), parts(interfaces, base, methods)
    for degrees in ANGLES:
        t = math.radians(degrees)
        wo = np.array([math.sin(t), 0.0, math.cos(t)], np.float32)
        true, error = walk(probes, wo, count, generator)
        yield degrees, layered.albedo(wo[None])[0].astype(float), true, error


HEAD = f"{'stack':<24}{'degrees':>8}{'layers':>9}{'walk':>9}{'less':>9}{'noise':>9}"


def rows(methods, count, seed):
    """Yields dicts, the rows of what `patina check --layers` prints: len(STACKS) * len(ANGLES) of them."""
    generator = np.random.default_rng(seed)
    for name, (interfaces, base) in STACKS.items():
        for degrees, ours, true, error in compare(interfaces, base, methods, count, generator):
            yield {"stack": name, "degrees": degrees, "scaled": ours.tolist(), "walk": true.tolist(),
                   "noise": error.tolist()}


def line(row):
    """:returns: a row as text, of the channel where layers are furthest from the walk"""
    errors = [a - b for a, b in zip(row["scaled"], row["walk"])]
    c = max(range(3), key=lambda i: abs(errors[i]))
    return (f"{row['stack']:<24}{row['degrees']:>8.0f}{row['scaled'][c]:>9.4f}{row['walk'][c]:>9.4f}"
            f"{errors[c]:>+9.4f}{row['noise'][c]:>9.4f}")
