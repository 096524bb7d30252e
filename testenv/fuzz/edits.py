# SPDX-License-Identifier: Apache-2.0
"""Random edits while an image is rendered: one random stage after another takes the place of what is shown, prims appear,
change and vanish, and the render is started, stopped and left alone in between."""
import os
import random as randoms
import sys
import time

import outcomes
import randomStages
from usda import camera, prim, stage

EXTENSION = ".json"
LINES = True  # one step a line


def make(seed):
    """:returns: the bytes of an input: steps as JSON, one on a line"""
    r = randoms.Random(seed)
    current, steps = [], []
    writer = randomStages._Writer(seed)
    for _ in range(r.randint(3, 8)):
        for _ in range(r.randint(1, 3)):
            if current and r.random() < 0.5:
                current.pop(r.randrange(len(current)))
            else:
                current.append("\n".join(writer.prim()))
        steps.append({"stage": "\n".join(current), "clear": r.random() < 0.5, "stop": r.random() < 0.2,
                      "wait": r.choice((0, 0, 0.005, 0.03)), "width": r.choice((8, 8, 16, 1)), "seed": r.randint(0, 3)})
    return outcomes.in_lines(steps)


HEAD = stage(camera(at=(0, 0, 6)), prim("DomeLight", "dome"), prim("Material", "material"), up="")


def execute(path, folder):
    """Makes the edits, in a process that may die. :returns: the exit status"""
    steps = outcomes.from_lines(path)
    if not steps:
        return 0
    import numpy as np
    from pxr import Sdf, Usd

    import _patina
    from patina import stage as reader

    os.chdir(folder)
    outcomes.tell_swallowed()
    scene, renderer = _patina.Scene(), _patina.make_renderer("embree")
    film = _patina.Film()
    for step in steps:
        layer = Sdf.Layer.CreateAnonymous("edit.usda")
        if not layer.ImportFromString(HEAD + step["stage"]):
            return outcomes.broken("a step is no layer: the generator is wrong")
        with scene.edit() as edit:
            if step["clear"]:
                edit.clear()
            reader.read_stage(Usd.Stage.Open(layer), edit, reader.StageOptions(frame=0.0, camera="/camera"))
        if step["stop"]:
            renderer.stop()
        # The one before goes on meanwhile: a host never waits.
        renderer.start(scene, "/camera", {"width": step["width"], "height": 8, "samples": 2, "maxDepth": 3, "threads": 2,
                                          "seed": step["seed"]}, film)
        time.sleep(step["wait"])
    renderer.wait()
    outcomes.tell_memory(scene.warnings())
    if renderer.progress()["failed"]:
        print("patina: " + renderer.progress()["error"], file=sys.stderr)
        return 1
    if not np.isfinite(np.array(film.resolve("color"))).all():
        return outcomes.broken("the image holds values that are no numbers")
    return 0
