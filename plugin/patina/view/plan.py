# SPDX-License-Identifier: Apache-2.0
"""The plan of a material as the page shows it: what `patina explain` lists, and for every method that was not taken what it
would change: predicted error and time from the planner's table, the albedo from the lobes, and a program that draws it. What
simplification left out hangs on inputs, of which each tells the albedo where it asks for the most."""
import re

import numpy as np

from patina.cli.compiled import _patina
from patina.cli.errors import CommandError
from patina.view import live

MAX_LINES = 1000             # of the plan's text
MAX_CHARACTERS = 1_000_000   # of all programs of methods together
MAX_COST = 200.0             # over the default: a browser would stop answering
MAX_EFFECTS = 64             # inputs that are looked at, fewer of large networks
SAMPLES = 1024               # of each of 16 directions
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_AFTER_GRAPH = re.compile(r"\(\d+ nodes before simplification, \d+ after\)\n\n")
_METHOD = re.compile(r"method (\w+) = (\w+): ")
_CUT = "left out: "


def _directions():
    """View directions at Gauss-Legendre nodes of mu, and four numbers for a sample of each: the sequence of Roberts (2018)."""
    golden = 1.1673039782614187  # x^5 = x + 1
    mu = np.repeat(0.5 * (_NODES + 1.0), SAMPLES)
    u = (0.5 + np.arange(1, len(mu) + 1)[:, None] * golden ** -np.arange(1.0, 5.0)) % 1.0
    return np.stack([np.sqrt(1.0 - mu * mu), np.zeros_like(mu), mu], axis=1).astype("<f4"), u.astype("<f4")


def albedo(network, methods):
    """The share of even light that the surface sends on: the mean of the directional albedo, 2 mu E(mu) over mu from 0 to 1, of
    which E(mu) is the mean weight of samples. Lobes have albedos of their own, but those are as good as their method.

    :returns: list of three numbers, linear Rec.709; None where they are not finite or there is no surface
    """
    wo, u = _directions()
    try:
        weights = np.asarray(_patina.MaterialProbe(network, methods).sample(wo, u)["weight"], float)
    except (RuntimeError, ValueError):
        return None
    each = weights.reshape(len(_NODES), SAMPLES, 3).mean(axis=1)
    mean = (each * (_WEIGHTS * 0.5 * (_NODES + 1.0))[:, None]).sum(axis=0)
    return [float(f"{x:.6g}") for x in mean] if np.isfinite(mean).all() else None


def effects(network, inputs, chosen, entries, methods):
    """Inputs that cost the lean text a lobe more: what they would bring is left out at their authored values.

    :param chosen: places of the inputs that the lean text has
    :param entries: controls of the inputs, for their ranges
    :returns: list of dicts: place of the input, the end of its range that is farther away, and the albedo there
    """
    ranges = {entry["input"]: entry for entry in entries}
    found, most = [], max(4, MAX_EFFECTS * 100 // max(100, len(network.nodes())))
    for i, moved in enumerate(inputs):
        entry = ranges.get(f"{moved.node}.{moved.name}")
        if i in chosen or entry is None or "min" not in entry or moved.kind == "vector3":  # a direction has no more or less
            continue
        low, high = entry["min"], entry["max"]
        to = [high if x - low <= high - x else low for x in moved.value]
        whole = [int(x) for x in to] if moved.kind in ("boolean", "integer") else to
        changed = live.with_live(network, [], [])
        changed.set_input(moved.node, moved.name, moved.kind, whole[0] if len(whole) == 1 else whole)
        found.append({"input": i, "to": to, "albedo": albedo(changed, methods)})
        if len(found) == most:
            break
    return found


def _text_of(network, methods):
    """:returns: lines of the plan as `patina explain` has them: what is kept, what is left out, and the methods"""
    text = _patina.explain_material(network, [], methods)
    lines = _AFTER_GRAPH.split(text)[-1].rstrip("\n").split("\n")
    cuts = [line[len(_CUT):] for line in lines if line.startswith(_CUT)]
    kept = [line for line in lines if not line.startswith((_CUT, "method "))]
    return kept, cuts, [line for line in lines if _METHOD.match(line)]


def _figures(network, methods, point):
    """Predicted error and times at one choice point; an empty dict where the planner has none."""
    plan = _patina.plan_material(network, methods, -1.0)
    return next((choice for choice in plan["choices"] if choice["point"] == point), {})


def _capped(lines):
    return lines[:MAX_LINES] + ([f"... and {len(lines) - MAX_LINES} more"] if len(lines) > MAX_LINES else [])


def build(network, methods, program_of, add):
    """
    :param program_of: methods -> the two texts of the material with them, as materials.build() makes them, and their lobes
    :param add: takes such texts and lobes into the page, returns their place among the programs
    :returns: dict for the page: kept and leftOut as lines, albedo, and for each choice point its methods
    """
    kept, cuts, taken = _text_of(network, methods)
    points = dict(_patina.choice_points())
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
    figures = _patina.method_figures(point, row["name"])
    if figures and figures["cost"] > MAX_COST:
        row["why"] = f"{figures['cost']:.0f} times the time of the default: too slow for a page"
        return room
    try:
        made, lobes = program_of(forced)
    except CommandError:
        row["why"] = "its shader is too large for a page"
        return room
    size = sum(len(made[key]["text"]) for key in ("lean", "whole") if made[key])
    if made == own:
        row["why"] = "the page's shader does the same for both"
    elif size > room:
        row["why"] = "the page has no room for its shader"
    else:
        row["program"] = add(made, lobes)
        return room - size
    return room
