# SPDX-License-Identifier: Apache-2.0
"""Materials of one lobe to be asked for numbers, the directions that sweeps look along, and places in scenes."""
import numpy as np
from patina import networks
from patina.cli.compiled import _patina


SEED = 20  # of all sampled numbers in the atlas


def network(category, **inputs):
    """:param category: of a BSDF node, `dielectric_bsdf`
    :param inputs: numbers, tuples or words
    :returns: the network of a material of this lobe
    """
    made = _patina.Network("/sweep")
    types = _patina.node_inputs("ND_" + category)
    bsdf = networks.add(made, "/sweep/bsdf", "ND_" + category, {name: (types[name], value) for name, value in inputs.items()})
    made.set_terminal("surface", networks.add(made, "/sweep/surface", "ND_surface", bsdf=bsdf))
    return made


def lobe(category, methods=None, **inputs):
    """:returns: the probe of a lobe, inputs as network() takes them"""
    return _patina.MaterialProbe(network(category, **inputs), methods or {})


def planned(made, point, tolerance):
    """:returns: the method that the planner takes at a choice point, the default where it leaves that open"""
    for choice in _patina.plan_material(made, tolerance=tolerance)["choices"]:
        if choice["point"] == point:
            return choice["method"]
    return dict(_patina.choice_points())[point][0][0]


def towards(cosine, turn=0.0):
    """:returns: the direction of a cosine, as a row"""
    sine = np.sqrt(max(1.0 - cosine * cosine, 0.0))
    return np.array([[sine * np.cos(turn), sine * np.sin(turn), cosine]], np.float32)


def at_degrees(degrees):
    return towards(float(np.cos(np.radians(degrees))))


def albedo(probe, wo, channel=0):
    return float(probe.albedo(wo)[0][channel])


def points(count):
    """:returns: points of a fixed sequence that fills the unit cube evenly, count x 4"""
    steps = np.array([0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101])
    return np.minimum((0.5 + np.arange(1, count + 1)[:, None] * steps) % 1.0, 1.0 - 2.0 ** -24)


def samples(probe, wo, count):
    """:returns: what sample() gives for the first of points()"""
    return probe.sample(np.repeat(wo, count, axis=0), points(count).astype(np.float32))


def sampled(probe, wo, count=4096, channel=0):
    """:returns: albedo that sampling finds"""
    return float(samples(probe, wo, count)["weight"][:, channel].astype(np.float64).mean())


def noise(probe, wo, count=4096):
    """:returns: standard deviation of one sample's weight"""
    return float(samples(probe, wo, count)["weight"][:, 0].astype(np.float64).std())


def moved(x, y, z):
    """:returns: the place of a prim that is moved and not turned, 4 x 4 row vectors"""
    matrix = np.eye(4, dtype=np.float32)
    matrix[3, :3] = x, y, z
    return matrix


def facing(axis, distance):
    """:returns: a place on an axis that looks at the origin along its -z"""
    z = np.asarray(axis, float) / np.linalg.norm(axis)
    x = np.cross([0.0, 1.0, 0.0], z)
    x /= np.linalg.norm(x)
    matrix = np.eye(4, dtype=np.float32)
    matrix[0, :3], matrix[1, :3], matrix[2, :3], matrix[3, :3] = x, np.cross(z, x), z, distance * z
    return matrix
