# SPDX-License-Identifier: Apache-2.0
"""Stages that benchmarks make for themselves: of a known size, the same for every renderer."""
import math
import os

import usda

CAMERA = usda.camera(lens=(35, 32, 24), clippingRange=(0.1, 1000), at=(0, 3, 9), rotateX=-18)


def _places(count, width):
    """:returns: so many places on a square grid, at some heights, and how many are in a row"""
    side = math.ceil(math.sqrt(count))
    return [((k % side / side - 0.5) * width, 0.3 + 0.4 * ((k * 7919) % 13) / 13.0, (k // side / side - 0.5) * width)
            for k in range(count)], side


def _rounded(points):
    return [tuple(float(f"{x:.5g}") for x in point) for point in points]


def _grid(name, cells, size, height, place=(0.0, 0.0, 0.0)):
    """A wavy cloth of cells x cells quads in the plane y = 0."""
    points = []
    for j in range(cells + 1):
        for i in range(cells + 1):
            x, z = (i / cells - 0.5) * size, (j / cells - 0.5) * size
            y = height * math.sin(3.1 * x) * math.cos(2.3 * z + x)
            points.append((x + place[0], y + place[1], z + place[2]))
    firsts = [j * (cells + 1) + i for j in range(cells) for i in range(cells)]
    return usda.mesh(name, _rounded(points), faces=[(k, k + cells + 1, k + cells + 2, k + 1) for k in firsts])


FLOOR = _grid("floor", 2, 40.0, 0.0)


def one_mesh(quads_a_side):
    """One mesh of twice as many triangles as the square of its size."""
    return usda.stage(CAMERA, _grid("cloth", quads_a_side, 12.0, 0.25))


def many_meshes(count):
    """As many meshes of 32 triangles each, over a floor."""
    places, side = _places(count, 10.0)
    return usda.stage(CAMERA, FLOOR, *(_grid(f"patch{k}", 4, 8.0 / side, 0.05, place) for k, place in enumerate(places)))


def instances(count):
    """As many instances of a mesh of 3200 triangles, without rotations, over a floor."""
    places, side = _places(count, 12.0)
    return usda.stage(CAMERA, FLOOR, usda.prim(
        "PointInstancer", "field", "rel prototypes = </field/leaf>", _grid("leaf", 40, 8.0 / side, 0.05),
        protoIndices=[0] * count, positions=_rounded(places)))


# name -> text of the stage
MADE = {
    "one mesh, 800k triangles": lambda: one_mesh(632),
    "5k meshes, 32 triangles each": lambda: many_meshes(5000),
    "5k instances of 3200 triangles": lambda: instances(5000),
}


def write_all(folder):
    """:returns: dict of name to path"""
    paths = {}
    for name, make in MADE.items():
        paths[name] = os.path.join(str(folder), name.replace(" ", "_").replace(",", "") + ".usda")
        with open(paths[name], "w", encoding="utf-8") as file:
            file.write(make())
    return paths
