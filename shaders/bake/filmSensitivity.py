# SPDX-License-Identifier: Apache-2.0
"""Prints the constants of shaders/lib/film.glsl: needs numpy and scipy.

The sensitivity of each linear Rec.709 channel, under an equal energy spectrum and scaled to 1, is
transformed over optical path difference and fitted there by a sum of Gaussians in wavenumber: the
method of Belcour and Barla 2017, applied to RGB instead of XYZ. Colour matching functions are the
fits of Wyman, Sloan and Shirley 2013 (multi-lobe).
"""

import numpy as np
from scipy.optimize import least_squares

WAVELENGTHS = np.arange(360.0, 831.0)  # nm
PATHS = np.arange(0.0, 8001.0, 20.0)  # nm
XYZ_TO_RGB = np.array([[3.2404542, -1.5371385, -0.4985314],
                       [-0.9692660, 1.8760108, 0.0415560],
                       [0.0556434, -0.2040259, 1.0572252]])


def lobe(center, below, above):
    width = np.where(WAVELENGTHS < center, below, above)
    return np.exp(-0.5 * ((WAVELENGTHS - center) / width) ** 2)


def channels():
    """Rows r, g, b over WAVELENGTHS."""
    x = 1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2)
    y = 0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1)
    z = 1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)
    return XYZ_TO_RGB @ np.array([x, y, z])


def model(p, paths):
    """Amplitudes (scaled to a sum of 1), wavenumbers and widths in 1/um."""
    a, b, c = np.split(p, 3)
    phase = 2.0 * np.pi * paths * 1e-3
    return sum(w * np.exp(1j * k * phase - (s * phase) ** 2) for w, k, s in zip(a / a.sum(), b, c))


def fit(sensitivity, terms):
    target = np.array([np.sum(sensitivity * np.exp(2j * np.pi * d / WAVELENGTHS)) for d in PATHS]) / sensitivity.sum()

    def residual(p):
        d = model(p, PATHS) - target
        return np.concatenate([d.real, d.imag])

    random = np.random.default_rng(1)
    tries = [least_squares(residual, np.concatenate([random.normal(0.6, 0.5, terms), random.uniform(1.5, 2.4, terms),
                                                     random.uniform(0.03, 0.1, terms)]), max_nfev=300)
             for _ in range(30)]
    best = min(tries, key=lambda r: r.cost).x
    return best, np.abs(model(best, PATHS) - target).max()


if __name__ == "__main__":
    for name, sensitivity in zip("rgb", channels()):
        p, error = fit(sensitivity, 4)
        a, b, c = np.split(p, 3)
        print(f"{name}: largest error {error:.4f}")
        for w, k, s in zip(a / a.sum(), b, np.abs(c)):
            print(f"    amplitude {w:.6f}, wavenumber {k:.6f} / um, width {s:.6f} / um")
