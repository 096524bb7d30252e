# SPDX-License-Identifier: Apache-2.0
"""Stages that benchmarks make for themselves: of a known size, the same for every renderer."""
import math
import os

HEAD = """#usda 1.0
(
    upAxis = "Y"
)
def Camera "camera"
{
    float2 clippingRange = (0.1, 1000)
    float focalLength = 35
    float horizontalAperture = 32
    float verticalAperture = 24
    double3 xformOp:translate = (0, 3, 9)
    float xformOp:rotateX = -18
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
"""


def _list(values):
    return "[" + ", ".join(values) + "]"


def _grid(name, columns, rows, width, depth, height, place=(0.0, 0.0, 0.0)):
    """A mesh of quads: a wavy cloth in the plane y = 0. :returns: its text"""
    points = []
    for j in range(rows + 1):
        for i in range(columns + 1):
            x, z = (i / columns - 0.5) * width, (j / rows - 0.5) * depth
            y = height * math.sin(3.1 * x) * math.cos(2.3 * z + x)
            points.append(f"({x + place[0]:.5g}, {y + place[1]:.5g}, {z + place[2]:.5g})")
    step = columns + 1
    faces = [f"{j * step + i}, {j * step + i + step}, {j * step + i + step + 1}, {j * step + i + 1}"
             for j in range(rows) for i in range(columns)]
    return f"""def Mesh "{name}"
{{
    int[] faceVertexCounts = {_list(["4"] * (columns * rows))}
    int[] faceVertexIndices = {_list(faces)}
    point3f[] points = {_list(points)}
    uniform token subdivisionScheme = "none"
}}
"""


def one_mesh(quads_a_side):
    """One mesh of twice as many triangles as the square of its size."""
    return HEAD + _grid("cloth", quads_a_side, quads_a_side, 12.0, 12.0, 0.25)


def many_meshes(count):
    """As many meshes of 32 triangles each, over a floor."""
    side = math.ceil(math.sqrt(count))
    text = HEAD + _grid("floor", 2, 2, 40.0, 40.0, 0.0)
    for k in range(count):
        place = ((k % side / side - 0.5) * 10.0, 0.3 + 0.4 * ((k * 7919) % 13) / 13.0, (k // side / side - 0.5) * 10.0)
        text += _grid(f"patch{k}", 4, 4, 8.0 / side, 8.0 / side, 0.05, place)
    return text


def instances(count):
    """As many instances of a mesh of 3200 triangles, without rotations, over a floor."""
    side = math.ceil(math.sqrt(count))
    places = [f"({(k % side / side - 0.5) * 12.0:.5g}, {0.3 + 0.4 * ((k * 7919) % 13) / 13.0:.5g}, "
              f"{(k // side / side - 0.5) * 12.0:.5g})" for k in range(count)]
    prototype = _grid("leaf", 40, 40, 8.0 / side, 8.0 / side, 0.05)
    return HEAD + _grid("floor", 2, 2, 40.0, 40.0, 0.0) + f"""def PointInstancer "field"
{{
    int[] protoIndices = {_list(["0"] * count)}
    point3f[] positions = {_list(places)}
    rel prototypes = </field/leaf>
    {prototype}
}}
"""


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
