# SPDX-License-Identifier: Apache-2.0
"""The plan of a material as the page shows it: what `patina explain` lists, and for every method that was not taken what it
would change: predicted error and time from the planner's table, the albedo from the lobes, and a program that draws it."""
import re

import numpy as np

from patina.cli import compiled

MAX_LINES = 1000             # of the plan's text
MAX_CHARACTERS = 1_000_000   # of all programs of methods together
MAX_COST = 200.0             # over the default: a browser would stop answering
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # of linear Rec.709
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_AFTER_GRAPH = re.compile(r"\(\d+ nodes before simplification, \d+ after\)\n\n")
_METHOD = re.compile(r"method (\w+) = (\w+): ")
_CUT = "left out: "


def albedo(network, methods):
    """The share of even light that the surface returns: the directional albedo, 2 mu E(mu) over mu from 0 to 1.

    :returns: list of three numbers, linear Rec.709; None where they are not finite or there is no surface
    """
    mu = 0.5 * (_NODES + 1.0)
    wo = np.stack([np.sqrt(1.0 - mu * mu), np.zeros_like(mu), mu], axis=1)
    try:
        found = np.asarray(compiled.load().MaterialProbe(network, methods).albedo(wo), float)
    except (RuntimeError, ValueError):
        return None
    mean = (found * (_WEIGHTS * mu)[:, None]).sum(axis=0)
    return [float(f"{x:.6g}") for x in mean] if np.isfinite(mean).all() else None


def _text_of(network, methods):
    """:returns: lines of the plan, and of them what was left out, as `patina explain` has them"""
    text = compiled.load().explain_material(network, [], methods)
    lines = _AFTER_GRAPH.split(text)[-1].rstrip("\n").split("\n")
    cuts = [line[len(_CUT):] for line in lines if line.startswith(_CUT)]
    return [line for line in lines if not line.startswith((_CUT, "method "))], cuts, [line for line in lines if _METHOD.match(line)]


def _figures(network, methods, point):
    """Predicted error and times at one choice point; an empty dict where the planner has none."""
    plan = compiled.load().plan_material(network, methods, -1.0)
    return next((choice for choice in plan["choices"] if choice["point"] == point), {})


def _capped(lines):
    return lines[:MAX_LINES] + ([f"... and {len(lines) - MAX_LINES} more"] if len(lines) > MAX_LINES else [])


def build(network, methods, program_of, add):
    """
    :param program_of: methods -> the two texts of the material with them, as materials.build() makes them, and their lobes
    :param add: takes such texts and lobes into the page, returns their place among the programs
    :returns: dict for the page: kept and leftOut as lines, albedo, and for each choice point its methods
    """
    module = compiled.load()
    kept, cuts, taken = _text_of(network, methods)
    points = {name: names for name, names in module.choice_points()}
    own, _ = program_of(methods)
    start = albedo(network, methods)
    room = MAX_CHARACTERS
    choices = []
    for line in taken:
        point, now = _METHOD.match(line).groups()
        rows = []
        for name, description in points.get(point, ()):
            forced = {**methods, point: name}
            predicted = _figures(network, forced, point)
            row = {"name": name, "text": description, "error": predicted.get("error") if predicted.get("measured") else None,
                   "time": predicted["ns"] / predicted["nsDefault"] if predicted.get("nsDefault") else None,
                   "albedo": start if name == now else albedo(network, forced), "program": None, "why": ""}
            if name != now:
                room = _draw(row, point, forced, own, program_of, add, room)
            rows.append(row)
        choices.append({"point": point, "method": now, "methods": rows})
    return {"kept": _capped(kept), "leftOut": _capped(cuts), "albedo": start, "choices": choices}


def _draw(row, point, forced, own, program_of, add, room):
    """Gives a method a program where it changes the shader. :returns: characters that are left"""
    figures = compiled.load().method_figures(point, row["name"])
    if figures and figures["cost"] > MAX_COST:
        row["why"] = f"{figures['cost']:.0f} times the time of the default: too slow for a page"
        return room
    made, lobes = program_of(forced)
    size = sum(len(made[key]["text"]) for key in ("lean", "whole") if made[key])
    if made == own:
        row["why"] = "the page's shader does the same for both"
    elif size > room:
        row["why"] = "the page has no room for its shader"
    else:
        row["program"] = add(made, lobes)
        return room - size
    return room
