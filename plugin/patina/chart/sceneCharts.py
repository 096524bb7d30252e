# SPDX-License-Identifier: Apache-2.0
"""The charts of a stage: error over seconds for each measure, and error over samples."""
import os

from patina.chart import front, look, sceneMeasures
from patina.chart.plot import Plot
from patina.chart.sceneRenders import WORDS
from patina.chart.sceneResults import NAMES
from patina.cli import outputs

COLOURS = look.BACKENDS
KINDS = {"embree": "circle", "denoised": "circle", "raster": "square"}


def plots(result, foot=""):
    """:returns: dict of relMSE, flip, rmse -> Plot; without what was not measured"""
    title = os.path.splitext(os.path.basename(result.stage))[0]
    found = {}
    for measure in ("relMSE", "flip"):
        if any(row[measure] for row in result.rows):
            found[measure] = _over_seconds(result, measure, title, foot)
    slopes = {b: s for b, s in result.slopes.items() if s}
    if slopes:
        found["rmse"] = _over_samples(slopes, title, foot)
    return found


def _over_seconds(result, measure, title, foot):
    plot = Plot(f"{title}: {NAMES[measure]} over time", "seconds of rendering (scene and shaders are built)",
                f"{NAMES[measure]} against the reference", foot)
    for backend, words in WORDS.items():
        rows = [row for row in result.rows if row["backend"] == backend]
        steps = [row for row in rows if not row["tolerance"]]
        colour, kind, below = COLOURS[backend], KINDS[backend], backend == "raster"
        plot.add(words, [(r["seconds"], r[measure], f"{r['samples']:g}") for r in steps], colour, kind, below=below)
        plot.add(f"{words}, direct light", [(r["seconds"], r[measure + "Direct"], "") for r in steps], colour, kind,
                 filled=False, below=below)
        plot.add(f"{words}, to a tolerance", [(r["seconds"], r[measure], f"{r['tolerance']:g}") for r in rows
                                              if r["tolerance"]],
                 colour, "diamond", filled=False, line=False, below=not below)
        if (backend, measure) in result.floors:
            plot.add_floor(f"floor of the {words}", result.floors[backend, measure], colour)
    plot.set_front(front.pareto([(r["seconds"], r[measure]) for r in result.rows if r[measure]]))
    if measure in result.crossovers:
        _mark(plot, result.crossovers[measure])
    return plot


def _mark(plot, crossing):
    """The time at which one back end overtakes the other."""
    say = sceneMeasures.seconds_text
    if crossing["open"]:
        at = crossing["expected"] or crossing["until"]
        # A mark far away would press everything else into a corner.
        near = at < 30.0 * crossing["until"]
        plot.add_crossing(("level expected at " if near else "rasterizer better; level expected at ") + say(at),
                          at if near else crossing["until"], sure=False)
    elif crossing["at"]:
        plot.add_crossing(f"rasterizer better below {say(crossing['at'])}", crossing["at"])
    elif crossing["below"]:
        plot.add_crossing(f"path tracer below the rasterizer from {say(crossing['below'])}", crossing["below"])


def _over_samples(slopes, title, foot):
    plot = Plot(f"{title}: convergence", "samples per pixel", "RMSE", foot)
    for backend, found in slopes.items():
        light = ", against direct light" if found["against"] == "direct" else ""
        plot.add(f"{WORDS[backend]}{light}: slope {found['slope']:.2f}",
                 [(n, e, "") for n, e in zip(found["samples"], found["rmse"])], COLOURS[backend], KINDS[backend])
    plot.x_ticks = sorted({n for found in slopes.values() for n in found["samples"]})
    plot.add_guide(-0.5, "slope -0.5: independent samples")
    return plot


def write(results, folder, foot=""):
    """Writes an SVG per stage and measure. :returns: paths"""
    paths, taken = [], set()
    for result in results:
        name = file_name(result.stage, taken)
        for measure, plot in plots(result, foot).items():
            path = os.path.join(folder, f"{name}-{measure}.svg")
            outputs.write_text(path, plot.svg())
            paths.append(path)
    return paths


def file_name(stage, taken):
    """A name of letters, digits, - and _ for a stage, another for each."""
    stem = os.path.splitext(os.path.basename(stage))[0]
    base = "".join(c if c.isascii() and (c.isalnum() or c in "-_") else "_" for c in stem)[:80] or "stage"
    name, number = base, 2
    while name.lower() in taken:
        name, number = f"{base}-{number}", number + 1
    taken.add(name.lower())
    return name
