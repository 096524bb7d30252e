# SPDX-License-Identifier: Apache-2.0
"""Are two sets of renders of the same picture? A two-sample test per tile, with a margin.

An image is cut into tiles of about 8 x 8 pixels, each with three channels. The pixels of one render share their random
sequence, so the observations are means of whole renders with seeds of their own (batch means). For each tile and channel
Welch's t (1947) gives an interval around the difference of the means. The significance of all of them together is that of the
caller, by Šidák.
"""
import dataclasses

import numpy as np

from patina.significance import sidak

TILE = 8  # pixels
FLOOR = 0.1  # of the image's mean, added to a tile's value: a relative difference in the dark is not seen
SIGNIFICANCE = 0.01


def tiles(images, side=TILE):
    """:param images: (n, height, width, channels)
    :param side: about that of a tile, in pixels
    :returns: means of tiles, (n, rows, columns, channels)"""
    images = np.asarray(images, np.float64)
    rows, columns = (max(1, round(size / side)) for size in images.shape[1:3])
    split = np.stack([part.mean(axis=1) for part in np.array_split(images, rows, axis=1)], axis=1)
    return np.stack([part.mean(axis=2) for part in np.array_split(split, columns, axis=2)], axis=2)


@dataclasses.dataclass
class Interval:
    """Of the difference of two means, for each tile and channel, as a part of the tile's value (with FLOOR)."""
    difference: np.ndarray  # (rows, columns, channels), first less second
    half: np.ndarray        # half of the interval's width

    def outside(self, margin):
        """:param margin: relative difference that is accepted
        :returns: mask of the tiles and channels whose interval lies outside of the margin"""
        return np.abs(self.difference) > margin + self.half

    def worst(self, which, verb="", most=4):
        """:param which: mask of tiles and channels
        :param verb: what each does, such as "differs by"
        :returns: the largest differences of these, in words"""
        found = sorted(np.argwhere(which), key=lambda at: -abs(self.difference[tuple(at)]))
        return "; ".join(f"tile row {r} column {c} {'RGB'[k]} {verb}{' ' * bool(verb)}{100 * self.difference[r, c, k]:+.1f} "
                         f"% (+-{100 * self.half[r, c, k]:.1f})" for r, c, k in found[:most])


def compare(first, second, significance=SIGNIFICANCE, looks=1):
    """:param first: tile means of two or more renders with independent seeds, (n, rows, columns, channels)
    :param second: likewise, (m, rows, columns, channels); the reference, whose mean is a tile's value
    :param significance: probability that any interval misses the true difference
    :param looks: how often the caller looks at growing sets of the same renders
    :returns: an Interval"""
    from scipy import stats

    n, m = len(first), len(second)
    each = sidak(significance, first[0].size * looks)
    a, b = first.mean(axis=0), second.mean(axis=0)
    va, vb = first.var(axis=0, ddof=1) / n, second.var(axis=0, ddof=1) / m
    total = va + vb
    with np.errstate(invalid="ignore", divide="ignore"):
        freedom = total**2 / (va**2 / (n - 1) + vb**2 / (m - 1))
    freedom = np.where(np.isfinite(freedom), freedom, n + m - 2)  # where nothing varies
    half = stats.t.ppf(1.0 - each / 2.0, freedom) * np.sqrt(total)
    value = np.abs(b) + FLOOR * np.abs(b).mean() + 1e-12
    return Interval((a - b) / value, half / value)
