# SPDX-License-Identifier: Apache-2.0
"""One stage by all ways: what came of each, whether they agree, and small pictures for the page."""
import functools
import json
import os
import sys
import tempfile

import numpy as np

import agreement
import peers
import watched
import ways

HERE = os.path.dirname(os.path.abspath(__file__))


def missing(row, names):
    """:param row: of an earlier run, or None
    :returns: which of these ways are still to be drawn"""
    if row is None:
        return names
    if row["listed"] or "read" in row["ways"]:
        return []
    left = [name for name in names if name not in row["ways"]]
    again = ["embree"] if set(left) & set(ways.COMPARED) and "embree" in names and "embree" not in left else []
    return again + left


def run(label, stage, options, part_of=None, row=None):
    """:param options: samples, size (width, height), limits of watched.run(), ways (names), pictures (a folder)
    :param part_of: another stage that composes this one, or None
    :param row: of an earlier run by other ways, which is completed
    :returns: a row of results: dict of `name`, `listed` (why the stage is not drawn by itself, or empty), `ways`, `pairs`,
        `peers` and `pictures`"""
    row = row or {"name": label, "stage": stage, "listed": "", "ways": {}, "pairs": {}, "pictures": {}}
    row["peers"] = peers.of(stage)
    with tempfile.TemporaryDirectory(prefix="patinaConformance") as folder:
        shot, ending = _prepared(stage, folder, options)
        if shot is None:
            if part_of and ending.word() == "message":
                row["listed"] = f"a part of {os.path.basename(part_of)}: {ending.reason()}"[:400]
            else:
                row["ways"]["read"] = ways.row_of(ending.word(), ending, ending.reason(), [])
            return row
        if not shot["shapes"]:
            row["listed"] = f"nothing to draw; a part of {os.path.basename(part_of)}" if part_of else "nothing to draw"
            return row
        _draw(row, shot, folder, options)
    return row


def _prepared(stage, folder, options):
    """:returns: (dict of prepare.py or None, the Ending)"""
    out = os.path.join(folder, "shot.json")
    ending = watched.run([sys.executable, os.path.join(HERE, "prepare.py"), stage, folder, *options["size"], out],
                         folder=folder, **options["limits"])
    if ending.word() != "ok":
        return None, ending
    with open(out, encoding="utf-8") as file:
        return json.load(file), ending


def _draw(row, shot, folder, options):
    def draw(name, seed):
        return ways.draw(ways.WAYS[name], shot, folder, options["samples"], seed, options["limits"])

    def again(name, seed):
        return draw(name, seed)[0]

    images = {}
    for name in options["ways"]:
        if not ways.WAYS[name].backend and shot["unreadable"]:
            row["ways"][name] = {"status": "listed", "message": shot["unreadable"], "warnings": []}
            continue
        images[name], row["ways"][name] = draw(name, agreement.FIRST_SEED)
        if images[name] is not None:
            row["pictures"][name] = _keep(images[name], row["name"], name, options["pictures"])
    for name in ways.COMPARED:
        if all(way in images and row["ways"][way]["status"] == "ok" for way in (name, "embree")):
            # UsdImagingDelegate makes coarse meshes of spheres, cubes and the like: more renders would only say so again.
            if name == "delegate" and "Implicit" in shot["shapes"] and agreement.is_coarse(images[name], images["embree"]):
                worst = agreement.at_once(images[name], images["embree"])
                row["pairs"][name] = {"word": "coarse", "worst": worst, "text": ""}
                continue
            row["pairs"][name] = agreement.decide(images[name], images["embree"], functools.partial(again, name),
                                                  functools.partial(again, "embree"))


def _keep(pixels, label, way, folder):
    """Writes a picture as a display shows it. :returns: its name in the folder"""
    import _patina

    name = f"{label.replace('/', '-')}.{way}.jpg"
    _patina.write_image(os.path.join(folder, name), np.ascontiguousarray(np.nan_to_num(pixels), np.float32))
    return name
