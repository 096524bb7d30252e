# SPDX-License-Identifier: Apache-2.0
"""Fits three facets that stand in for all: `albedoFit.py NODES.bin CENTRES.bin OUT.glsl`.

The directional albedo of an isotropic GGX reflection is the mean of the reflectance F over the
facets that the view sees. Three facets with the right lean and weight give that mean for every F
that is no rougher than a Fresnel curve, as a Gauss rule gives the integral of every low polynomial.
So the rule hangs on view and roughness alone: one small network (two layers of eight units) has its
nine numbers, and dielectrics, conductors and Schlick's curve are read through the same three places.

Fitted by Levenberg and Marquardt's method to the albedos themselves, over the curves of
reflectanceCurves.py and the places in NODES.bin; CENTRES.bin is only measured. Both from
microfacetCosines:
    microfacetCosines 600 40 40 NODES.bin; microfacetCosines 800 -32 -32 CENTRES.bin
Needs numpy; takes some minutes on one core. Starts and steps are fixed: a few from different random
numbers, of which the best goes on.
"""
import sys

import numpy as np

import fitText
import reflectanceCurves

UNITS = (8, 8)
MICROFACETS = 3
SEEDS = (1, 2, 3, 4)
FIRST_STEPS = 150
STEPS = 2400
GRID = 4000  # places at which a curve is tabulated


class Curves:
    """All curves and their slopes, tabulated evenly in the root of the cosine."""

    def __init__(self):
        named = reflectanceCurves.curves()
        self.names = [name for name, _ in named]
        self.functions = [function for _, function in named]
        root = np.linspace(0.0, 1.0, GRID + 1)
        cosine = np.maximum(root * root, 1e-12)
        self._value = np.stack([f(cosine) for f in self.functions], 1)
        self._slope = np.gradient(self._value, root, axis=0)

    def at(self, c):
        """:returns: values and slopes in c, (places, curves); c outside [0, 1] is clamped"""
        root = np.sqrt(np.clip(c, 1e-9, 1.0))
        cell = np.minimum((root * GRID).astype(int), GRID - 1)
        t = (root * GRID - cell)[:, None]
        value = self._value[cell] * (1.0 - t) + self._value[cell + 1] * t
        slope = self._slope[cell] * (1.0 - t) + self._slope[cell + 1] * t
        inside = ((c > 1e-9) & (c < 1.0))[:, None]
        return value, slope / (2.0 * np.maximum(root, 1e-3))[:, None] * inside


class Places:
    """Views and roughnesses with the true albedo of every curve."""

    def __init__(self, path, curves):
        raw = np.fromfile(path)
        bins = int(raw[0])
        rows = raw[1:].reshape(-1, 2 + 2 * bins)
        self.mu, self.alpha = rows[:, 0], rows[:, 1]
        light, cosine = rows[:, 2:2 + bins], rows[:, 2 + bins:]
        cosine = np.maximum(cosine, 1e-12)
        self.albedo = np.stack([(light * f(cosine)).sum(1) for f in curves.functions], 1)
        self.inputs = np.stack([np.sqrt(self.mu), np.sqrt(self.alpha),
                                self.mu / np.hypot(self.mu, self.alpha)], 1)


class Network:
    """Layers of units z / sqrt(1 + z^2), then a linear one. Outputs: lean, side, weight per facet."""

    def __init__(self, seed):
        random = np.random.default_rng(seed)
        self.sizes = [3, *UNITS, 3 * MICROFACETS]
        parts = []
        for a, b in zip(self.sizes, self.sizes[1:]):
            parts += [random.normal(0.0, 1.5 / np.sqrt(a), a * b), random.normal(0.0, 0.5, b)]
        parts[-2] *= 0.3
        parts[-1] = np.r_[np.linspace(-0.7, 1.0, MICROFACETS), np.full(MICROFACETS, 0.5),
                          np.full(MICROFACETS, 1.0 / MICROFACETS)]
        self.numbers = np.concatenate(parts)

    def layers(self, numbers):
        """:returns: list of (matrix, offsets)"""
        found, at = [], 0
        for a, b in zip(self.sizes, self.sizes[1:]):
            found.append((numbers[at:at + a * b].reshape(a, b), numbers[at + a * b:at + a * b + b]))
            at += a * b + b
        return found

    def run(self, inputs, numbers, slopes=False):
        """:returns: outputs, and with `slopes` their derivatives by every number"""
        kept, value = [], inputs
        layers = self.layers(numbers)
        for i, (matrix, offsets) in enumerate(layers):
            z = value @ matrix + offsets
            kept.append((value, (1.0 + z * z) ** -1.5))
            value = z if i == len(layers) - 1 else z / np.sqrt(1.0 + z * z)
        if not slopes:
            return value
        count, width = value.shape
        back = np.broadcast_to(np.eye(width), (count, width, width))
        parts = []
        for i in range(len(layers) - 1, -1, -1):
            before = kept[i][0]
            products = (back[:, :, None, :] * before[:, None, :, None]).reshape(count, width, -1)
            parts.append(np.concatenate([products, back], 2))
            if i:
                back = (back @ layers[i][0].T) * kept[i - 1][1][:, None, :]
        return value, np.concatenate(parts[::-1], 2)


