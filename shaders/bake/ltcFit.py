# SPDX-License-Identifier: Apache-2.0
"""Writes shaders/lib/ltcFit.glsl: linear transforms of a cosine (Heitz, Dupuy, Hill and Neubelt 2016, "Real-Time
Polygonal-Light Shading with Linearly Transformed Cosines") that stand for the reflection of isotropic GGX facets.

  python ltcFit.py OUT.glsl

For each place of a grid of cosine and roughness, the transform under which light drawn from the lobe is most likely
(least Kullback-Leibler divergence); then a small network through all places, so that no table is needed. Takes about two
minutes.
"""
import sys

import fitText
import numpy as np
from scipy import optimize

MUS, ALPHAS, UNITS = 20, 20, 12
SIDE = 40

HEAD = """// A linear transform of the clamped cosine that stands for the reflection of isotropic GGX facets
// (Heitz, Dupuy, Hill and Neubelt 2016): in a frame with the normal as z and the view in the xz plane,
// light from l is as likely as the cosine's from
//   (a l.x + b l.z, c l.y, d l.x + l.z), normalized.
// Written by shaders/bake/ltcFit.py: the most likely transforms over {mus} x {alphas} places of cosine and
// roughness, by a small network. Mean divergence from the lobe {mean:.3f} nats, {own:.3f} before the network.

PATINA_FN vec4 ltcBend(vec4 z) {{
    return z / sqrt(vec4(1.0f) + z * z);
}}

// mu: cosine of the view, in [0, 1]. alpha: in [ALPHA_MIRROR, 1]. @returns (a, b, c, d)
PATINA_FN vec4 ltcFit(float mu, float alpha) {{
    float x0 = sqrt(mu);
    float x1 = log(alpha);
    float x2 = mu / sqrt(mu * mu + alpha * alpha);
"""
TAIL = """    float c = exp(z.y);
    return vec4(exp(z.x), z.z * c, c, z.w);
}
"""


def lobe(mu, alpha):
    """Directions with the density of the lobe times cosine, and weights: VNDF samples on a grid."""
    u, v = (np.arange(SIDE) + 0.5) / SIDE, (np.arange(SIDE) + 0.5) / SIDE
    u, v = (x.ravel() for x in np.meshgrid(u, v))
    o = np.array([np.sqrt(1.0 - mu * mu), 0.0, mu])
    stretched = o * np.array([alpha, alpha, 1.0])
    stretched /= np.linalg.norm(stretched)
    z = (1.0 - v) * (1.0 + stretched[2]) - stretched[2]
    r, phi = np.sqrt(np.maximum(1.0 - z * z, 0.0)), 2.0 * np.pi * u
    h = np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=1) + stretched
    m = h * np.array([alpha, alpha, 1.0])
    m /= np.linalg.norm(m, axis=1, keepdims=True)
    wi = 2.0 * (m @ o)[:, None] * m - o
    above = wi[:, 2] > 1e-4
    wi = wi[above]
    length = np.sqrt(alpha * alpha * (1.0 - wi[:, 2] ** 2) + wi[:, 2] ** 2)
    of_view = np.sqrt(alpha * alpha * (1.0 - mu * mu) + mu * mu)
    # G2 / G1: what of the visible facets' light gets out.
    weight = wi[:, 2] * (mu + of_view) / (of_view * wi[:, 2] + length * mu)
    # The lobe times the cosine, over its albedo.
    m = m[above]
    d = alpha * alpha / (np.pi * ((m[:, 0] ** 2 + m[:, 1] ** 2) + (alpha * m[:, 2]) ** 2) ** 2)
    density = d * wi[:, 2] / (2.0 * (of_view * wi[:, 2] + length * mu))
    albedo = weight.sum() / SIDE ** 2
    return wi, weight / weight.sum(), np.log(density / albedo)


