# SPDX-License-Identifier: Apache-2.0
"""One HTML page of charted stages: charts, pictures, tables; nothing of it is loaded from elsewhere."""
import os
from html import escape

import numpy as np

from patina.chart import look, png, sceneCharts, sceneResults
from patina.chart.sceneMeasures import seconds_text
from patina.experiment import LUMINANCE
from patina.chart.sceneRenders import WORDS
from patina.cli import outputs

STYLE = """
figcaption{max-width:256px}img{display:block;width:256px;image-rendering:pixelated;border:1px solid var(--line)}
.finding{background:var(--tint);border-left:4px solid var(--mark);padding:8px 12px;margin:8px 0}
"""
ROW = (("relMSE", "relMSE"), ("rmse", "RMSE"), ("flip", "FLIP"), ("meanError", "bias"), ("relative", "mean |error|"),
       ("relMSEDirect", "relMSE"), ("flipDirect", "FLIP"), ("meanErrorDirect", "bias"))
SHARES = ("meanError", "relative", "meanErrorDirect")  # shown in per cent


def write(results, path, machine, command, seed):
    lines = [look.page("Patina: speed against error", STYLE), "<h1>Speed against error</h1>", *_head(machine, command, seed)]
    lines += [f'<p class="bad">{escape(_short(r.stage))}: {escape(r.problem)}</p>' for r in results if r.problem]
    for result in results:
        if not result.problem:
            lines += _stage(result)
    outputs.write_text(path, "\n".join([*lines, look.END]))


def _short(stage):
    return os.path.basename(stage) or stage


def _head(machine, command, seed):
    pairs = "".join(f'<tr><th class="t">{escape(name)}</th><td class="t">{escape(value)}</td></tr>'
                    for name, value in {**machine, "command": command, "seed": str(seed)}.items())
    return ["<p>Each point is an image: how long it took on this machine, and how far it is from the reference that its "
            "stage names. Numbers beside points are samples per pixel (circles, squares) or tolerances (diamonds). The yellow "
            "band joins the images that no other beats in both time and error. A dotted floor is the error that more samples "
            "do not lower: what a back end or its methods leave out. Times are of warm renders, medians of three below a "
            "second; errors are means over the repeats, each of which has a seed of its own.</p>",
            f"{look.WIDE}<table>{pairs}</table></div>"]


def _stage(result):
    ladder, renders = result.ladder, result.ladder.renders
    lines = [f"<h2>{escape(_short(result.stage))}</h2>",
             f"<p>{renders.width} x {renders.height} pixels, camera {escape(renders.info.camera)}.</p>"]
    names = {"all": "Reference", "direct": "Reference of direct light, which is what the rasterizer draws"}
    for name, reference in ladder.references.items():
        noise = f"; its own noise is a relMSE of about {reference.noise:.1g}" if reference.noise else ""
        lines.append(f"<p>{names[name]}: {escape(reference.words)}{noise}.</p>")
    for measure, found in result.crossovers.items():
        lines.append(f'<p class="finding">By {sceneResults.NAMES[measure]}: {escape(found["text"])}.</p>')
    for problem in ladder.problems:
        lines.append(f'<p class="bad">{escape(problem)}</p>')
    lines.append('<div class="charts">')
    lines += [plot.svg() for plot in sceneCharts.plots(result).values()]
    lines.append("</div>")
    return lines + _pictures(result) + _tolerances(result) + _slopes(result) + _costs(ladder) + _table(result) + [
        "<h3>Notes</h3><ul>" + "".join(f"<li>{escape(n)}</li>" for n in ladder.notes) + "</ul>" if ladder.notes else ""]


def _figure(image, words):
    return (f'<figure><img alt="{escape(words, quote=True)}" src="{png.data_uri(image)}">'
            f"<figcaption>{escape(words)}</figcaption></figure>")


def signed(image, reference):
    """Relative errors of the luminance as colours: white 0, red brighter, blue darker, full colour at half of the reference.

    :returns: linear values, for png
    """
    a, b = (np.nan_to_num(x.astype(np.float64)) @ LUMINANCE for x in (image, reference))
    error = np.clip(2.0 * (a - b) / (b + 0.01), -1.0, 1.0)[..., None]
    return np.where(error > 0.0, 1.0 - error * (0.2, 0.9, 0.9), 1.0 + error * (0.9, 0.7, 0.1))


def _pictures(result):
    ladder = result.ladder
    lines = ["<h3>Pictures</h3>", '<div class="shots">']
    lines += [_figure(reference.image, {"all": "reference", "direct": "reference, direct light"}[name])
              for name, reference in ladder.references.items()]
    lines.append("</div>")
    for backend in ladder.first:
        lines.append('<div class="shots" style="margin-top:10px">')
        for rung, row in zip(ladder.rungs, result.rows):
            if rung.backend == backend:
                what = f"tolerance {rung.tolerance:g}, " if rung.tolerance else ""
                flip = "" if row["flip"] is None else f", FLIP {row['flip']:.3f}"
                lines.append(_figure(rung.renders[0].image,
                                     f"{WORDS[backend]}, {what}{rung.samples:.4g} sample{'s' * (rung.samples != 1)}, "
                                     f"{seconds_text(rung.seconds)}{flip}"))
        last = ladder.of(backend)[-1]
        lines.append(_figure(signed(last.renders[0].image, ladder.references["all"].image),
                             f"{last.samples:g} samples against the reference: red is too bright, blue too dark, full colour "
                             "from 50 % on"))
        lines.append("</div>")
    return lines


