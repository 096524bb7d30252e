# SPDX-License-Identifier: Apache-2.0
"""How far the methods that estimate an albedo are off: where graphLooks.GUESSES comes from.

    ./patina python testenv/stability/guessedAlbedos.py

Schlick lobes on a grid of roughnesses and directions. A white lobe reflects all light once its multiple scattering is
compensated. The compensation divides by an albedo of the method, so that the lobe's values beside those with the exact albedo
tell how much it gains or loses. What albedo() claims is compared too, also for curves that rise or fall from 0 to 1.
"""
import os
import sys

if __name__ == "__main__":
    folder = os.path.dirname(os.path.abspath(__file__))
    sys.path[:0] = [folder, os.path.join(folder, "..")]
    import checkout

    checkout.enter()

import graphLooks  # noqa: E402
import mtlx  # noqa: E402
import numpy as np  # noqa: E402
import randomGraphs  # noqa: E402

ROUGHNESSES = (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.85, 1.0)
ACROSS = (0.05, 0.3, 1.0)  # beside equal ones
COSINES = np.linspace(0.02, 1.0, 50)
AZIMUTHS = np.linspace(0.0, np.pi, 17)
CURVES = ((1, 1), (1, 0), (0, 1))  # at normal incidence and at grazing
DISTRIBUTIONS = ("ggx", "beckmann")


def _directions():
    cosine, azimuth = (grid.ravel() for grid in np.meshgrid(COSINES, AZIMUTHS, indexing="ij"))
    sine = np.sqrt(1.0 - cosine ** 2)
    wo = np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), cosine], -1).astype(np.float32)
    wi = np.array([0.1, 0.05, np.sqrt(1.0 - 0.1 ** 2 - 0.05 ** 2)], np.float32)
    return wo, np.repeat(wi[None], len(wo), 0)


def largest(patina, method):
    """:param method: of directionalAlbedo
    :returns: the largest error of an albedo on the grid, and curve, roughnesses, distribution and direction of it"""
    wo, wi = _directions()
    found = (0.0,)
    for curve in CURVES:
        for distribution in DISTRIBUTIONS:
            for x in ROUGHNESSES:
                for y in sorted({x, *ACROSS}):
                    network = randomGraphs.load(patina, mtlx.document(mtlx.lobe("m", "generalized_schlick_bsdf", {
                        "color0": (curve[0],) * 3, "color90": (curve[1],) * 3, "roughness": (x, y),
                        "distribution": distribution})))
                    exact, guess = (patina.MaterialProbe(network, methods)
                                    for methods in ({}, {"directionalAlbedo": method}))
                    error = np.abs(guess.albedo(wo)[:, 0] - exact.albedo(wo)[:, 0])
                    if curve == (1, 1):
                        true, values = (probe.eval(wo, wi)[0][:, 0] for probe in (exact, guess))
                        ratio = np.divide(values, true, out=np.ones_like(true), where=true > 0.0)
                        error = np.maximum(error, np.abs(ratio - 1.0))
                    worst = int(error.argmax())
                    found = max(found, (float(error[worst]), curve, x, y, distribution, wo[worst].round(3).tolist()))
    return found


def main():
    import _patina

    for method, bound in graphLooks.GUESSES.items():
        error, *place = largest(_patina, method)
        print(f"{method}: {error:.3f} (bound {bound}) at {place}")


if __name__ == "__main__":
    main()
