# SPDX-License-Identifier: Apache-2.0
"""The parts of a render's page as HTML."""
import os
import platform
import shlex
from dataclasses import dataclass
from html import escape

import numpy as np

from patina import __version__
from patina.chart import machine
from patina.cli import causes, memory, planText, verbose


@dataclass
class Facts:
    """A render, as the sections of its report need it."""
    arguments: object
    frame: dict  # its numbers, as in --json
    frames: list  # those of all frames so far
    image: str
    images: list
    info: object  # what the reader told
    settings: dict
    warnings: list
    notes: list
    interrupted: bool
    error: object  # array: relative error of each pixel
    samples: object  # array
    window: tuple  # first and last pixel, both included
    materials: list  # (path, plan or None, text)
    plan_lines: list

    def inside(self, values):
        x0, y0, x1, y1 = self.window
        return np.asarray(values)[y0:y1 + 1, x0:x1 + 1]


def body(facts):
    """:returns: HTML"""
    return "\n".join([_head(facts), _viewer(facts), _time(facts), _pixels(facts), _warnings(facts), _plan(facts),
                      _frames(facts), _again(facts)])


def _table(head, rows, classes):
    """:param classes: of the columns; cells are HTML"""
    def row(cells, tag):
        return "<tr>" + "".join(f'<{tag} class="{c}">{cell}</{tag}>' for cell, c in zip(cells, classes)) + "</tr>"

    return "<table>" + row(map(escape, head), "th") + "".join(row(cells, "td") for cells in rows) + "</table>"


def _bar(share, second=False):
    return f'<span{" class=second" if second else ""} style="width:{100.0 * min(max(share, 0.0), 1.0):.2f}%"></span>'


def _seconds(value):
    return f"{value:.2f} s" if value < 100.0 else f"{int(value) // 60}:{int(value) % 60:02d} min"


def _head(facts):
    frame = facts.frame
    rays, spent = frame.get("rays", 0), frame["seconds"].get("render", 0.0)
    cards = [("resolution", f"{frame['width']} × {frame['height']}"), ("samples per pixel", f"{frame['samplesPerPixel']:.4g}"),
             ("noise, estimated", f"{100.0 * frame['estimatedError']:.2g} %" if "estimatedError" in frame else "–"),
             ("time", _seconds(sum(frame["seconds"].values()))),
             ("rays per second", f"{rays / spent / 1e6:.3g} million" if rays and spent > 0.0 else "–"),
             ("peak memory", memory.text(memory.peak())), ("warnings", str(sum(w["count"] for w in facts.warnings))),
             ("back end", frame["backend"])]
    when = "" if frame["frame"] is None else f", frame {frame['frame']:g}"
    lines = [f"<h1>{escape(facts.image)}</h1>",
             f'<p class="dim">{escape(facts.arguments.stage)}{when}, camera {escape(facts.info.camera)}; '
             f"Patina {__version__}</p>"]
    if len(facts.images) > 1:
        lines.append(f'<p class="dim">also written: {escape(", ".join(facts.images[1:]))}</p>')
    if facts.interrupted:
        lines.append('<p class="bad">This render was interrupted: it has fewer samples than were asked for.</p>')
    cells = "".join(f"<div><dt>{escape(name)}</dt><dd>{escape(text)}</dd></div>" for name, text in cards)
    lines.append(f'<dl class="cards">{cells}</dl>')
    if "estimatedErrorIs" in frame:
        lines.append(f'<p class="dim">Noise: {escape(frame["estimatedErrorIs"])}.</p>')
    return "\n".join(lines)


def _viewer(facts):
    return """<div id="tools">
<label>left <select id="leftChoice"></select></label><label>right <select id="rightChoice"></select></label>
<button id="swap" title="s">swap</button>
<span id="zoom" role="group" aria-label="size"><button data-zoom="0">fit</button> <button data-zoom="1">1:1</button>
<button data-zoom="2">2:1</button> <button data-zoom="4">4:1</button></span>
<span class="dim">keys 1 to 9 choose the right picture, s swaps</span></div>
<div id="wipe"><div id="sheet"><img id="left" alt=""><img id="right" alt="">
<button id="divider" role="slider" aria-label="divider" aria-valuemin="0" aria-valuemax="100"></button>
<span class="tag" id="leftTag"></span><span class="tag" id="rightTag"></span></div></div>
<div id="legends"></div>
<div id="pixel" aria-live="off"><span class="dim">Point at a pixel.</span></div>"""


