# SPDX-License-Identifier: Apache-2.0
"""Scatter charts with logarithmic axes as SVG text, by hand: nothing beyond Python is needed."""
import math
from xml.sax.saxutils import escape

from patina.chart import look
from patina.chart.front import pareto

LEFT, TOP, RIGHT, BOTTOM = 62, 40, 16, 46


class Axis:
    """A logarithmic axis over the decades that hold all values."""

    def __init__(self, values, start, end):
        values = [v for v in values if v > 0.0] or [1.0]
        self.low = math.floor(math.log10(min(values)) - 1e-9)
        self.high = max(math.ceil(math.log10(max(values)) + 1e-9), self.low + 1)
        self.start, self.end = start, end

    def at(self, value):
        """Place of a value; what is not above 0 stands at the lower end."""
        t = (math.log10(value) - self.low) / (self.high - self.low) if value > 0.0 else 0.0
        return self.start + min(max(t, 0.0), 1.0) * (self.end - self.start)

    def decades(self):
        return [10.0 ** d for d in range(self.low, self.high + 1)]


def _text(x, y, words, anchor="middle", more=""):
    more += "" if " fill=" in more else f' fill="{look.INK}"'
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(words)}</text>'


def _free(cx, cy, room, width, taken):
    """Where a label of a point does not cover others. :param taken: their boxes; takes this one, too"""
    places = [(cx + 7, cy - 6), (cx - 7 - room, cy - 6), (cx + 7, cy + 13), (cx - 7 - room, cy + 13), (cx + 7, cy - 18),
              (cx - 7 - room, cy - 18)]
    inside = [(a, b) for a, b in places if a >= LEFT and a + room <= width] or places

    def covers(place):
        return any(abs(place[1] - b) < 11 and place[0] < a + r and a < place[0] + room for a, b, r in taken)

    chosen = next((p for p in inside if not covers(p)), inside[0])
    taken.append((*chosen, room))
    return chosen


def _decade(value):
    return f"{value:g}" if 1e-2 <= value <= 1e4 else f"1e{round(math.log10(value))}"


def scatter(title, points, x_label, y_label, width=520, height=340):
    """:param points: list of (x, y, label); the line of Pareto joins those that none beats
    :returns: an `svg` element
    """
    x = Axis([p[0] for p in points], LEFT, width - RIGHT)
    y = Axis([p[1] for p in points], height - BOTTOM, TOP)
    out = [look.start(title, width, height),
           _text(width / 2, 18, title, more=' font-size="13" font-weight="bold"')]
    for value in x.decades():
        at = x.at(value)
        out.append(f'<path d="M{at:.1f} {TOP}V{height - BOTTOM}" stroke="{look.GRID}"/>')
        out.append(_text(at, height - BOTTOM + 15, _decade(value)))
    for value in y.decades():
        at = y.at(value)
        out.append(f'<path d="M{LEFT} {at:.1f}H{width - RIGHT}" stroke="{look.GRID}"/>')
        out.append(_text(LEFT - 6, at + 4, _decade(value), "end"))
    out.append(_text((LEFT + width - RIGHT) / 2, height - 10, x_label))
    middle = (TOP + height - BOTTOM) / 2
    out.append(_text(14, middle, y_label, more=f' transform="rotate(-90 14 {middle:.1f})"'))
    line = " ".join(f"{x.at(p[0]):.1f},{y.at(p[1]):.1f}" for p in pareto(points))
    out.append(f'<polyline points="{line}" fill="none" stroke="{look.DIM}" stroke-dasharray="4 3"/>')
    taken = [(x.at(p[0]) - 5, y.at(p[1]) + 4, 10) for p in points]
    for i, (px, py, label) in enumerate(points):
        cx, cy = x.at(px), y.at(py)
        out.append(f'<circle cx="{cx:.1f}" cy="{cy:.1f}" r="4.5" fill="{look.COLOURS[i % len(look.COLOURS)]}"/>')
        label += "" if py > 0.0 else " (0)"  # not on the axis: it stands at the lower end
        out.append(_text(*_free(cx, cy, 6.2 * len(label), width, taken), anchor="start", words=label,
                         more=f' fill="{look.COLOURS[i % len(look.COLOURS)]}"'))
    return "\n".join([*out, "</svg>"]) + "\n"