class Fit:
    def __init__(self, curves, places):
        self.curves, self.places = curves, places

    def albedo(self, outputs, slopes=False):
        """Of every curve, and with `slopes` its derivatives by the outputs."""
        mu, alpha = self.places.mu[:, None], self.places.alpha[:, None]
        lean, side, weight = (outputs[:, i * MICROFACETS:(i + 1) * MICROFACETS] for i in range(3))
        sine = np.sqrt(1.0 - mu * mu)
        shrink = 1.0 / np.sqrt(1.0 + alpha * alpha * (lean * lean + side * side))
        c = (mu + alpha * sine * lean) * shrink
        byLean = alpha * sine * shrink - c * (shrink * alpha) ** 2 * lean
        bySide = -c * (shrink * alpha) ** 2 * side
        total = 0.0
        columns = np.empty((len(c), len(self.curves.names), 3 * MICROFACETS)) if slopes else None
        for j in range(MICROFACETS):
            value, slope = self.curves.at(c[:, j])
            w = weight[:, j, None]
            total = total + w * value
            if slopes:
                columns[:, :, j] = w * slope * byLean[:, j, None]
                columns[:, :, MICROFACETS + j] = w * slope * bySide[:, j, None]
                columns[:, :, 2 * MICROFACETS + j] = value
        return (total, columns) if slopes else total

    def errors(self, network, numbers):
        return self.albedo(network.run(self.places.inputs, numbers)) - self.places.albedo

    def improve(self, network, steps):
        """Levenberg and Marquardt's method, in place.

        :returns: the sum of the squared errors
        """
        numbers, damping = network.numbers, 1e-2
        error = self.errors(network, numbers)
        cost = (error ** 2).sum()
        for step in range(steps):
            outputs, byNumber = network.run(self.places.inputs, numbers, True)
            _, byOutput = self.albedo(outputs, True)
            squares = np.einsum("nfa,nfb->nab", byOutput, byOutput)
            trace = np.trace(squares, axis1=1, axis2=2)[:, None, None]
            root = np.linalg.cholesky(squares + np.eye(3 * MICROFACETS) * (1e-12 + 1e-9 * trace))
            rows = np.einsum("nba,nbp->nap", root, byNumber).reshape(-1, len(numbers))
            matrix = rows.T @ rows
            slope = np.einsum("na,nap->p", np.einsum("nfa,nf->na", byOutput, error), byNumber)
            scale = np.diag(matrix) + 1e-9 * np.diag(matrix).max()
            for _ in range(10):
                tried = numbers - np.linalg.solve(matrix + damping * np.diag(scale), slope)
                triedError = self.errors(network, tried)
                if (triedError ** 2).sum() < cost:
                    break
                damping *= 3.0
            else:
                break
            numbers, error, cost = tried, triedError, (triedError ** 2).sum()
            damping = max(damping / 3.0, 1e-12)
            if step % 50 == 0:
                print(f"step {step}: RMSE * 65535 = {rms(error):.2f}", flush=True)
        network.numbers = numbers
        return cost


def rms(error):
    return np.sqrt((error ** 2).mean()) * 65535.0


def main(nodes, centres, out):
    curves = Curves()
    fit = Fit(curves, Places(nodes, curves))
    networks = [Network(seed) for seed in SEEDS]
    network = min(networks, key=lambda n: fit.improve(n, FIRST_STEPS))
    fit.improve(network, STEPS)
    measured = Fit(curves, Places(centres, curves))
    # As it will be read: the numbers rounded to what the file shows.
    rounded = np.array([float(fitText.number(x)) for x in network.numbers])
    error = measured.errors(network, rounded)
    lines = [f"{name}: {rms(error[:, i]):.1f}" for i, name in enumerate(curves.names)]
    print("RMSE * 65535 over the cell centres\n  " + "\n  ".join(lines))
    with open(out, "w", encoding="utf-8") as file:
        file.write(fitText.rule(network.layers(rounded), rms(error).item(), np.abs(error).max().item()))


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
