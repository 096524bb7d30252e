# SPDX-License-Identifier: Apache-2.0
"""What all charts are made of: axes, their grid, and words, as SVG text."""
import math
from xml.sax.saxutils import escape

from patina.chart import look

HALO = {"paint_order": "stroke", "stroke": look.PAPER, "stroke_width": 3, "stroke_linejoin": "round"}  # text over lines


class Scale:
    """Values to places, linear or logarithmic; what is not positive stands at the low end of a logarithmic one."""

    def __init__(self, values, start, end, log):
        values = [v for v in values if v is not None and math.isfinite(v) and (v > 0.0 or not log)] or [1.0]
        low, high = min(values), max(values)
        if log:
            low, high = math.log10(low), math.log10(high)
        if high - low < 1e-9:
            low, high = low - 0.5, high + 0.5
        self.low, self.high, self.log, self.start, self.end = low, high, log, start, end

    def at(self, value):
        """Place of a value; what lies outside stands at the nearer end."""
        if self.log:
            value = math.log10(value) if value > 0.0 else self.low
        t = (value - self.low) / (self.high - self.low)
        return self.start + min(max(t, 0.0), 1.0) * (self.end - self.start)

    def ticks(self):
        """:returns: list of (value, text)"""
        if self.log:
            step = max(1, math.ceil((self.high - self.low) / 8))
            powers = range(math.ceil(self.low - 1e-9), math.floor(self.high + 1e-9) + 1, step)
            return [(10.0 ** p, f"1e{p}" if abs(p) > 2 else f"{10.0 ** p:g}") for p in powers]
        span = self.high - self.low
        step = 10.0 ** math.floor(math.log10(span / 4))
        step *= next(m for m in (1, 2, 5, 10) if span / (step * m) <= 6)
        first = math.ceil(self.low / step - 1e-9)
        return [(i * step, f"{i * step:g}") for i in range(first, math.floor(self.high / step + 1e-9) + 1)]


class Axis(Scale):
    """A logarithmic axis that holds all values with a margin, ticks at 1, 2, 5 or at decades.

    :param above: more room at the upper end
    """

    def __init__(self, values, start, end, margin=0.06, above=0.0):
        super().__init__(values, start, end, True)
        low, high = self.low, self.high
        if high - low < 0.6:
            low, high = (low + high) / 2 - 0.3, (low + high) / 2 + 0.3
        pad = margin * (high - low)
        self.low, self.high = low - pad, high + pad + above * (high - low)

    def ticks(self):
        steps = (1,) if self.high - self.low > 2.2 else (1, 2, 5)
        found = [m * 10.0**d for d in range(math.floor(self.low), math.ceil(self.high) + 1) for m in steps]
        return [(v, number(v)) for v in found if self.low <= math.log10(v) <= self.high]


def number(value):
    return f"{value:g}" if 1e-3 <= value < 1e5 else f"{value:.0e}".replace("e-0", "e-").replace("e+0", "e")


def text(x, y, words, anchor="middle", **attributes):
    attributes = {"fill": look.INK, **attributes}
    more = "".join(f' {name.replace("_", "-")}="{value}"' for name, value in attributes.items())
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(words)}</text>'


def upright(x, y, words, **attributes):
    return text(x, y, words, transform=f"rotate(-90 {x} {y:.1f})", **attributes)


def grid(x, y, x_ticks=None):
    """:param x_ticks: values, in place of the axis's own
    :returns: lines and numbers of two axes"""
    left, right, bottom, top = x.start, x.end, y.start, y.end
    out = []
    for value, words in [(v, number(v)) for v in x_ticks] if x_ticks else x.ticks():
        at = x.at(value)
        out += [f'<path d="M{at:.1f} {top}V{bottom}" stroke="{look.GRID}"/>', text(at, bottom + 15, words)]
    for value, words in y.ticks():
        at = y.at(value)
        out += [f'<path d="M{left} {at:.1f}H{right}" stroke="{look.GRID}"/>', text(left - 6, at + 4, words, "end")]
    return out