def _time(facts):
    frame = facts.frame
    longest = max(frame["seconds"].values(), default=0.0) or 1.0
    phases = [[word, _bar(frame["seconds"][name] / longest), _seconds(frame["seconds"][name]),
               memory.text(frame["memory"].get(name))] for name, word in verbose.NAMES.items() if name in frame["seconds"]]
    left = "<div><h3>By phase</h3>" + _table(["phase", "", "time", "memory after"], phases, ["", "bar", "n", "n"])
    if "bytes" in frame:
        left += (f'<p class="dim">{frame.get("trianglesStored", 0)} triangles and {frame.get("instances", 0)} instances; '
                 f'meshes and acceleration structures take {memory.text(frame["bytes"])}.</p>')
    return f'<h2>Time and memory</h2><div class="columns">{left}</div>{_by_material(frame)}</div>'


def _by_material(frame):
    spent = frame.get("materialSeconds")
    if not spent:
        return "<div><h3>By material</h3><p class=dim>The rasterizer measures no time by material.</p></div>"
    total = sum(spent.values()) or 1.0
    names = {"": "displayColor", "camera": "rays of the camera, until they hit something"}
    ranked = sorted(spent.items(), key=lambda item: -item[1])
    most = ranked[0][1] or 1.0
    rows = [[escape(names.get(path, path)), _bar(seconds / most, path == "camera"), f"{100.0 * seconds / total:.1f} %",
             _seconds(seconds)] for path, seconds in ranked[:30]]
    more = f'<p class="dim">and {len(ranked) - 30} more</p>' if len(ranked) > 30 else ""
    return ("<div><h3>By material</h3>" + _table(["material", "", "share", "all threads"], rows, ["", "bar", "n", "n"]) + more +
            '<p class="dim">A path is at a material from its hit until it hits the next: patterns, lobes, light samples with '
            "their shadow rays, and the ray that leaves.</p></div>")


def _pixels(facts):
    error, samples = facts.inside(facts.error), facts.inside(facts.samples)
    known = np.isfinite(error)
    left_out = int(error.size - known.sum())
    error, numbers = np.where(known, error, -1.0), error[known]
    worst = np.unravel_index(int(np.argmax(error)), error.shape)
    x0, y0 = facts.window[:2]
    rows = [[f"{name}", f"{100.0 * np.quantile(numbers, q):.3g} %"] for name, q in
            (("half of the pixels are below", 0.5), ("nine in ten", 0.9), ("99 in 100", 0.99)) if numbers.size]
    if numbers.size:
        rows.append([f"the worst, pixel {worst[1] + x0}, {worst[0] + y0}", f"{100.0 * error[worst]:.3g} %"])
    if left_out:
        rows.append(["pixels whose error is no finite number, which are left out", f"{left_out}"])
    return ('<h2>Error and samples of the pixels</h2><div class="columns"><div><h3>Error</h3>'
            + _table(["standard error of the luminance over luminance + 0.01", ""], rows, ["", "n"])
            + _histogram(np.log10(np.maximum(100.0 * numbers, 1e-4)), lambda x: f"{10.0 ** x:.3g} %")
            + "</div><div><h3>Samples</h3>"
            + _table(["samples of a pixel", ""], [["fewest", f"{samples.min():g}"], ["mean", f"{samples.mean():.5g}"],
                                                 ["most", f"{samples.max():g}"]], ["", "n"])
            + _histogram(samples.astype(float), lambda x: f"{x:.4g}") + "</div></div>")


