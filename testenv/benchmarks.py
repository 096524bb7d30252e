# SPDX-License-Identifier: Apache-2.0
"""The page of benchmarks: tables of docs/charts as Markdown. generateDocs.py writes it."""
import os

from patina import experiment

CHARTS = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "docs", "charts"))
BACK_ENDS = {"embree": "path tracer", "raster": "rasterizer"}
INTRO = """# Benchmarks

Seconds and errors of both back ends on test scenes, from `docs/charts/scenes.csv`. `./patina python testenv/charts.py` measures
them anew on your machine, and `./patina python testenv/generateDocs.py benchmarks` writes this page from the table.
[Speed against accuracy](../measurements/charts.md) draws them, and says which machine it was. `./patina bench` measures the
renderer beside others: [the path tracer](../measurements/path.md), [hosts of Hydra](../measurements/hydra.md).

Seconds are those of samples alone; *in all* adds the first frame, in which the scene is built and shaders compiled. relMSE and
FLIP are those beside a path traced reference of 16 times the samples. *Direct* is the relMSE beside direct light alone, which
is what the rasterizer draws. A tolerance is met where a render ended by it, before the most samples of the table."""
HEAD = ("back end", "samples", "tolerance", "seconds", "in all", "relMSE", "FLIP", "direct")


def read(name):
    """:returns: the rows of a table of docs/charts"""
    return experiment.read_csv(os.path.join(CHARTS, name))


def number(text, digits=2):
    """:returns: a figure with some significant digits, never in scientific notation above a thousandth"""
    if not text:
        return ""
    value = float(text)
    if value and abs(value) < 1e-3:
        return f"{value:.{digits - 1}e}".replace("e-0", "e-")
    return f"{value:.{digits}g}" if abs(value) < 100 else f"{value:.0f}"


def row(found):
    met = "met" if found["toleranceMet"] == "yes" else "not met"
    asked = f"{float(found['tolerance']):g}, {met}" if found["tolerance"] else ""
    return (BACK_ENDS[found["backend"]], f"{float(found['samples']):.0f}", asked,
            *(number(found[name]) for name in ("seconds", "secondsInAll", "relMSE", "flip", "relMSEDirect")))


def predictions():
    """:returns: lines on how many pictures came out within the tolerance that they were rendered to"""
    rows = read("predictions.csv")
    lines = []
    for tolerance in sorted({r["tolerance"] for r in rows}, key=float, reverse=True):
        of = [r for r in rows if r["tolerance"] == tolerance]
        decided = [r for r in of if r["state"] in ("within", "outside", "samples")]
        within = sum(r["state"] == "within" for r in of)
        lines.append((f"{float(tolerance):g}", str(len(of)), str(within), str(len(decided) - within),
                      str(len(of) - len(decided))))
    return ["", "## Tolerances that were kept", "",
            "Of every test scene, path traced until it met a tolerance (`docs/charts/predictions.csv`). *Undecided* are those "
            "that a",
            "limit of time ended, or whose reference was too noisy.", "",
            *experiment.table(("tolerance", "pictures", "within", "outside", "undecided"), lines)]


def page():
    """:returns: the lines of docs/generated/benchmarks.md"""
    rows = read("scenes.csv")
    lines = INTRO.split("\n")
    for stage in dict.fromkeys(r["stage"] for r in rows):
        of = sorted((r for r in rows if r["stage"] == stage),
                    key=lambda r: (r["backend"], bool(r["tolerance"]), -float(r["tolerance"] or 0), float(r["samples"])))
        name = os.path.splitext(os.path.basename(stage))[0]
        lines += ["", f"## {name}", "", f"`{stage}`", "", *experiment.table(HEAD, map(row, of))]
    return lines + predictions()
