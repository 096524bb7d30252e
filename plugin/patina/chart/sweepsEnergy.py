# SPDX-License-Identifier: Apache-2.0
"""Energy: directional albedos by every method, what single scattering loses, and what compensation costs in reciprocity."""
import numpy as np

from patina.chart import probes
from patina.chart.sweeps import Sweep
from patina.chart.sweepsMicrofacets import white_metal

ALBEDOS = ("table", "fit", "karis", "mirror", "monteCarlo16", "monteCarlo64", "quadrature")
COMPENSATIONS = ("turquin", "kullaConty", "none")


def _albedo(method, make, wo):
    """Of a method of the renderer, or of one that is only compared: by the lobe as if smooth, or by 64 of its samples."""
    if method == "monteCarlo64":
        return probes.sampled(make({"energyCompensation": "none"}), wo, 64)
    if method == "mirror":
        return probes.albedo(make({}, 0.0), wo)
    return probes.albedo(make({"energyCompensation": "none", "directionalAlbedo": method}), wo)


def _albedos(name, fails, label, x, place, bound, failing, chosen="fit", methods=ALBEDOS, **more):
    """:param place: x -> (ior, alpha, cosine) of a coat"""
    def at(v, method):
        ior, alpha, cosine = place(v)
        return _albedo(method, lambda methods, alpha=alpha: _coat(ior, alpha, methods), probes.towards(cosine))

    curves = {m: [at(v, m) for v in x] for m in methods}
    return Sweep(name, "energy", fails, label, x, "albedo", curves, truth=curves["quadrature"], chosen=chosen, bound=bound,
                 failing=failing, **more)


def _coat(ior, alpha, methods):
    return probes.lobe("dielectric_bsdf", methods, ior=float(ior), roughness=(float(alpha),) * 2)


def _karis(count):
    grazing = list(np.logspace(-2.5, 0, count))
    rough = list(np.linspace(0.03, 1.0, count))
    ior = list(np.linspace(1.02, 3.0, count))
    few = ("table", "fit", "karis", "monteCarlo16", "quadrature")
    return [
        _albedos("albedo of a smooth coat at grazing views",
                 "Karis's fit loses energy where the lobe is narrow and the view flat.",
                 "cosine", grazing, lambda v: (1.5, 0.05, v), 5e-3, "karis", log_x=True,
                 methods=("table", "fit", "karis", "mirror", "quadrature"), shows=3),
        _albedos("albedo of a coat over roughness", "The reflectance at the view's own cosine knows nothing of roughness.",
                 "alpha", rough, lambda v: (1.5, v, 0.3), 2e-3, "mirror", shows=3),
        _albedos("albedo near ior 1", "Karis's curve rises to white at grazing views, as Schlick's does.", "ior", ior,
                 lambda v: (v, 0.3, 0.2), 2e-3, "karis", methods=few, shows=3),
        _albedos("corners of the table", "Linear cells cannot follow a narrow lobe near the horizon; the fit can.", "cosine",
                 list(np.logspace(-3.5, -0.5, count)), lambda v: (1.5, 0.011, v), 2e-3, "karis", methods=few, log_x=True,
                 shows=3)]


def _white(count):
    x = list(np.linspace(0.05, 1.0, count))
    wo = probes.towards(0.6)
    curves = {m: [probes.sampled(white_metal(a, {"energyCompensation": m}), wo, 2048) for a in x] for m in COMPENSATIONS}
    return Sweep("white metal over roughness", "energy",
                 "Light that bounces between facets is lost: about half of it where alpha is 1.", "alpha", x,
                 "albedo at cosine 0.6", curves, truth=1.0, chosen="turquin", bound=1e-2, failing="none", shows=10)


def reciprocity(probe, count=64, seed=probes.SEED):
    """:returns: mean |f(a, b) - f(b, a)| over the mean of f, for pairs with flat and steep directions"""
    generator = np.random.default_rng(seed)
    z = generator.uniform(0.03, 1.0, (count, 2))
    turn = generator.uniform(0.0, 2.0 * np.pi, (count, 2))
    a, b = (np.column_stack([np.sqrt(1 - z[:, i] ** 2) * np.cos(turn[:, i]), np.sqrt(1 - z[:, i] ** 2) * np.sin(turn[:, i]),
                             z[:, i]]).astype(np.float32) for i in (0, 1))
    there, back = probe.eval(a, b)[0][:, 0].astype(float), probe.eval(b, a)[0][:, 0].astype(float)
    return float(np.abs(there - back).mean() / max((0.5 * (there + back)).mean(), 1e-12))


def _reciprocal(count):
    x = list(np.linspace(0.1, 1.0, count))
    curves = {m: [reciprocity(white_metal(a, {"energyCompensation": m})) for a in x] for m in COMPENSATIONS}
    return Sweep("reciprocity of compensation", "energy", "A factor that hangs on one direction only is not reciprocal.",
                 "alpha", x, "defect, over the mean value", curves, truth=0.0, chosen="kullaConty", bound=2e-3,
                 failing="turquin", shows=3)


def sweeps(count):
    return [*_karis(count), _white(count), _reciprocal(count)]
