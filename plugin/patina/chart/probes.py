"""Materials of one lobe to be asked for numbers, and the directions that sweeps look along."""
import numpy as np

from patina.cli import compiled

SEED = 20  # of all sampled numbers in the atlas


def lobe(category, methods=None, **inputs):
    """:param category: of a BSDF node, `dielectric_bsdf`
    :param inputs: numbers, tuples or words
    :returns: its probe
    """
    patina = compiled.load()
    network = patina.Network("/sweep")
    types = patina.node_inputs("ND_" + category)
    network.add_node("/sweep/bsdf", "ND_" + category)
    for name, value in inputs.items():
        network.set_input("/sweep/bsdf", name, types[name], value)
    network.add_node("/sweep/surface", "ND_surface")
    network.connect("/sweep/surface", "bsdf", "/sweep/bsdf")
    network.set_terminal("surface", "/sweep/surface")
    return patina.MaterialProbe(network, methods or {})


def towards(cosine, turn=0.0):
    """:returns: the direction of a cosine, as a row"""
    sine = np.sqrt(max(1.0 - cosine * cosine, 0.0))
    return np.array([[sine * np.cos(turn), sine * np.sin(turn), cosine]], np.float32)


def at_degrees(degrees):
    return towards(float(np.cos(np.radians(degrees))))


def albedo(probe, wo, channel=0):
    return float(probe.albedo(wo)[0][channel])


def samples(probe, wo, count):
    """:returns: what sample() gives for `count` points of a fixed sequence that fills the unit cube evenly"""
    steps = np.array([0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101])
    u = (0.5 + np.arange(1, count + 1)[:, None] * steps) % 1.0
    return probe.sample(np.repeat(wo, count, axis=0), np.minimum(u, 1.0 - 2.0 ** -24).astype(np.float32))


def sampled(probe, wo, count=4096, channel=0):
    """:returns: albedo that sampling finds"""
    return float(samples(probe, wo, count)["weight"][:, channel].astype(np.float64).mean())


def noise(probe, wo, count=4096):
    """:returns: standard deviation of one sample's weight"""
    return float(samples(probe, wo, count)["weight"][:, 0].astype(np.float64).std())
