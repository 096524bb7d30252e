# SPDX-License-Identifier: Apache-2.0
"""A floor with a block on it under lights of one's own: text of stages."""
import os

import numpy as np

import usda

FLOOR = usda.floor("floor", 3, color=(0.6, 0.6, 0.6))
BLOCK = usda.prim("Cube", "block", size=0.8, at=(0.5, 0.4, 0), color=(0.6, 0.3, 0.2))


def world(*prims):
    """A world that a camera looks down on. :returns: the text of the stage"""
    camera = usda.camera(lens=(24, 20.955, 20.955), clippingRange=(0.01, 1000),
                         matrix=((1, 0, 0, 0), (0, 0.6, -0.8, 0), (0, 0.8, 0.6, 0), (0, 5.6, 4.2, 1)))
    return usda.stage(usda.prim("Xform", "World", camera, *prims), defaultPrim="World", metersPerUnit=1)


STAGE = world(FLOOR, BLOCK, "%s")

PROFILE = """IESNA:LM-63-1995
TILT=NONE
1 1000 1 5 5 1 1 0 0 0
1.0 1.0 100
0 20 40 60 90
0 90 180 270 360
1000 900 500 100 0
1000 600 200 50 0
1000 300 100 20 0
1000 600 400 50 0
1000 900 500 100 0
"""

ASIDE = {"at": (-2.2, 3.5, 2.5), "turn": (-50, -40, 0)}


def light(kind, *lines, name="light", place=ASIDE, **inputs):
    return usda.prim(kind, name, *lines, **inputs, **place)


def write(folder, stage, name="stage", dim=(0.1, 0.2, 1.0), bright=(20.0, 10.0, 2.0)):
    """Writes the text of a stage beside `lamp.ies` and `image.exr`, which lights may use.

    :param dim: colour of nearly half of the image; others are black
    :param bright: of few of its texels, which give nearly all of its light
    :returns: its path"""
    import _patina

    path = os.path.join(str(folder), name + ".usda")
    for file, text in ((path, stage), (os.path.join(str(folder), "lamp.ies"), PROFILE)):
        with open(file, "w", encoding="utf-8") as out:
            out.write(text)
    values = np.zeros((8, 8, 3), np.float32)
    values[:, :3] = dim
    values[2:4, 5:7] = bright
    _patina.write_image(os.path.join(str(folder), "image.exr"), values, ["R", "G", "B"])
    return path
