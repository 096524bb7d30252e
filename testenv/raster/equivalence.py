# SPDX-License-Identifier: Apache-2.0
"""Do both back ends draw the same picture? A two-sample test per tile, with a margin that is the same for every stage.

`patina.regression.welch` has the statistics. The pixels of a pass of the rasterizer share their light samples and its passes
are one sequence, so neither are independent: the observations are whole renders with seeds of their own (batch means), of the
rasterizer as of the path tracer. The significance is SIGNIFICANCE for the stage, by Šidák over tiles, channels and looks.

    differs     the interval lies outside of MARGIN times the value: the back ends differ by more than the margin
    undecided   the interval is wider than the power that is asked for: more seeds are taken, up to a cap. A highlight or
                an outline may need thousands: a Power may leave a share of the tiles so, for another to decide
    same        neither: what differs by more than margin and power together would have been found

A tile's value is the path tracer's mean, and FLOOR of the image's.
"""
import dataclasses

import numpy as np

from patina.regression import welch
from patina.regression.welch import FLOOR, SIGNIFICANCE, TILE, tiles  # noqa: F401 tests read the first

MARGIN = 0.01


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


FULL = Power(widest=5 * MARGIN, samples=16, traced=64, looks=(6, 12, 24), spare=0.25)
LONG = Power(widest=MARGIN, samples=128, traced=512, looks=(12, 24, 48, 96))


@dataclasses.dataclass
class Verdict(welch.Interval):
    """The difference is the rasterizer's mean less the path tracer's."""
    power: Power

    @property
    def differs(self):
        return self.outside(MARGIN)

    @property
    def undecided(self):
        return ~self.differs & (self.half > self.power.widest)

    @property
    def open(self):
        """:returns: whether too much is undecided"""
        return self.undecided.mean() > self.power.spare

    def text(self):
        """:returns: the tiles that differ or are undecided, the worst first, in words"""
        both = ((self.differs, "differs by"), (self.undecided, "is undecided:"))
        return "; ".join(f"{which.sum()} of {which.size}: {self.worst(which, verb)}" for which, verb in both if which.any())


def compare(raster, traced, power, significance=SIGNIFICANCE):
    """:param raster: tile means of renders with independent seeds, (n, rows, columns, 3)
    :param traced: likewise, (m, rows, columns, 3)
    :returns: a Verdict"""
    found = welch.compare(raster, traced, significance, len(power.looks))
    return Verdict(found.difference, found.half, power)


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
