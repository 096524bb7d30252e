# SPDX-License-Identifier: Apache-2.0
"""Thin films: Gaussians and tables against Airy's formula over the spectrum, from no thickness to 60 um."""
import numpy as np

from patina.chart import probes
from patina.chart.sweeps import Sweep

NM = np.arange(380.0, 780.0, 1.0)
METHODS = ("gaussian", "table", "spectral")
WAVES = (650.0, 532.0, 450.0)  # one wavelength for each channel
IN = 0.1  # FILM_THICKNESS_MIN in nm


def sensitivities():
    """:returns: what the linear channels see of NM, each of sum 1: multi-lobe fits of Wyman, Sloan and Shirley 2013"""
    def lobe(center, below, above):
        return np.exp(-0.5 * ((NM - center) / np.where(NM < center, below, above)) ** 2)

    x = 1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2)
    y = 0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1)
    z = 1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)
    rgb = np.array([3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                    0.0556434 * x - 0.2040259 * y + 1.0572252 * z])
    return rgb / rgb.sum(axis=1, keepdims=True)


def airy(cosine, thickness, film, n, k, nm):
    """Reflectance of one film on a base of complex ior, at wavelengths, mean of both polarisations."""
    s2 = 1.0 - cosine ** 2
    inner, base = np.sqrt(complex(film ** 2 - s2)), np.sqrt(complex(n, k) ** 2 - s2)
    m, f2 = complex(n, k) ** 2, film ** 2
    turn = np.exp(2j * 2.0 * np.pi * thickness * inner / nm)
    total = 0.0
    for top, bottom in (((cosine - inner) / (cosine + inner), (inner - base) / (inner + base)),
                        ((f2 * cosine - inner) / (f2 * cosine + inner), (m * inner - f2 * base) / (m * inner + f2 * base))):
        total = total + 0.5 * np.abs((top + bottom * turn) / (1.0 + top * bottom * turn)) ** 2
    return total


def _film(thickness, film, methods, metal=None):
    more = {"roughness": (0.0, 0.0), "thinfilm_thickness": float(thickness), "thinfilm_ior": float(film)}
    if metal:
        return probes.lobe("conductor_bsdf", methods, ior=(metal[0],) * 3, extinction=(metal[1],) * 3, **more)
    return probes.lobe("dielectric_bsdf", methods, ior=1.5, **more)


def _thickness(name, x, film, bound, shows, metal=None, cosine=0.6, channel=1):
    base = metal or (1.5, 0.0)
    wo, seen = probes.towards(cosine), sensitivities()[channel]
    curves = {m: [probes.albedo(_film(d, film, {"thinFilm": m}, metal), wo, channel) for d in x] for m in METHODS}
    curves["one wavelength"] = [float(airy(cosine, d, film, *base, WAVES[channel])) for d in x]
    truth = [float((airy(cosine, d, film, *base, NM) * seen).sum()) for d in x]
    return Sweep(name, "thin film",
                 "One wavelength for each channel never loses its colour; Gaussians and tables of what a channel sees do.",
                 "thickness in nm", x, f"reflectance at cosine {cosine}, green", curves, truth=truth, chosen="gaussian",
                 bound=bound, failing="one wavelength", switch=IN if x[0] < IN else None, log_x=True, shows=shows)


def _matched(count):
    """A film of the ior of air: the bare reflectance, however thick."""
    x = [0.0, *np.logspace(-1, 4.7, count - 1)]
    wo = probes.towards(0.6)
    def schlick(d):
        return probes.lobe("generalized_schlick_bsdf", color0=(0.5,) * 3, roughness=(0.0, 0.0),
                           thinfilm_thickness=float(d), thinfilm_ior=1.0)
    bare = probes.albedo(probes.lobe("generalized_schlick_bsdf", color0=(0.5,) * 3, roughness=(0.0, 0.0)), wo)
    return Sweep("film of the ior of air", "thin film",
                 "Schlick's curve counted as both polarisations and halved loses half of the light under any film.",
                 "thickness in nm", x, "reflectance, color0 0.5",
                 {"difference of dielectrics": [probes.albedo(schlick(d), wo) for d in x],
                  "curve halved": [bare if d <= 0.0 else 0.5 * bare for d in x]},
                 truth=bare, chosen="difference of dielectrics", bound=1e-3, failing="curve halved", log_x=True, shows=50)


def _bright_metal(count):
    x = list(np.linspace(50.0, 1000.0, count))
    return _thickness("film on a bright metal", x, 1.8, 6e-3, 1.5, metal=(0.2, 3.4), cosine=0.3)


def _thin(count):
    """A film that vanishes is no film: sensitivities whose sum is not 1 make a step at 0."""
    x = list(np.linspace(0.0, 3.0, max(count, 16)))
    found = _thickness("film of 0 to 3 nm", x, 1.8, 2.5e-3, 1.0)
    green = -0.9692660 + 1.8760108 + 0.0415560  # of an equal energy spectrum
    found.curves["not normalised"] = [v if d <= IN else v * green for d, v in zip(x, found.truth)]
    found.fails = ("Sensitivities of sRGB that are not scaled to 1 make a white that is not the light's: a step where the film "
                   "begins.")
    found.failing, found.log_x, found.switch = "not normalised", False, IN
    del found.curves["one wavelength"]
    return found


def _rough(count):
    """The mean over facets reads the reflectance of films below a quarter of a wave at six cosines, between which thicker
    ones wave; those are read at facets."""
    x = list(np.linspace(0.0, 3000.0, count))
    wo = probes.towards(0.7)
    found, truth, smooth = [], [], []
    for d in x:
        made = lambda m, alpha=0.6: probes.lobe("dielectric_bsdf", {"energyCompensation": "none", "directionalAlbedo": m},
                                                ior=1.5, roughness=(alpha, alpha), thinfilm_thickness=float(d),
                                                thinfilm_ior=1.8)
        found.append(probes.albedo(made("table"), wo, 1))
        truth.append(probes.albedo(made("quadrature"), wo, 1))
        smooth.append(probes.albedo(made("table", 0.0), wo, 1))
    return Sweep("film on a rough interface", "thin film",
                 "The reflectance at the view's own cosine is not the mean over facets.", "thickness in nm", x, "albedo, green",
                 {"table": found, "mirror": smooth}, truth=truth, chosen="table", bound=1e-2, failing="mirror", shows=1.5)


def sweeps(count):
    thin = [0.0, *np.logspace(-2, 1, count // 2), *np.logspace(1.2, 4.778, count)]
    return [_thickness("film from nothing to 60 um", thin, 1.33, 1.2e-2, 1.5),
            _thin(count), _bright_metal(count), _matched(count), _rough(count)]


