# SPDX-License-Identifier: Apache-2.0
"""Do both back ends draw the same picture? A two-sample test per tile, with a margin that is the same for every stage.

An image is cut into tiles of about 8 x 8 pixels, each with three channels. The pixels of a pass of the rasterizer share their
light samples and its passes are one sequence, so neither are independent: the observations are whole renders with seeds of
their own (batch means), of the rasterizer as of the path tracer. For each tile and channel Welch's t gives an interval around
the difference of the means. Its significance is SIGNIFICANCE for the stage, by Šidák over tiles, channels and looks.

    differs     the interval lies outside of MARGIN times the value: the back ends differ by more than the margin
    undecided   the interval is wider than the power that is asked for: more seeds are taken, up to a cap. A highlight or
                an outline may need thousands: a Power may leave a share of the tiles so, for another to decide
    same        neither: what differs by more than margin and power together would have been found

A tile's value is the path tracer's mean, and FLOOR of the image's: a relative difference in the dark is not seen.
"""
import dataclasses

import numpy as np
from scipy import stats

MARGIN = 0.01
SIGNIFICANCE = 0.01
FLOOR = 0.1
TILE = 8


@dataclasses.dataclass(frozen=True)
class Power:
    """How closely a stage is looked at.

    `widest`: half of the widest interval, as a part of the tile's value; `samples`: passes of the rasterizer per render;
    `traced`: samples of the path tracer per render; `looks`: renders of each back end at which is looked, the last the cap;
    `spare`: share of tiles and channels that may stay undecided there (one that differs never may); `tile`: pixels of a tile's
    side"""
    widest: float
    samples: int
    traced: int
    looks: tuple
    spare: float = 0.0
    tile: int = TILE


FULL = Power(widest=5 * MARGIN, samples=16, traced=64, looks=(12, 24), spare=0.25)
LONG = Power(widest=MARGIN, samples=128, traced=512, looks=(12, 24, 48, 96))


def tiles(images, side=TILE):
    """:param images: (n, height, width, 3)
    :param side: about that of a tile, in pixels
    :returns: means of tiles, (n, rows, columns, 3)"""
    images = np.asarray(images, np.float64)
    rows, columns = (max(1, round(size / side)) for size in images.shape[1:3])
    split = [np.stack([part.mean(axis=1) for part in np.array_split(images, rows, axis=1)], axis=1)]
    return np.stack([part.mean(axis=2) for part in np.array_split(split[0], columns, axis=2)], axis=2)


@dataclasses.dataclass
class Verdict:
    difference: np.ndarray  # (rows, columns, 3), the rasterizer's mean less the path tracer's, as a part of the value
    half: np.ndarray        # of the interval, likewise
    power: Power

    @property
    def differs(self):
        return np.abs(self.difference) > MARGIN + self.half

    @property
    def undecided(self):
        return ~self.differs & (self.half > self.power.widest)

    @property
    def open(self):
        """:returns: whether too much is undecided"""
        return self.undecided.mean() > self.power.spare

    def text(self):
        """:returns: the tiles that differ or are undecided, the worst first, in words"""
        said = []
        for which, word in ((self.differs, "differs by"), (self.undecided, "is undecided:")):
            found = np.argwhere(which)
            worst = sorted(found, key=lambda at: -abs(self.difference[tuple(at)]))
            said += [f"{len(found)} of {which.size}: " + "; ".join(
                f"tile row {r} column {c} {'RGB'[k]} {word} {100 * self.difference[r, c, k]:+.1f} % "
                f"(+-{100 * self.half[r, c, k]:.1f})" for r, c, k in worst[:4])] if len(found) else []
        return "; ".join(said)


def compare(raster, traced, power, significance=SIGNIFICANCE):
    """:param raster: tile means of renders with independent seeds, (n, rows, columns, 3)
    :param traced: likewise, (m, rows, columns, 3)
    :returns: a Verdict"""
    n, m = len(raster), len(traced)
    count = raster[0].size * len(power.looks)
    each = 1.0 - (1.0 - significance) ** (1.0 / count)
    a, b = raster.mean(axis=0), traced.mean(axis=0)
    va, vb = raster.var(axis=0, ddof=1) / n, traced.var(axis=0, ddof=1) / m
    total = va + vb
    with np.errstate(invalid="ignore", divide="ignore"):
        freedom = total**2 / (va**2 / (n - 1) + vb**2 / (m - 1))
    freedom = np.where(np.isfinite(freedom), freedom, n + m - 2)  # where nothing varies
    half = stats.t.ppf(1.0 - each / 2.0, freedom) * np.sqrt(total)
    value = np.abs(b) + FLOOR * np.abs(b).mean() + 1e-12
    return Verdict((a - b) / value, half / value, power)


def decide(render_raster, render_traced, power):
    """Renders until every tile is decided, one differs, or the cap is reached.

    :param render_raster: function of a list of seeds -> images (n, height, width, 3)
    :returns: (the Verdict, images of the rasterizer, images of the path tracer)"""
    first, second, verdict = [], [], None
    for number in power.looks:
        # The back ends share no random numbers.
        first += list(render_raster([1 + i for i in range(len(first), number)]))
        second += list(render_traced([100001 + i for i in range(len(second), number)]))
        verdict = compare(tiles(first, power.tile), tiles(second, power.tile), power)
        if verdict.differs.any() or not verdict.open:
            break
    return verdict, np.array(first), np.array(second)