def _tolerances(result):
    rows = [row for row in result.rows if row["tolerance"]]
    if not rows:
        return []
    lines = ["<h3>Tolerances, asked for and measured</h3><p>The error is what a tolerance is about: the mean over the pixels "
             "of |error| / (luminance + 0.01), against all light. A tolerance that the most samples of this chart do not reach "
             "is not met. What its own samples told, and so ended it, stands before.</p>",
             '<table><tr><th class="t">back end</th><th>tolerance</th><th>error told</th><th>measured error</th>'
             '<th class="t">met</th><th>samples</th><th>seconds</th></tr>']
    for row in rows:
        measured = "-" if row["relative"] is None else f"{100 * row['relative']:.2f} %"
        lines.append(f'<tr><td class="t">{WORDS[row["backend"]]}</td><td>{100 * row["tolerance"]:g} %</td>'
                     f'<td>{100 * row["told"]:.2f} %</td><td>{measured}</td><td class="t">{row["toleranceMet"]}</td>'
                     f'<td>{row["samples"]:.4g}</td><td>{row["seconds"]:.3g}</td></tr>')
    return lines + ["</table>"]


def _slopes(result):
    found = {b: s for b, s in result.slopes.items() if s}
    if not found:
        return []
    lines = ["<h3>Convergence</h3><p>Slope of log RMSE over log samples: -0.5 for independent samples, steeper where "
             "stratification helps; near 0 where a bias is left; between them where few bright paths decide.</p>",
             '<table><tr><th class="t">back end</th><th class="t">against</th><th>slope</th><th>tiles: median</th>'
             '<th>quartiles</th><th>shallowest</th><th class="t">its pixels</th></tr>']
    for backend, s in found.items():
        tiles = s["byTile"]
        light = {"all": "all light", "direct": "direct light"}[s["against"]]
        cells = ["-"] * 4
        if tiles:
            x0, y0, x1, y1 = tiles["tile"]
            cells = [f"{tiles['median']:.2f} of {tiles['tiles']}", f"{tiles['low']:.2f} to {tiles['high']:.2f}",
                     f"{tiles['shallowest']:.2f}", f"{x0},{y0} to {x1 - 1},{y1 - 1}"]
        lines.append(f'<tr><td class="t">{WORDS[backend]}</td><td class="t">{light}</td><td>{s["slope"]:.2f}</td>'
                     + "".join(f"<td>{c}</td>" for c in cells) + "</tr>")
    return lines + ["</table>"]


def _costs(ladder):
    first = "; ".join(f"{WORDS[b]} {seconds_text(s)}" for b, s in ladder.first.items())
    return [f"<h3>Before the first sample</h3><p>Reading the stage: {seconds_text(ladder.renders.seconds_to_read)}. "
            f"Building the scene, and shaders where the rasterizer compiles them, in a first frame: {first}. &ldquo;In "
            "all&rdquo; below counts both.</p>"]


def _table(result):
    lines = ['<h3>All renders</h3>' + look.WIDE + '<table><tr><th class="t" colspan="7"></th>'
             '<th colspan="5">against the reference</th><th colspan="3">against direct light</th><th></th></tr>'
             '<tr><th class="t">back end</th><th>samples</th><th>tolerance</th><th>repeats</th><th>seconds</th>'
             '<th>in all</th><th>cores</th>'
             + "".join(f"<th>{words}</th>" for _, words in ROW) + "<th>1 / (relMSE s)</th></tr>"]
    for row in result.rows:
        tolerance = f"{row['tolerance']:g}" + ("" if row["toleranceMet"] == "yes" else " not met") if row["tolerance"] else ""
        cells = [f"{row['samples']:.4g}", tolerance, str(row["repeats"]), f"{row['seconds']:.3g}", f"{row['secondsInAll']:.3g}",
                 f"{row['cores']:.1f}"]
        for name, _ in ROW:
            value = row[name]
            cells.append("" if value is None else f"{100 * value:+.2f} %" if name in SHARES and name != "relative"
                         else f"{100 * value:.2f} %" if name in SHARES else f"{value:.3g}")
        work = row["relMSE"] * row["seconds"] if row["relMSE"] else 0.0
        cells.append(f"{1.0 / work:.3g}" if work else "")
        lines.append(f'<tr><td class="t">{WORDS[row["backend"]]}</td>' + "".join(f"<td>{c}</td>" for c in cells) + "</tr>")
    return lines + ["</table></div>"]
