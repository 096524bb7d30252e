# SPDX-License-Identifier: Apache-2.0
"""Defects of a known size in sound materials, to learn which of them the looks of graphLooks.py find.

    ./patina python testenv/stability/plantedDefects.py --count 1000
"""
import argparse
import os
import sys

if __name__ == "__main__":
    folder = os.path.dirname(os.path.abspath(__file__))
    sys.path[:0] = [folder, os.path.join(folder, "..")]
    import checkout

    checkout.enter()

import graphLooks  # noqa: E402
import graphText  # noqa: E402
import numpy as np  # noqa: E402
import randomGraphs  # noqa: E402


class Planted:
    """A probe with one thing wrong in it."""

    def __init__(self, probe, seed, albedo=1.0, density=1.0, eval_density=1.0, negative=0.0):
        """:param albedo: factor of albedo()
        :param density: factor of the density that sample() and eval() claim
        :param eval_density: factor of the density that eval() claims
        :param negative: share of the sphere, about a random direction, where values are -0.01
        """
        self.probe, self.factor, self.density, self.eval_density = probe, albedo, density, eval_density
        axis = np.random.default_rng([seed, 79]).normal(size=3)
        self.axis, self.cosine = axis / np.linalg.norm(axis), 1.0 - 2.0 * negative

    def eval(self, wo, wi):
        f, pdf = self.probe.eval(wo, wi)
        return np.where((wi @ self.axis > self.cosine)[:, None], -0.01, f), pdf * (self.density * self.eval_density)

    def sample(self, wo, u):
        s = dict(self.probe.sample(wo, u))
        s["pdf"], s["weight"] = s["pdf"] * self.density, s["weight"] / self.density
        return s

    def albedo(self, wo):
        return self.probe.albedo(wo) * self.factor


def shines(probe, seed):
    """:returns: whether some light is spread at a place where it can be seen"""
    drawn = graphLooks.Drawn(probe, seed, 0)
    return bool(drawn.spread.any()) and float(drawn.samples["weight"].max()) > 0.0


def sound(patina, seeds):
    """:returns: graphs that spread light, with their probes"""
    graphs = [graphText.Graph(seed, prefix=f"g{seed}") for seed in seeds]
    networks = randomGraphs.networks(patina, [node for graph in graphs for node in graph.nodes])
    probes = [randomGraphs.Remembering(patina.MaterialProbe(network)) for network in networks]
    return [(graph, probe) for graph, probe in zip(graphs, probes, strict=True) if shines(probe, graph.seed)]


def power(graphs, **defect):
    """:param graphs: with their probes
    :returns: share of them in which a defect is found
    """
    found = [bool(graphLooks.check(Planted(probe, graph.seed, **defect), graph, graph.seed, {})[0])
             for graph, probe in graphs]
    return sum(found) / max(len(found), 1)


DEFECTS = {
    "albedo() 2 % too high": {"albedo": 1.02}, "albedo() 5 % too high": {"albedo": 1.05},
    "albedo() 20 % too high": {"albedo": 1.2},
    "density of eval() 5 % too high": {"eval_density": 1.05},
    "both densities 5 % too high": {"density": 1.05}, "both densities 20 % too high": {"density": 1.2},
    "values below 0 in 1 % of the sphere": {"negative": 0.01}, "values below 0 in 0.2 % of the sphere": {"negative": 0.002},
}
BUDGETS = ((0.0, 0.004), (0.004, 0.03), (0.03, 1.0))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=300, help="graphs")
    arguments = parser.parse_args()
    import _patina

    graphs = sound(_patina, range(arguments.seed, arguments.seed + arguments.count))
    groups = [[item for item in graphs if low <= graphLooks.budget(item[0].nodes) < high] for low, high in BUDGETS]
    print(f"{'error that albedo() may have':40}" + "".join(f"{f'{low:g} to {high:g}':>16}" for low, high in BUDGETS))
    print(f"{'graphs':40}" + "".join(f"{len(group):>16}" for group in groups))
    for name, defect in {"nothing wrong": {}, **DEFECTS}.items():
        print(f"{name:40}" + "".join(f"{power(group, **defect):>16.3f}" for group in groups), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
