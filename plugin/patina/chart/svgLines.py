# SPDX-License-Identifier: Apache-2.0
"""Line charts as SVG text: methods over a parameter, the truth, and where one method takes over from another."""
import math

from patina.chart import labels, look
from patina.chart.axes import HALO, Scale, grid, text, upright

LEFT, TOP, RIGHT, BOTTOM = 58, 24, 14, 34


def _path(xs, ys, x, y):
    """A line with gaps where values are no numbers."""
    parts, pen = [], False
    for a, b in zip(xs, ys):
        if not math.isfinite(b):
            pen = False
            continue
        parts.append(f"{'L' if pen else 'M'}{x.at(a):.1f} {y.at(b):.1f}")
        pen = True
    return "".join(parts)


def lines(sweep, width=460, height=290):
    """:param sweep: patina.chart.sweeps.Sweep
    :returns: an `svg` element
    """
    every = [v for values in (*sweep.curves.values(), sweep.truth) for v in map(float, values)]
    truths = [float(v) for v in sweep.truth]
    if not sweep.log_y:
        if any(truths):  # a value that runs away must not flatten the rest
            top = 2.5 * max(map(abs, truths)) + 10 * sweep.bound
            every = [min(v, top) for v in every if math.isfinite(v)]
        low = min(truths) - 2 * sweep.bound
        every += [max(truths) + 2 * sweep.bound, low if min(truths) < 0.0 else max(low, 0.0)]
    x = Scale(sweep.x, LEFT, width - RIGHT, sweep.log_x)
    y = Scale(every, height - BOTTOM, TOP, sweep.log_y)
    out = [look.start(sweep.name, width, height, 10.5),
           text(width / 2, 14, sweep.name, font_size=12, font_weight="bold"), *grid(x, y),
           text((LEFT + width - RIGHT) / 2, height - BOTTOM + 26, sweep.x_label)]
    long = min(1.0, height / (6.2 * len(sweep.y_label)))
    out.append(upright(12, (TOP + height - BOTTOM) / 2, sweep.y_label, font_size=f"{10.5 * long:.1f}"))
    if sweep.switch is not None:
        at = x.at(sweep.switch)
        out.append(f'<path d="M{at:.1f} {TOP}V{height - BOTTOM}" stroke="{look.INK}" stroke-dasharray="2 3"/>')
        near = at < width - 90
        out.append(text(at + (3 if near else -3), TOP + 9, "switch", "start" if near else "end"))
    out.append(f'<path d="{_path(sweep.x, truths, x, y)}" fill="none" stroke="{look.TRUTH}" stroke-width="5"/>')
    for i, (name, values) in enumerate(sweep.curves.items()):
        colour = look.COLOURS[i % len(look.COLOURS)]
        out.append(f'<path d="{_path(sweep.x, list(map(float, values)), x, y)}" fill="none" stroke="{colour}" '
                   'stroke-width="1.4"/>')
        for a, b, chosen in zip(sweep.x, map(float, values), sweep.chosen):
            if chosen == name and math.isfinite(b):
                out.append(f'<circle cx="{x.at(a):.1f}" cy="{y.at(b):.1f}" r="2.1" fill="{colour}"/>')
            elif not math.isfinite(b):  # no number: a cross at the upper edge
                out.append(f'<path d="M{x.at(a) - 3:.1f} {TOP + 2 + 7 * i}l6 6m0 -6l-6 6" stroke="{colour}" fill="none"/>')
    return "\n".join([*out, *_names(sweep, truths, x, y, (LEFT + 2, TOP + 2, width - RIGHT + 8, height - BOTTOM - 2)),
                      "</svg>"]) + "\n"


def _names(sweep, truths, x, y, frame):
    """Names beside their curves, those of curves that go apart from the others at the widest gap."""
    places = labels.Places(frame)
    curves = {"truth": (truths, look.DIM)}
    curves.update({name: (list(map(float, values)), look.COLOURS[i % len(look.COLOURS)])
                   for i, (name, values) in enumerate(sweep.curves.items())})
    drawn = {name: [(x.at(a), y.at(b)) for a, b in zip(sweep.x, values) if math.isfinite(b)]
             for name, (values, _) in curves.items()}
    for points in drawn.values():
        places.cover(labels.along(points))
    if sweep.switch is not None:
        at = x.at(sweep.switch)
        places.take((at - 40, frame[1] - 4, at + 40, frame[1] + 12))
    out = []
    for name, points in sorted(drawn.items(), key=lambda item: item[0] == "truth"):
        if not points:  # crosses alone
            points = [(x.at(sweep.x[len(sweep.x) // 2]), frame[1] + 14)]
        others = {i: [p[i][1] for other, p in drawn.items() if other != name and len(p) == len(points)]
                  for i in range(len(points))}
        gap = {i: min([abs(points[i][1] - b) for b in others[i]] or [0.0]) for i in others}
        anchors = [points[i] for i in sorted(gap, key=lambda i: -min(gap[i], 40.0))]
        px, py, anchor, _ = places.place(anchors, 5.8 * len(name))
        out.append(text(px, py, name, anchor, fill=curves[name][1], font_weight="bold", **HALO))
    return out
