# SPDX-License-Identifier: Apache-2.0
"""Fits the directional albedo of the Conty-Kulla sheen lobe: `sheenFit.py OUT.h`.

Its logarithm is nearly a polynomial in the root of the cosine and the logarithm of the roughness. Fitted by
Levenberg and Marquardt's method to quadrature of the lobe as shaders/lib/contyKulla.glsl has it; above 1, where the
lobe is divided by its albedo, relative errors count. Needs numpy and scipy; takes a minute on one core.
"""
import math
import sys

import numpy as np
from scipy.optimize import least_squares

ACROSS, ALONG = 5, 4  # degrees in the cosine and in the roughness
SIDE = 40             # cells along both axes
ROUGHNESS_MIN = 0.01  # SHEEN_ROUGHNESS_MIN

HEAD = """\
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/shaders.h"

// The directional albedo of the Conty-Kulla sheen lobe before it is bounded, as a polynomial in the
// root of the cosine and the logarithm of the roughness.
// Written by shaders/bake/sheenFit.py. Over {side} x {side} cell centres: RMSE {rms:.1e}, largest
// error {largest:.1e}. Only measured: the renderer has the table.

// mu in [0, 1], roughness in [SHEEN_ROUGHNESS_MIN, 1].
inline float sheenAlbedoFit(float mu, float roughness) {{
    using namespace patina::sh;
    float x = sqrt(mu);
    float y = log2(roughness);
"""


def albedo(mu, roughness, count=64):
    """:returns: share of the light that the lobe reflects, by Gauss and Legendre's rule"""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    root = (nodes + 1.0) / 2.0
    z, phi = np.meshgrid(root * root, math.pi * root, indexing="ij")
    weight = np.outer(weights * root, weights) * math.pi
    sineView, sineLight = math.sqrt(1.0 - mu * mu), np.sqrt(1.0 - z * z)
    x, y = sineView + sineLight * np.cos(phi), sineLight * np.sin(phi)
    across = x * x + y * y
    sine2 = across / (across + (mu + z) ** 2)
    density = (2.0 + 1.0 / roughness) / (2.0 * math.pi) * sine2 ** (0.5 / roughness)
    return float((weight * 0.25 * density * z / (mu + z - mu * z)).sum())


def places(side):
    for i in range(side):
        for j in range(side):
            root = (j + 0.5) / side
            yield (i + 0.5) / side, ROUGHNESS_MIN + (1.0 - ROUGHNESS_MIN) * root * root


def _group(text):
    return f"({text})" if " " in text else text


def main(path):
    mu, roughness = np.array(list(places(SIDE))).T
    truth = np.array([albedo(*place) for place in zip(mu, roughness)])
    x, y = np.sqrt(mu), np.log2(roughness)
    basis = np.stack([x ** a * y ** b for a in range(ACROSS + 1) for b in range(ALONG + 1)], 1)
    matters = np.minimum(truth, 1.0)
    first = np.linalg.lstsq(basis * matters[:, None], np.log2(truth + 1e-12) * matters, rcond=None)[0]

    def errors(c):
        return (np.exp2(np.minimum(basis @ c, 4.0)) - truth) / np.maximum(truth, 1.0)

    found = least_squares(errors, first, method="lm", max_nfev=20000)
    # Written numbers have single precision.
    numbers = [float(np.float32(c)) for c in found.x]
    left = errors(np.array(numbers))
    with open(path, "w", encoding="utf-8") as out:
        out.write(HEAD.format(side=SIDE, rms=math.sqrt((left ** 2).mean()), largest=abs(left).max()))
        for a in range(ACROSS + 1):
            row = numbers[a * (ALONG + 1):(a + 1) * (ALONG + 1)]
            text = f"{row[-1]:.8g}f"
            for c in reversed(row[:-1]):
                text = f"{_group(text)} * y {'-' if c < 0 else '+'} {abs(c):.8g}f"
            out.write(f"    float c{a} = {text};\n")
        text = f"c{ACROSS}"
        for a in reversed(range(ACROSS)):
            text = f"{_group(text)} * x + c{a}"
        out.write(f"    return exp2(min({text}, 4.0f));\n}}\n")


if __name__ == "__main__":
    main(sys.argv[1])
