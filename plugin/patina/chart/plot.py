# SPDX-License-Identifier: Apache-2.0
"""A chart of lines and points on logarithmic axes as SVG text."""
from patina.chart import labels, look
from patina.chart.axes import HALO, Axis, grid, text, upright

WIDTH, HEIGHT = 640, 420
LEFT, TOP, RIGHT, BOTTOM = 64, 46, 20, 64
GREY = look.DIM


def mark(kind, x, y, colour, filled=True):
    paint = f'fill="{colour if filled else look.PAPER}" stroke="{colour}" stroke-width="1.6"'
    if kind == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" {paint}/>'
    r = 4.0 if kind == "square" else 5.2
    ways = {"square": f"M{x - r:.1f} {y - r:.1f}h{2 * r}v{2 * r}h{-2 * r}z",
            "diamond": f"M{x:.1f} {y - r:.1f}l{r} {r}l{-r} {r}l{-r} {-r}z"}
    return f'<path d="{ways[kind]}" {paint}/>'


class Plot:
    """Collects marks first, since the axes must hold all of them.

    :param foot: a line below the chart
    """

    def __init__(self, title, x_label, y_label, foot=""):
        self.title, self.x_label, self.y_label, self.foot = title, x_label, y_label, foot
        self.series, self.floors, self.crossings, self.front, self.guides = [], [], [], [], []
        self.x_ticks = None  # None: those of the axis

    def add(self, name, points, colour, kind="circle", filled=True, line=True, below=False):
        """:param points: list of (x, y, label)"""
        points = [p for p in points if p[0] and p[1] and p[0] > 0.0 and p[1] > 0.0]
        if points:
            self.series.append((name, points, colour, kind, filled, line, below))

    def add_floor(self, name, value, colour):
        self.floors.append((name, value, colour))

    def add_crossing(self, name, x, sure=True):
        self.crossings.append((name, x, sure))

    def set_front(self, points):
        self.front = [p for p in points if p[0] > 0.0 and p[1] > 0.0]

    def add_guide(self, slope, name):
        """A line of this slope through the first point of the first series."""
        self.guides.append((slope, name))

    def svg(self):
        xs = [p[0] for s in self.series for p in s[1]] + [c[1] for c in self.crossings]
        ys = [p[1] for s in self.series for p in s[1]] + [f[1] for f in self.floors]
        self.x = Axis(xs, LEFT, WIDTH - RIGHT)
        self.y = Axis(ys, HEIGHT - BOTTOM, TOP, above=0.08 if self.crossings else 0.0)
        self.places = labels.Places((LEFT + 2, TOP + 2, WIDTH - RIGHT - 2, HEIGHT - BOTTOM - 2))
        out = [look.start(self.title, WIDTH, HEIGHT),
               text(WIDTH / 2, 20, self.title, font_size=14, font_weight="bold")]
        out += self._grid()
        if len(self.front) > 1:
            way = " ".join(f"{self.x.at(p[0]):.1f},{self.y.at(p[1]):.1f}" for p in self.front)
            out.append(f'<polyline points="{way}" fill="none" stroke="{look.FRONT}" stroke-width="9" '
                       'stroke-linejoin="round" stroke-linecap="round"/>')
        out += [line for guide in self.guides for line in self._guide(*guide)]
        out += [line for name, value, colour in self.floors for line in self._floor(name, value, colour)]
        out += [line for crossing in self.crossings for line in self._crossing(*crossing)]
        out += [line for series in self.series for line in self._series(*series)]
        out += self._names()
        out += [text(WIDTH / 2, HEIGHT - 8, self.foot, fill=look.DIM, font_size=9)] if self.foot else []
        return "\n".join([*out, "</svg>"]) + "\n"

    def _grid(self):
        bottom, right = HEIGHT - BOTTOM, WIDTH - RIGHT
        out = [f'<rect x="{LEFT}" y="{TOP}" width="{right - LEFT}" height="{bottom - TOP}" fill="none" stroke="{look.FRAME}"/>']
        return out + grid(self.x, self.y, self.x_ticks) + [
            text((LEFT + right) / 2, bottom + 31, self.x_label), upright(16, (TOP + bottom) / 2, self.y_label)]

    def _series(self, name, points, colour, kind, filled, line, below):
        out = []
        places = [(self.x.at(x), self.y.at(y), label) for x, y, label in points]
        if line and len(places) > 1:
            way = " ".join(f"{x:.1f},{y:.1f}" for x, y, _ in places)
            dash = "" if filled else ' stroke-dasharray="5 3"'
            out.append(f'<polyline points="{way}" fill="none" stroke="{colour}" stroke-width="1.6"{dash}/>')
        for x, y, label in places:
            out.append(mark(kind, x, y, colour, filled))
            right = x < WIDTH - RIGHT - 40
            if label:
                out.append(text(x + (7 if right else -7), y + (13 if below else -6), label, "start" if right else "end",
                                fill=colour, font_size=10, **HALO))
        return out

    def _floor(self, name, value, colour):
        at = self.y.at(value)
        self.places.take((LEFT, at - 14, LEFT + 8 + 5.6 * len(name), at + 1))
        return [f'<path d="M{LEFT} {at:.1f}H{WIDTH - RIGHT}" stroke="{colour}" stroke-dasharray="2 3"/>',
                text(LEFT + 4, at - 4, name, "start", fill=colour, font_size=10, **HALO)]

    def _crossing(self, name, value, sure):
        at = self.x.at(value)
        dash = "" if sure else ' stroke-dasharray="4 4"'
        left = at > WIDTH / 2
        room = 10 + 6.6 * len(name)
        self.places.take((at - (room if left else 0), TOP, at + (0 if left else room), TOP + 18))
        return [f'<path d="M{at:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="{look.INK}" stroke-width="1.2"{dash}/>',
                text(at + (-5 if left else 5), TOP + 14, name, "end" if left else "start", font_weight="bold", **HALO)]

    def _guide(self, slope, name):
        (x0, y0, _) = self.series[0][1][0]
        x1 = max(p[0] for s in self.series for p in s[1])
        y1 = y0 * (x1 / x0) ** slope
        low = 10.0**self.y.low
        if y1 < low:
            x1, y1 = x0 * (low / y0) ** (1.0 / slope), low
        a, b, c, d = self.x.at(x0), self.y.at(y0), self.x.at(x1), self.y.at(y1)
        self.places.take((c - 6 - 5.6 * len(name), d - 19, c - 6, d - 5))
        return [f'<path d="M{a:.1f} {b:.1f}L{c:.1f} {d:.1f}" stroke="{GREY}" stroke-dasharray="1 3" stroke-width="1.5"/>',
                text(c - 6, d - 8, name, "end", fill=GREY, font_size=10, **HALO)]

    def _names(self):
        """The names of series and of the front, each beside what it names."""
        out = []
        for _, points, *_ in self.series:
            places = [(self.x.at(x), self.y.at(y)) for x, y, _ in points]
            self.places.cover(labels.along(places))
            for (x, y), (_, _, words) in zip(places, points):
                self.places.take((x - 5, y - 5, x + 5, y + 5))
                if words:
                    self.places.take((x - 5, y - 16, x + 9 + 6 * len(words), y))
        for name, points, colour, *_ in self.series:
            anchors = [(self.x.at(x), self.y.at(y)) for x, y, _ in points]
            out.append(self._name(name, anchors[::-1], colour))
        if len(self.front) > 1:
            out.append(self._name("Pareto front", [(self.x.at(x), self.y.at(y)) for x, y in self.front], look.DIM))
        return out

    def _name(self, name, anchors, colour):
        x, y, anchor, _ = self.places.place(anchors, look.CHAR * len(name))
        return text(x, y, name, anchor, fill=colour, font_weight="bold", **HALO)
