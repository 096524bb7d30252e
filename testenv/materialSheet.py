# SPDX-License-Identifier: Apache-2.0
"""Renders every material of the MaterialX documents under a folder on a ball, as one sheet.

    ./patina python testenv/materialSheet.py FOLDER SHEET.png [--width 200] [--samples 64] [--columns 7]

Prints a table: material, seconds, warnings.
"""
import math
import os
import sys

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import checkout

    checkout.enter()

import contactSheet  # noqa: E402
import usda  # noqa: E402

SKY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes", "textures", "sky.exr")
STAGE = usda.stage(
    usda.camera(lens=(50, 24, 24), clippingRange=(0.01, 1000), at=(0, 1.9, 5), turn=(-10.5, 0, 0)),
    usda.prim("DomeLight", "sky", "asset inputs:texture:file = @%(sky)s@", intensity=0.7),
    usda.prim("RectLight", "key", intensity=20, width=2, height=2, at=(-2.5, 4, 3), turn=(-48, -42, 0)),
    usda.floor("ground", 8, bind="checker", st=[(0, 0), (8, 0), (8, 8), (0, 8)]),
    usda.prim("Mesh", "ball", 'normal3f[] normals = %(normals)s (interpolation = "vertex")',
              'texCoord2f[] primvars:st = %(uv)s (interpolation = "vertex")', bind="documents/Materials/%(material)s",
              faceVertexCounts="%(counts)s", faceVertexIndices="%(indices)s", points="%(points)s", subdivisionScheme="none",
              at=(0, 1, 0)),
    usda.prim("", "documents", meta=("prepend references = @%(document)s@</MaterialX>",)),
    usda.material("checker", {
        "pattern": ("ND_checkerboard_color3", {"color1": (0.45, 0.45, 0.45), "color2": (0.2, 0.2, 0.2)}),
        "diffuse": ("ND_oren_nayar_diffuse_bsdf", {"color3f color": "<pattern>"}),
        "surface": ("ND_surface", {"bsdf": "<diffuse>"})}))


def ball(columns=64, rows=32):
    """A sphere of radius 1 as u runs round it and v up it."""
    points, uv, counts, indices = [], [], [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i / columns, j / rows
            theta, phi = math.pi * (1 - v), 2 * math.pi * (u - 0.25)
            points.append((math.sin(theta) * math.sin(phi), math.cos(theta), math.sin(theta) * math.cos(phi)))
            uv.append((u, v))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            counts.append(4)
            indices += [a, a + 1, a + columns + 2, a + columns + 1]
    text = [tuple(round(x, 6) for x in p) for p in points]
    return {"points": text, "normals": text, "uv": uv, "counts": counts, "indices": indices}


def stage_of(document, material):
    """:returns: text of a stage that shows one material of a document"""
    return STAGE % {**ball(), "sky": SKY, "document": os.path.abspath(document), "material": material}


def materials(document):
    """:returns: names of the materials of a document"""
    import _patina

    return [network.path.rpartition(":")[2] for network in _patina.read_mtlx(document, [])]


def main():
    arguments = contactSheet.parser_of(__doc__, 200, 64, 7).parse_args()
    documents = sorted(os.path.join(root, name) for root, _, names in os.walk(arguments.folder) for name in names
                       if name.endswith(".mtlx"))
    found = [(document, name) for document in documents for name in materials(document)]

    def draw(material, folder):
        document, name = material
        stage = os.path.join(folder, "stage.usda")
        with open(stage, "w", encoding="utf-8") as file:
            file.write(stage_of(document, name))
        drawn = contactSheet.render(stage, folder, arguments.width, arguments.samples, arguments.record)
        path = os.path.relpath(document, arguments.folder)
        return drawn, f"{path}:{name}", name, path

    contactSheet.write(arguments, found, "materials", draw)
    return 0


if __name__ == "__main__":
    sys.exit(main())