def log_density(raw, wi):
    """Of the transformed cosine; raw: log a, log c, b / c, d."""
    a, c = np.exp(raw[0]), np.exp(raw[1])
    b, d = raw[2] * c, raw[3]
    x, y, z = a * wi[:, 0] + b * wi[:, 2], c * wi[:, 1], d * wi[:, 0] + wi[:, 2]
    length2 = x * x + y * y + z * z
    determinant = c * abs(a - b * d)
    floor = 1e-3 * np.sqrt(length2)  # what falls below the horizon is unlikely, not impossible
    above = np.maximum(z, floor / (2.0 - np.minimum(z / floor, 1.0)))
    return np.log(above * np.maximum(determinant, 1e-30) / (np.pi * length2 ** 2))


def main():
    mus = ((np.arange(MUS) + 0.5) / MUS) ** 1.3
    alphas = np.exp(np.linspace(np.log(0.006), 0.0, ALPHAS))
    raws, own, lobes = np.zeros((ALPHAS, MUS, 4)), 0.0, {}
    for i in reversed(range(ALPHAS)):
        for k in reversed(range(MUS)):
            wi, weight, target = lobe(mus[k], alphas[i])
            start = raws[i, k + 1] if k + 1 < MUS else raws[i + 1, k] if i + 1 < ALPHAS else np.zeros(4)
            found = optimize.minimize(lambda r: -weight @ log_density(r, wi), start, method="Nelder-Mead",
                                      options={"maxiter": 1500, "maxfev": 1500, "xatol": 1e-5, "fatol": 1e-8,
                                               "adaptive": True})
            raws[i, k] = found.x
            lobes[i, k] = wi, weight, target
            own += weight @ target + found.fun
    own /= MUS * ALPHAS
    a, m = np.meshgrid(alphas, mus, indexing="ij")
    inputs = np.stack([np.sqrt(m), np.log(a), m / np.sqrt(m * m + a * a)], axis=-1).reshape(-1, 3)
    wanted = raws.reshape(-1, 4)
    shapes = [(3, UNITS), (UNITS,), (UNITS, UNITS), (UNITS,), (UNITS, 4), (4,)]

    def layers(flat):
        parts, at = [], 0
        for shape in shapes:
            size = int(np.prod(shape))
            parts.append(flat[at:at + size].reshape(shape))
            at += size
        return [(parts[j], parts[j + 1]) for j in range(0, len(parts), 2)]

    def network(flat):
        x = inputs
        for matrix, offsets in layers(flat)[:-1]:
            z = x @ matrix + offsets
            x = z / np.sqrt(1.0 + z * z)
        matrix, offsets = layers(flat)[-1]
        return x @ matrix + offsets

    best = None
    for seed in range(4):
        random = np.random.default_rng(seed)
        start = np.concatenate([random.normal(0.0, 0.6, int(np.prod(s))) for s in shapes])
        found = optimize.least_squares(lambda f: (network(f) - wanted).ravel(), start, max_nfev=600)
        if best is None or found.cost < best.cost:
            best = found
    fitted = network(best.x).reshape(ALPHAS, MUS, 4)
    mean = np.mean([lobes[i, k][1] @ (lobes[i, k][2] - log_density(fitted[i, k], lobes[i, k][0]))
                    for i in range(ALPHAS) for k in range(MUS)])
    text, names = HEAD.format(mus=MUS, alphas=ALPHAS, mean=mean, own=own), ["x0", "x1", "x2"]
    for j, (matrix, offsets) in enumerate(layers(best.x)[:-1]):
        part, names = fitText.hidden(j, matrix, offsets, names)
        text += part.replace("fitBend", "ltcBend")
    matrix, offsets = layers(best.x)[-1]
    text += fitText._sum("z", "vec4", matrix, offsets, slice(0, 4), names) + TAIL
    print(f"divergence {own:.4f}, through the network {mean:.4f}, largest difference {abs(fitted - raws).max(axis=(0, 1))}")
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
