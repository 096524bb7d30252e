# SPDX-License-Identifier: Apache-2.0
"""Numbers of a chart of scenes: errors, slopes, floors, the Pareto front, and where one back end overtakes another.

Plain functions of numbers and arrays; nothing here renders.
"""
import math

import numpy as np

from patina.chart.front import pareto
from patina.cli import imageMetrics
from patina.experiment import LUMINANCE

TILES = 6  # a picture is cut into so many tiles along its longer side for slopes by tile


def errors(image, reference, with_flip=True):
    """How far an image (height, width, 3) is from a reference.

    :param with_flip: FLIP takes longer than all others together
    :returns: dict of relMSE, rmse, flip (None without flip-evaluator), meanError (signed, over the reference's mean), and
        relative: the mean over pixels of |error| / (luminance + 0.01), which is what --tolerance is about; those that need
        a pixel that is a number in both are None without any
    """
    found = imageMetrics.differences(image, reference)
    mask = imageMetrics.finite_pixels(image, reference)
    a, b = (np.where(mask[..., None], x, 0.0).astype(np.float64) @ LUMINANCE for x in (image, reference))
    # Luminance below 0, which a file may have, would make the sum 0.
    relative = float((np.abs(a - b)[mask] / (np.maximum(b[mask], 0.0) + 0.01)).mean()) if mask.any() else None
    return {"relMSE": found["relMSE"], "rmse": found["rmse"],
            "flip": imageMetrics.mean_flip(image, reference, True) if with_flip else None,
            "meanError": found["relativeMeanError"], "relative": relative,
            "notFinite": int((~mask).sum())}


def rmse(image, reference):
    """Over the pixels that are numbers in both; None without any."""
    return imageMetrics.differences(image, reference)["rmse"]


def averaged(found):
    """One dict of several of errors(): means, but RMSE by its square."""
    result = {}
    for name in found[0]:
        values = [e[name] for e in found if e[name] is not None]
        if not values:
            result[name] = None
        elif name == "rmse":
            result[name] = math.sqrt(sum(v * v for v in values) / len(values))
        else:
            result[name] = max(values) if name == "notFinite" else sum(values) / len(values)
    return result


def slope(counts, values):
    """Slope of log value over log count by least squares; None with fewer than two usable points."""
    usable = [(math.log(n), math.log(v)) for n, v in zip(counts, values) if n > 0 and v is not None and v > 0.0]
    if len({x for x, _ in usable}) < 2:
        return None
    return float(np.polyfit(*zip(*usable), 1)[0])


def tile_errors(image, reference, tiles=TILES):
    """RMSE by tile.

    :returns: dict of (x0, y0, x1, y1), in pixels and without its ends, -> RMSE
    """
    height, width = image.shape[:2]
    size = max(1, math.ceil(max(height, width) / tiles))
    squares = np.nan_to_num((image.astype(np.float64) - reference) ** 2, posinf=0.0)
    return {(x, y, min(x + size, width), min(y + size, height)):
            math.sqrt(squares[y:y + size, x:x + size].mean())
            for y in range(0, height, size) for x in range(0, width, size)}


def tile_slopes(counts, by_count):
    """Slopes of every tile.

    :param by_count: tile_errors() of each count
    :returns: dict of median, lower and upper quartile, shallowest and its tile, and how many there are; None where no tile
        has a slope. Tiles without error (the background) have none.
    """
    found = {tile: slope(counts, [e[tile] for e in by_count]) for tile in by_count[0]}
    found = {tile: s for tile, s in found.items() if s is not None and min(e[tile] for e in by_count) > 1e-7}
    if not found:
        return None
    quartiles = np.percentile(list(found.values()), [25, 50, 75])
    worst = max(found, key=found.get)
    return {"median": float(quartiles[1]), "low": float(quartiles[0]), "high": float(quartiles[2]),
            "shallowest": found[worst], "tile": list(worst), "tiles": len(found)}


