# SPDX-License-Identifier: Apache-2.0
"""Shading frames that degenerate: tangents without length or along the normal, and normals that look below the horizon."""
import numpy as np

from patina import networks
from patina.chart import probes
from patina.chart.sweeps import Sweep
from patina.cli.compiled import _patina


def _tangent_unguarded(tangent):
    """Length of normalize(t - n (n.t)) for the normal +z, in single precision."""
    with np.errstate(all="ignore"):
        t = np.float32(tangent).copy()
        t[2] -= t[2]
        length = np.sqrt(np.sum(t * t, dtype=np.float32))
        t = t / length
        return float(np.sqrt(np.sum(t * t, dtype=np.float32)))


def _brushed(tangent):
    return probes.lobe("conductor_bsdf", {"energyCompensation": "none"}, roughness=(0.1, 0.5),
                       tangent=tuple(map(float, tangent)))


def _tangents(count):
    """The reflected share lies between the albedos along and across the lobe, whatever the tangent is."""
    wo = probes.towards(0.3)
    along, across = (probes.albedo(_brushed(t), wo) for t in ((1, 0, 0), (0, 1, 0)))
    middle, half = 0.5 * (along + across), 0.5 * abs(along - across) + 1e-4
    found = []
    for name, x, make, label in (
            ("tangent of no length", [0.0, *np.logspace(-30, 0, count - 1)], lambda v: (0.6 * v, 0.8 * v, 0.0), "length"),
            ("tangent along the normal", [0.0, *np.logspace(-12, 0, count - 1)], lambda v: (v, 0.0, 1.0), "slant")):
        curves = {"any direction across": [probes.albedo(_brushed(make(v)), wo) for v in x],
                  "unguarded": [middle * _tangent_unguarded(make(v)) for v in x]}
        found.append(Sweep(name, "frames", "normalize(t - n (n.t)) is 0 / 0; the pixel is lost.", label, x,
                           "albedo of a brushed metal", curves, truth=middle, chosen="any direction across", bound=half,
                           failing="unguarded", log_x=True))
    return found


def _mapped(kind, degrees, **inputs):
    slope = np.radians(degrees)
    return probes.lobe(kind, normal=(float(np.sin(slope)), 0.0, float(np.cos(slope))), **inputs)


def _unbent(degrees, wo, grid=96):
    """Lambert about the mapped normal, black where view or light are behind it or below the surface."""
    n = np.array([np.sin(np.radians(degrees)), 0.0, np.cos(np.radians(degrees))])
    if n @ wo <= 0.0:
        return 0.0
    z = (np.arange(grid) + 0.5) / grid
    t = 2.0 * np.pi * (np.arange(grid) + 0.5) / grid
    s = np.sqrt(1.0 - z[:, None] ** 2)
    cosine = n[0] * s * np.cos(t[None]) + n[2] * z[:, None]
    return float(np.maximum(cosine, 0.0).mean() * 2.0)


def _normals(count):
    """White diffuse under a slanted normal: light below the surface is lost; a view behind the normal changes nothing."""
    x = list(np.linspace(0.0, 88.0, count))
    wo = probes.towards(0.5, np.pi)  # from the side that the normal turns away from
    white = [_mapped("oren_nayar_diffuse_bsdf", d, color=(1.0,) * 3) for d in x]
    found = {"lit by its normal": [probes.sampled(probe, wo, 2048) for probe in white],
             "black behind the normal": [_unbent(d, wo[0].astype(float)) for d in x]}
    # A loss that no method avoids: the light that a slanted plane sends below the horizon.
    kept = [0.5 * (1.0 + np.cos(np.radians(d))) for d in x]
    return Sweep("normals below the horizon, diffuse", "frames",
                 "A view behind the mapped normal finds black: rims of smooth shapes and steep bumps go dark.",
                 "degrees of slant", x, "albedo, view at 60 degrees", found, truth=kept, chosen="lit by its normal", bound=0.06,
                 failing="black behind the normal", switch=30.0, shows=10)


def _mirrored(count):
    """A mirror under a slanted normal sends light below the surface; bent, it grazes."""
    x = list(np.linspace(0.0, 88.0, count))
    wo = probes.towards(0.5, np.pi)
    def plain(d):
        n = np.array([np.sin(np.radians(d)), 0.0, np.cos(np.radians(d))])
        o = wo[0].astype(float)
        return 1.0 if n @ o > 0.0 and (2.0 * (n @ o) * n - o)[2] > 0.0 else 0.0
    mirror = {"color0": (1.0,) * 3, "roughness": (0.0, 0.0)}
    found = {"bent to the horizon": [probes.sampled(_mapped("generalized_schlick_bsdf", d, **mirror), wo, 16) for d in x],
             "lost below": [plain(d) for d in x]}
    return Sweep("normals below the horizon, mirror", "frames", "The mirrored view lies below the surface, where nothing is.",
                 "degrees of slant", x, "albedo, view at 60 degrees", found, truth=1.0, chosen="bent to the horizon",
                 bound=1e-3, failing="lost below", switch=15.0, shows=100)


def _no_number(count):
    """A tangent that is no number, from a pattern, as a mesh without texture coordinates gives it."""
    x = list(np.linspace(0.05, 0.95, count))
    network = _patina.Network("/sweep")
    large = ("vector3", (3e38,) * 3)
    huge = networks.add(network, "/sweep/huge", "ND_multiply_vector3", {"in1": large, "in2": large})
    none = networks.add(network, "/sweep/none", "ND_subtract_vector3", in1=huge, in2=huge)
    bsdf = networks.add(network, "/sweep/bsdf", "ND_conductor_bsdf", {"roughness": ("vector2", (0.1, 0.5))}, tangent=none)
    network.set_terminal("surface", networks.add(network, "/sweep/surface", "ND_surface", bsdf=bsdf))
    probe = _patina.MaterialProbe(network, {"energyCompensation": "none"})
    found = {"of the surface": [probes.albedo(probe, probes.towards(c)) for c in x],
             "unguarded": [np.nan for _ in x]}
    truth = [probes.albedo(_brushed((1, 0, 0)), probes.towards(c)) for c in x]
    return Sweep("tangent that is no number", "frames", "One NaN in a tangent makes every number of the lobe one.", "cosine", x,
                 "albedo of a brushed metal", found, truth=truth, chosen="of the surface", bound=1e-4, failing="unguarded")


def sweeps(count):
    return [*_tangents(count), _no_number(count), _normals(count), _mirrored(count)]
