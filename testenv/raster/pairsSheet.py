# SPDX-License-Identifier: Apache-2.0
"""Contact sheets of pairs: a row for each with the rasterizer's image, the path tracer's direct light and four times their
difference, labelled."""
import glob
import os
import sys

import numpy as np

from pairs import DIRECT
from patina.chart.png import display_bytes

LABEL = 26  # pixels of a label's height: two lines
GAP = 4
COLUMNS = 3  # pairs side by side


def check():
    """Ends in one line, before anything is rendered, where labels cannot be drawn."""
    try:
        import PIL  # noqa: F401
    except ImportError:
        sys.exit("--sheets needs Pillow: pip install pillow")


def labels(row):
    """:returns: the two lines that stand over a pair: its name, and what was measured or went wrong"""
    if "error" in row:
        return row["name"], row["error"]
    found = row["traced"][DIRECT]
    flip = "" if found["flip"] is None else f" FLIP {found['flip']:.3f}"
    return row["name"], f"bias {100 * found['bias']:+.1f} %{flip} block {100 * found['worst']:.0f} %"


def _paste(rows, path):
    from PIL import Image, ImageDraw

    images = [[] if "error" in row else [row["raster"], row["traced"][DIRECT]["image"],
                                         4 * np.abs(row["raster"] - row["traced"][DIRECT]["image"])] for row in rows]
    shapes = [image.shape for each in images for image in each] or [(64, 64)]
    height, width = max(s[0] for s in shapes), max(s[1] for s in shapes)
    cell = (3 * (width + GAP) + GAP, height + LABEL + GAP)
    lines = -(-len(rows) // COLUMNS)
    sheet = Image.new("RGB", (cell[0] * min(COLUMNS, len(rows)), cell[1] * lines), (38, 38, 38))
    draw = ImageDraw.Draw(sheet)
    for i, (row, each) in enumerate(zip(rows, images)):
        left, top = i % COLUMNS * cell[0], i // COLUMNS * cell[1]
        room = cell[0] // 6  # characters of Pillow's own font
        name, found = labels(row)
        draw.text((left + 2, top + 1), name[-room:], fill=(255, 255, 255))  # names differ at their ends
        draw.text((left + 2, top + 1 + LABEL // 2), found[:room], fill=(255, 255, 255))
        for k, image in enumerate(each):
            sheet.paste(Image.fromarray(display_bytes(image)), (left + k * (width + GAP), top + LABEL))
    sheet.save(path)
    return path


def write(rows, folder, number):
    """Writes sheet01.png and so on, and removes those of an earlier run.

    :param rows: of pairs.pair(), or with an `error`
    :param number: of pairs on a sheet
    :returns: list of paths"""
    for old in glob.glob(os.path.join(folder, "sheet*.png")):
        os.remove(old)
    return [_paste(rows[i:i + number], os.path.join(folder, f"sheet{i // number + 1:02d}.png"))
            for i in range(0, len(rows), number)]
