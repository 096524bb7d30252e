# SPDX-License-Identifier: Apache-2.0
"""A sheet of what a benchmark compared: a row for each scene, a column for each renderer.

    ./patina bench path --images FOLDER
    ./patina python testenv/bench/peersSheet.py FOLDER sheet.png

The images are those that `--images` of `patina bench path` and `viewport` wrote: SCENE-RENDERER.exr. Needs Pillow.
"""
import argparse
import glob
import os
import sys

import numpy as np

if __name__ == "__main__":
    sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
    import checkout

    checkout.enter()

LABEL = 14  # pixels of a line of text
GAP = 4
GREY = (38, 38, 38)


def read(folder):
    """:returns: dict of scene to dict of renderer to bytes (height, width, 3)"""
    from patina.cli import compiled
    from patina.view import images

    found = {}
    for path in sorted(glob.glob(os.path.join(folder, "*.exr"))):
        scene, _, renderer = os.path.basename(path)[:-4].partition("-")
        linear = np.nan_to_num(compiled.load().read_image(path).pixels[..., :3])
        found.setdefault(scene, {})[renderer.replace("-", " ")] = (255 * images.display_values(linear) + 0.5).astype(np.uint8)
    return found


def sheet(found, order=("Patina", "path tracer", "rasterizer")):
    """:param order: renderers of the first columns; others follow by name
    :returns: a Pillow image"""
    from PIL import Image, ImageDraw

    names = {name for row in found.values() for name in row}
    columns = [name for name in order if name in names] + sorted(names.difference(order))
    height, width = np.max([image.shape[:2] for row in found.values() for image in row.values()], axis=0)
    page = Image.new("RGB", (len(columns) * (width + GAP) + GAP, len(found) * (height + LABEL + GAP) + GAP), GREY)
    draw = ImageDraw.Draw(page)
    for i, (scene, row) in enumerate(found.items()):
        for k, name in enumerate(columns):
            left, top = GAP + k * (width + GAP), i * (height + LABEL + GAP)
            draw.text((left, top + 1), f"{scene}, {name}" + ("" if name in row else ": none"), fill=(255, 255, 255))
            if name in row:
                page.paste(Image.fromarray(row[name]), (left, top + LABEL))
    return page


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="of the images")
    parser.add_argument("sheet", help="the image to write")
    parser.add_argument("--scale", type=float, default=1.0, help="of the images' size (default: 1)")
    options = parser.parse_args()
    try:
        import PIL  # noqa: F401
    except ImportError:
        parser.error("Pillow is not installed: pip install pillow")
    found = read(options.folder)
    if not found:
        parser.error(f"{options.folder} holds no .exr file")
    page = sheet(found)
    page.resize((round(page.width * options.scale), round(page.height * options.scale))).save(options.sheet)
    return 0


if __name__ == "__main__":
    sys.exit(main())
