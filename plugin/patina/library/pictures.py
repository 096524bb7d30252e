# SPDX-License-Identifier: Apache-2.0
"""Pictures of the library's materials: a ball or a lock of hair in the studio of the material page."""
import math
import random

import numpy as np

from patina.cli.compiled import _patina
from patina.library import catalog
from patina.view import images, reference, shapes, surroundings

BACK_ENDS = (("embree", "path tracer"), ("raster", "rasterizer"))
STRANDS = 700
STRAND_RADIUS = 0.012
_ABOUT = np.eye(4).ravel()


def lock(seed=1):
    """Draws a lock of hair that hangs over a half cylinder.

    :param seed: of the places and waves of its strands
    :returns: function of a scene's edit"""
    r = random.Random(seed)
    points = []
    for _ in range(STRANDS):
        angle, layer = r.uniform(-1.5, 1.5), r.uniform(0.0, 0.25)
        phase, wave = r.uniform(0.0, 2.0 * math.pi), r.uniform(0.0, 0.03)
        for i in range(8):
            down = i / 7.0
            bend = angle + wave * math.sin(5.0 * down + phase)
            out = 0.62 + layer + 0.12 * math.sin(math.pi * down)
            points.append((out * math.sin(bend), 1.05 - 2.1 * down, out * math.cos(bend) - 0.3))

    def draw(edit):
        edit.set_curves("/shape", points=np.asarray(points, np.float32), curve_vertex_counts=np.full(STRANDS, 8, np.int32),
                        basis="catmullRom", wrap="pinned", material="/material",
                        primvars=[("widths", "constant", np.full(1, 2.0 * STRAND_RADIUS, np.float32))])
    return draw


def render(entry, width, samples):
    """:param width: pixels of a side
    :returns: list of (back end in words, linear picture), and a list of warnings"""
    warnings = []
    network = _patina.read_mtlx(entry.path, warnings)[0]
    shape = lock() if entry.group in catalog.STRANDS else shapes.built_in()[0][1]
    studio = surroundings.environments([], [], 1024, False)[0]
    environment = {**studio, "pixels": images.unpacked(studio)}
    camera, eye = surroundings.camera(1.0, np.zeros(3), False)
    return [(words, reference.render(network, shape, _ABOUT, environment, camera, eye, width, samples, backend))
            for backend, words in BACK_ENDS], warnings
