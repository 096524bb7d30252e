# SPDX-License-Identifier: Apache-2.0
"""The atlas of sweeps as text, as one HTML page, and as one picture."""
import os
from html import escape

import numpy as np

from patina.chart import look, svgLines
from patina.cli import outputs

STYLE = ".charts figure{border:1px solid var(--line);background:var(--card);max-width:460px}"\
        "figcaption{padding:4px 12px 10px}.charts svg{border:0}"
HEAD = """<p>Each chart takes one parameter through the region where a method fails. The wide grey line is the truth: a closed
form, an integral, or a walk. Dots mark the method that is used there; a dotted upright line, where another takes over;
crosses at the upper edge, where a method gives no number. Below each chart stands what fails, how far off that method
is at most, and the bound that the marked one keeps (<code>testenv/stability/test_atlas.py</code> holds it). Methods
that are called unguarded are no part of Patina: they are textbook forms in single precision, to show what the guards
are for.</p>"""
OVERVIEW = ("alpha to 0, mirror switch", "noise of samplers at grazing views", "albedo near ior 1",
            "white metal over roughness",
            "film from nothing to 60 um", "Fresnel, aluminium near 82 degrees", "rough white diffuse", "Ward at grazing views",
            "V-cavities at grazing angles", "anisotropy in tables", "normals below the horizon, mirror", "layer over grey")


def _maximum(values):
    """:returns: the largest, in words"""
    values = np.asarray(values, float)
    return f"{values.max():.2g}" if np.isfinite(values).all() else "no number"


def caption(sweep):
    used = ", then ".join(dict.fromkeys(sweep.chosen))
    return (f"{sweep.fails} Largest error of {sweep.failing}: {_maximum(sweep.error(sweep.failing))}; of what is used "
            f"({used}): {_maximum(sweep.held())}, bound {sweep.bound:.2g}.")


def listing(sweeps):
    """The sweeps as text, for a terminal."""
    lines = [f"{'sweep':<40}{'fails':<26}{'error':>10}  {'used':<26}{'error':>10}{'bound':>10}"]
    for s in sweeps:
        lines.append(f"{s.name:<40}{s.failing:<26}{_maximum(s.error(s.failing)):>10}  "
                     f"{s.chosen[-1]:<26}{_maximum(s.held()):>10}{s.bound:>10.2g}")
    return "\n".join(lines)


def write(sweeps, folder):
    """Writes stability.html and, with all sweeps, stability.svg.

    :returns: the paths
    """
    families = {}
    for sweep in sweeps:
        families.setdefault(sweep.family, []).append(sweep)
    lines = [look.page("Patina: where methods fail", STYLE), "<h1>Where methods fail</h1>", HEAD]
    for family, group in families.items():
        lines.append(f'<h2>{escape(family[0].upper() + family[1:])}</h2><div class="charts">')
        for sweep in group:
            bad = "".join(f'<br><span class="bad">{escape(problem)}</span>' for problem in sweep.problems())
            notes = "".join(f"<br>{escape(note)}" for note in sweep.notes)
            lines.append(f"<figure>{svgLines.lines(sweep)}<figcaption>{escape(caption(sweep))}{notes}{bad}</figcaption></figure>")
        lines.append("</div>")
    paths = [os.path.join(folder, "stability.html")]
    outputs.write_text(paths[0], "\n".join([*lines, look.END]))
    named = {sweep.name: sweep for sweep in sweeps}
    if all(name in named for name in OVERVIEW):
        paths.append(os.path.join(folder, "stability.svg"))
        outputs.write_text(paths[1], overview([named[name] for name in OVERVIEW]))
    return paths


def overview(sweeps, columns=4, width=340, height=230):
    """:returns: an `svg` element of some sweeps side by side"""
    rows = -(-len(sweeps) // columns)
    parts = [look.start("Methods through the regions where they fail", columns * width, rows * height)]
    for i, sweep in enumerate(sweeps):
        text = svgLines.lines(sweep, width, height)
        parts.append(text.replace("<svg ", f'<svg x="{i % columns * width}" y="{i // columns * height}" ', 1).strip())
    return "\n".join([*parts, "</svg>"]) + "\n"
