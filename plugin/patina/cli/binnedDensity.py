# SPDX-License-Identifier: Apache-2.0
"""Integrals of a material's density over bins of the sphere, in cells that are divided where they are not precise."""
import math

import numpy as np

ROWS, COLUMNS = 16, 32  # bins of the sphere in height and longitude
COARSE, FINE = 8, 12  # Gauss-Legendre points along each side of a cell; their difference is taken for the error
THIRD, HEAVY = 10, 0.01  # two rules may agree by chance: cells of so much are integrated by a third
PRECISE = 0.001  # error of all bins together, a tenth of what `patina check` allows by default
LEVELS = 9  # times that a cell is halved, in both directions
MOST_CELLS = 1024  # divided at once; lobes that need more are narrower than cells get


def coordinates(directions):
    """:returns: height and longitude of directions, in bins; heights as _stretched() makes them, inverted"""
    height = np.clip((directions[:, 2].astype(np.float64) + 1.0) * (0.5 * ROWS), 0.0, ROWS)
    row = np.minimum(np.floor(height), ROWS - 1)
    t = height - row
    t = np.where(row % (ROWS // 2) == 0, np.sqrt(t), np.where((row + 1) % (ROWS // 2) == 0, 1.0 - np.sqrt(1.0 - t), t))
    turns = np.arctan2(directions[:, 1], directions[:, 0]).astype(np.float64) / (2.0 * math.pi)
    column = (turns - np.floor(turns)) * COLUMNS
    return np.minimum(row + t, np.nextafter(row + 1.0, 0.0)), np.minimum(column, np.nextafter(COLUMNS, 0.0))


def _stretched(row, t):
    """Heights lie denser at the horizon, where grazing densities have their peak, and at the poles, where distance from the
    axis goes with the root of what is left of the height.

    :returns: height in a bin, of 1, and its derivative"""
    first, last = row % (ROWS // 2) == 0, (row + 1) % (ROWS // 2) == 0
    return (np.where(first, t * t, np.where(last, 1.0 - (1.0 - t) ** 2, t)),
            np.where(first, 2.0 * t, np.where(last, 2.0 * (1.0 - t), 1.0)))


def counts(y, x):
    """:returns: how many directions, as coordinates, lie in each bin"""
    return np.bincount(y.astype(int) * COLUMNS + x.astype(int), minlength=ROWS * COLUMNS)


def integrate(probe, wo, y, x, n):
    """Integrals of the density over the bins. A cell is divided where its error counts, and where samples say that points
    missed something.

    :param y, x: coordinates of samples, of n that were drawn
    :returns: array of bins, and whether they are precise to PRECISE in sum
    """
    row, column = (a.ravel() for a in np.indices((ROWS, COLUMNS)))
    bins, done, side = np.zeros(ROWS * COLUMNS), 0.0, 1
    for level in range(LEVELS + 1):
        coarse, fine = (_quadrature(probe, wo, row, column, side, points) for points in (COARSE, FINE))
        np.add.at(bins, row // side * COLUMNS + column // side, fine)
        # Cells of fewer than 8 samples are pooled. A tenth of a standard error adds a hundredth to chi-squared.
        noise = np.sqrt(np.maximum(fine, 8.0 / n) / n)
        error, heavy = np.abs(fine - coarse), fine > HEAVY
        error[heavy] = np.maximum(error[heavy],
                                  np.abs(fine[heavy] - _quadrature(probe, wo, row[heavy], column[heavy], side, THIRD)))
        missed = np.abs(_shares(y, x, row, column, side, n) - fine)
        # Of 512 bins one or two differ by three standard errors by chance: once looked into, it takes five.
        doubt = np.maximum(error, np.where(missed > (5.0 if level else 3.0) * noise, missed, 0.0))
        order = np.argsort(-doubt)
        left = done + error.sum() - np.append(0.0, np.cumsum(error[order]))  # with so many cells divided
        divided = max(np.count_nonzero(left >= 0.5 * PRECISE), np.count_nonzero(doubt > 0.1 * noise))
        if not divided or divided > MOST_CELLS or level == LEVELS:
            return bins, bool(left[0] < PRECISE)
        done, order = left[divided], order[:divided]
        np.subtract.at(bins, row[order] // side * COLUMNS + column[order] // side, fine[order])
        side *= 2
        row, column = ((np.repeat(a[order], 4).reshape(-1, 2, 2) * 2 + half).ravel()
                       for a, half in zip((row, column), np.indices((2, 2))))


def _shares(y, x, row, column, side, n):
    """:returns: the share of samples in each cell"""
    width = COLUMNS * side
    found, counted = np.unique((y * side).astype(np.int64) * width + (x * side).astype(np.int64), return_counts=True)
    cells = row * width + column
    at = np.minimum(np.searchsorted(found, cells), len(found) - 1)
    return np.where(found[at] == cells, counted[at], 0) / n


def _quadrature(probe, wo, row, column, side, points):
    """:param row, column: of cells, `side` of which lie along the side of a bin
    :returns: integrals of the density over the cells"""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    offsets, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    area = 4.0 * math.pi / (ROWS * COLUMNS * side * side)
    sums = np.empty(len(row))
    step = max(1, (1 << 19) // (points * points))
    for first in range(0, len(row), step):
        chosen = slice(first, first + step)
        bins = row[chosen, None, None] // side
        t = (row[chosen, None, None] % side + offsets[None, :, None]) / side
        height, slope = _stretched(bins, t)
        z = -1.0 + 2.0 * (bins + height) / ROWS
        phi = 2.0 * math.pi * (column[chosen, None, None] + offsets[None, None, :]) / (COLUMNS * side)
        z, phi = np.broadcast_arrays(z, phi)
        r = np.sqrt(np.maximum(0.0, 1.0 - z * z))
        wi = np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1).reshape(-1, 3).astype(np.float32)
        _, pdf = probe.eval(np.tile(wo.astype(np.float32), (len(wi), 1)), wi)
        weighted = pdf.astype(np.float64).reshape(-1, points, points) * slope
        sums[chosen] = np.einsum("cij,i,j", weighted, weights, weights) * area
    return sums