def floor(counts, values, power):
    """The error that stays with any number of samples: f of value = f + v / count^power, of the last two counts, since noise
    of stratified samples falls faster than the formula says.

    :param power: 1 for mean squared errors, 0.5 for errors that add like noise itself
    :returns: f, or None where noise still rules: fewer than three counts, f below half of the last value, or below a quarter
        of it in a fit of all counts, which single bright paths do not sway
    """
    usable = sorted((n, v) for n, v in zip(counts, values) if v is not None and v > 0.0)
    if len(usable) < 3:
        return None
    rows = np.array([[1.0 / v, n ** -power / v] for n, v in usable])  # relative errors
    fitted, noise = np.linalg.lstsq(rows, np.ones(len(rows)), rcond=None)[0]
    (n0, before), (n1, last) = usable[-2:]
    ratio = (n1 / n0) ** power
    found = min((ratio * last - before) / (ratio - 1.0), last)
    if found < 0.5 * last or (noise > 0.0 and fitted < 0.25 * last):
        return None
    return float(found)


def _reached(front, seconds):
    """Least error of a front after so many seconds: straight between its points on log axes, inf before the first."""
    if seconds < front[0][0]:
        return math.inf
    for (t0, e0, *_), (t1, e1, *_) in zip(front, front[1:]):
        if t0 <= seconds < t1:
            if min(e0, e1, t0) <= 0.0:
                return e0
            part = math.log(seconds / t0) / math.log(t1 / t0)
            return math.exp(math.log(e0) + part * math.log(e1 / e0))
    return front[-1][1]


def crossover(traced, drawn, steps=2000):
    """When which of two back ends has the smaller error.

    :param traced: (seconds, error) of the path tracer; errors above 0
    :param drawn: those of the rasterizer
    :returns: dict of `better`: the spans of seconds [from, to] in which the rasterizer is better; `until`: how long the path
        tracer was measured; `open`: whether the rasterizer is still better then; `at`: the end of its last span, None where
        it has none; `below`: when the path tracer's error falls below the least one of the rasterizer, None if it does not
    """
    a, b = pareto(traced), pareto(drawn)
    until = a[-1][0]
    begin = min(a[0][0], b[0][0])
    below = _level(a, b[-1][1])
    if b[0][0] > until:
        return {"better": [], "until": until, "open": False, "at": None, "below": below}
    times = sorted({begin, until, *[p[0] for p in a + b if begin <= p[0] <= until],
                    *[begin * (until / begin) ** (i / steps) for i in range(1, steps)]})
    spans, inside = [], False
    for i, t in enumerate(times):
        now = _reached(b, t) < _reached(a, t)
        if now and not inside:
            spans.append([t, t])
        if now:
            spans[-1][1] = t
        elif inside:
            spans[-1][1] = math.sqrt(times[i - 1] * t)
        inside = now
    return {"better": spans, "until": until, "open": inside, "at": spans[-1][1] if spans else None,
            "below": below}


def _level(front, error):
    """When a front has no more than an error: straight between its points on log axes, None if never."""
    if front[0][1] <= error:
        return front[0][0]
    for (t0, e0), (t1, e1) in zip(front, front[1:]):
        if e1 <= error:
            if min(e1, error, t0) <= 0.0:
                return t1
            return t0 * (t1 / t0) ** (math.log(error / e0) / math.log(e1 / e0))
    return None


def expected_level(traced, drawn, order):
    """When the path tracer's error falls to the rasterizer's least one, if it falls as samples to the power of -order."""
    last, minimum = pareto(traced)[-1], pareto(drawn)[-1][1]
    return last[0] * max(1.0, last[1] / minimum) ** (1.0 / order) if minimum > 0.0 else None


def seconds_text(seconds):
    if seconds < 0.1:
        return f"{1000 * seconds:.2g} ms"
    return f"{seconds:.2g} s" if seconds < 100 else f"{seconds:.0f} s"


def crossover_text(found, expected=None):
    """One sentence of crossover()."""
    spans, below = found["better"], found["below"]
    if not spans:
        text = f"the path tracer is better at every time up to {seconds_text(found['until'])}"
        return text + (f"; from {seconds_text(below)} on its error is below any of the rasterizer" if below else "")
    parts = []
    for i, (begin, end) in enumerate(spans):
        if found["open"] and i == len(spans) - 1:
            parts.append(f"from {seconds_text(begin)} on")
        else:
            parts.append(f"from {seconds_text(begin)} to {seconds_text(end)}")
    text = "the rasterizer is better " + " and ".join(parts)
    if found["open"]:
        text += f", the path tracer was measured up to {seconds_text(found['until'])}"
        if expected and expected > found["until"]:
            text += f" and should be level at about {seconds_text(expected)}"
    return text
