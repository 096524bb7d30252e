# SPDX-License-Identifier: Apache-2.0
"""One HTML page of scenes by both back ends: a table of numbers, then the images and their difference."""
import html
import os

import numpy as np

from pairs import DIRECT, WHOLE
from patina.chart import look, png

STYLE = """td{text-align:left}td.n{text-align:right}img{image-rendering:pixelated;width:min(288px,19vw)}
td:first-child{max-width:22em}"""


def picture(array, alt=""):
    """:returns: an <img> of linear values, shown as sRGB"""
    return f'<img alt="{html.escape(alt, quote=True)}" src="{png.data_uri(array)}">'


def flip_text(value):
    return "-" if value is None else f"{value:.4f}"


def _table(rows, remarks):
    lines = ["<table><tr><th>scene<th>raster s<th>direct light: s<th>RMSE<th>FLIP<th>bias<th>all light: s<th>RMSE<th>FLIP"
             "<th>bias<th>remark"]
    for row in rows:
        if "error" in row:
            lines.append(f"<tr><td>{html.escape(row['name'])}<td colspan=10 class=bad>{html.escape(row['error'])}")
            continue
        cells = [f"<td>{html.escape(row['name'])}<td class=n>{row['rasterSeconds']:.1f}"]
        for depth in (DIRECT, WHOLE):
            t = row["traced"].get(depth)
            cells.append("<td><td><td><td>" if t is None else
                         f"<td class=n>{t['seconds']:.1f}<td class=n>{t['rmse']:.4f}<td class=n>{flip_text(t['flip'])}"
                         f"<td class=n>{100 * t['bias']:+.2f} %")
        lines.append("<tr>" + "".join(cells) + f"<td>{html.escape(remarks.get(row['name'], ''))}")
    return "\n".join(lines) + "</table>"


def write(rows, folder, title, remarks=None):
    """Writes index.html into the folder. :returns: its path"""
    lines = [look.page("Patina: both back ends", STYLE), f"<h1>{html.escape(title)}</h1>", _table(rows, remarks or {}),
             "<h2>Rasterizer; path tracer, direct light; all light; difference from direct light x 4</h2><table>"]
    for row in rows:
        if "error" in row:
            continue
        images = [t["image"] for t in row["traced"].values()]
        lines.append(f"<tr><td><b>{html.escape(row['name'])}</b><br><code>{html.escape(row['command'])}</code><td>"
                     + "<td>".join(picture(i, f"{row['name']}, {what}") for i, what in zip(
                         [row["raster"], *images, 4 * np.abs(row["raster"] - images[0])],
                         ["rasterizer", *["path tracer"] * len(images), "difference"])))
    lines.append("</table>" + look.END)
    path = os.path.join(folder, "index.html")
    with open(path, "w", encoding="utf-8") as out:
        out.write("\n".join(lines))
    return path