def _histogram(values, text, bins=60):
    """:returns: SVG of how many pixels have which value"""
    values = values[np.isfinite(values)]
    if not values.size:
        return '<p class="dim">No pixel has a finite number.</p>'
    low, high = float(values.min()), float(values.max())
    if high - low < 1e-9:
        return f'<p class="dim">All pixels have {escape(text(low))}.</p>'
    counts = np.histogram(values, bins=bins, range=(low, high))[0]
    width, height = 600.0 / bins, 90.0
    bars = "".join(f'<rect x="{i * width:.1f}" y="{height - height * n / counts.max():.1f}" width="{width - 1:.1f}" '
                   f'height="{height * n / counts.max():.1f}"/>' for i, n in enumerate(counts) if n)
    marks = "".join(f'<text x="{600 * s:.0f}" y="106" text-anchor="{anchor}">{escape(text(low + s * (high - low)))}</text>'
                    for s, anchor in ((0.0, "start"), (0.5, "middle"), (1.0, "end")))
    return f'<svg class="histogram" viewBox="0 0 600 110" role="img" aria-label="histogram">{bars}{marks}</svg>'


def _advice(group):
    return f'<br><span class="dim">{escape(group["advice"])}</span>' if group["advice"] else ""


def _warnings(facts):
    groups = causes.Causes(facts.warnings).groups
    notes = "".join(f'<p class="dim">{escape(note)}</p>' for note in facts.notes)
    if not groups:
        return f"<h2>Warnings</h2><p>None.</p>{notes}"
    rows = [[f'<span class="{g["severity"]}">{g["severity"]}</span>', escape(causes.printable(g["message"])) + _advice(g),
             escape(causes.printable(g["prim"] + ("." + g["input"] if g["input"] else ""))), str(g["count"]), str(g["prims"])]
            for g in groups[:200]]
    more = f'<p class="dim">and {len(groups) - 200} more causes (--json has all)</p>' if len(groups) > 200 else ""
    table = _table(["", "what", "first at", "times", "prims"], rows, ["", "", "", "n", "n"])
    return f"<h2>Warnings by cause</h2>{table}{more}{notes}"


def _plan(facts):
    tolerance = facts.settings["tolerance"]
    asked = "default methods" if tolerance < 0.0 else f"tolerance {tolerance:g}"
    lines = [f"<h2>The plan: {asked}</h2>"]
    lines += [f"<p>{escape(line)}</p>" for line in facts.plan_lines]
    if not facts.materials:
        return "\n".join([*lines, "<p>The stage has no materials; displayColor is shown.</p>"])
    lines.append('<p class="dim">The model of each material, and what was left out. Those that took most of the time '
                 "come first.</p>")
    for path, plan, text in facts.materials:
        planned = "\n".join(planText.lines(plan)) if plan else ""
        error = f' <span class="dim">predicted error {plan["error"]:.2g}</span>' if plan else ""
        reported = escape(text.rstrip() + "\n" + planned)
        lines.append(f"<details><summary>{escape(path)}{error}</summary><pre>{reported}</pre></details>")
    return "\n".join(lines)


def _frames(facts):
    if len(facts.frames) < 2:
        return ""
    rows = [["–" if f["frame"] is None else f"{f['frame']:g}", escape(f["image"]), f"{f['samplesPerPixel']:.4g}",
             f"{100.0 * f['estimatedError']:.2g} %" if "estimatedError" in f else "–", _seconds(sum(f["seconds"].values()))]
            for f in facts.frames]
    return "<h2>Frames</h2>" + _table(["frame", "image", "samples per pixel", "noise", "time"], rows, ["n", "", "n", "n", "n"])


def command_of(arguments):
    """:returns: what renders the same again, for a shell in any folder"""
    words = [os.environ.get("PATINA_COMMAND") or "patina", *(getattr(arguments, "argv", None) or ["record", arguments.stage])]
    return f"cd {shlex.quote(os.getcwd())} && {shlex.join(words)}"


def _again(facts):
    known = machine.describe()
    known["machine"] = platform.node()
    rows = [[escape(name), escape(str(value))] for name, value in known.items()]
    rows += [[escape(name), escape(os.environ[name])] for name in ("OCIO", "PATINA_MODEL_PATH") if os.environ.get(name)]
    return ('<h2>Render it again</h2><pre id="command">' + escape(command_of(facts.arguments))
            + '</pre><button data-copy="command">Copy the command</button>'
            f'<p class="dim">Seed {facts.settings["seed"]}: the same version gives the same bits, with any number of threads, '
            "where all samples are taken (not with --seconds).</p>" + _table(["made by", ""], rows, ["", ""]))
