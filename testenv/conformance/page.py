# SPDX-License-Identifier: Apache-2.0
"""One HTML page of a conformance run: counts, a table of all stages, and pictures beside those of other renderers."""
import base64
import html
import os

import numpy as np

import conformanceResults
import ways
from patina.chart import look

WIDTH = 160  # pixels of a peer's picture
STYLE = """td:first-child{min-width:18em;max-width:24em}figure{width:min-content}img{display:block}td,th{text-align:left}
td:first-child,figcaption{overflow-wrap:anywhere}
td.n{text-align:right}section{border-top:1px solid var(--line);margin-top:18px}"""
ORDER = ("crash", "timeout", "memory", "NaN", "message", "differs", "failed", "undecided", "coarse", "agrees", "same", "ok")


def write(rows, folder):
    """Writes index.html into the folder, which has the run's pictures. :returns: its path"""
    rows = sorted(rows, key=_rank)
    lines = [look.page("Patina: conformance", STYLE), "<h1>Conformance</h1>",
             *(f"<p>{html.escape(line)}</p>" for line in conformanceResults.table(rows)), "<h2>Stages</h2>", *_table(rows),
             "<h2>Pictures</h2>", "<p>Ours first, then those of other renderers that lie beside the stage.</p>"]
    for row in rows:
        if row["pictures"]:
            lines += _section(row, folder)
    path = os.path.join(folder, "index.html")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join([*lines, look.END]))
    return path


def _words(row):
    return [way["status"] for way in row["ways"].values()] + [pair["word"] for pair in row["pairs"].values()]


def _rank(row):
    """The worst first, what is only listed last."""
    known = [ORDER.index(word) for word in _words(row) if word in ORDER]
    return min(known) if known else len(ORDER), row["name"]


def _table(rows):
    lines = [look.WIDE + "<table><tr><th>stage" + "".join(f"<th>{way.title}" for way in ways.WAYS.values())
             + "<th>delegate's way<th>scene indices<th>what is told"]
    for row in rows:
        name = html.escape(row["name"])
        link = f'<a href="#{name}">{name}</a>' if row["pictures"] else name
        told = [row["listed"], *(f"{way}: {found['message']}" for way, found in row["ways"].items() if found["message"]),
                *(f"{way}: {pair['text']}" for way, pair in row["pairs"].items() if pair["text"])]
        lines.append(f"<tr><td>{link}" + "".join(f"<td>{_status(row['ways'].get(way))}" for way in ways.WAYS)
                     + "".join(f"<td>{_word(row['pairs'].get(way))}" for way in ways.COMPARED)
                     + "<td>" + "<br>".join(html.escape(text) for text in told if text))
    return [*lines, "</table></div>"]


def _status(way):
    if way is None:
        return ""
    bad = "" if way["status"] in ("ok", "listed") else " class=bad"
    cost = f" {way['seconds']:.1f} s, {way['memory']} MB" if "seconds" in way else ""
    warned = f", {len(way['warnings'])} warnings" if way["warnings"] else ""
    return f"<span{bad}>{way['status']}</span>{cost}{warned}"


def _word(pair):
    if pair is None:
        return ""
    bad = " class=bad" if pair["word"] in ("differs", "failed") else ""
    worst = " " + conformanceResults.percent(pair["worst"]) if pair["worst"] > 0 else ""
    return f"<span{bad}>{pair['word']}</span>{worst}"


def _section(row, folder):
    name = html.escape(row["name"])
    lines = [f'<section id="{name}"><h3>{name}</h3><div class="shots">']
    for way, file in row["pictures"].items():
        with open(os.path.join(folder, "pictures", file), "rb") as picture:
            lines.append(_figure(picture.read(), "jpeg", f"{row['name']}, {ways.WAYS[way].title}", ways.WAYS[way].title))
    for path in row["peers"]:
        data = peer(path)
        if data:
            title = os.path.join(*path.split(os.sep)[-2:])
            lines.append(_figure(data, "png", f"{row['name']}, another renderer", title))
    warned = {text for way in row["ways"].values() for text in way["warnings"]}
    return [*lines, "</div>", *(f"<p class=dim>{html.escape(text)}</p>" for text in sorted(warned)[:8]), "</section>"]


def _figure(data, kind, alt, title):
    text = base64.b64encode(data).decode()
    return (f'<figure><img alt="{html.escape(alt, quote=True)}" src="data:image/{kind};base64,{text}">'
            f"<figcaption>{html.escape(title)}</figcaption></figure>")


def peer(path):
    """:returns: the bytes of a PNG, made as small as ours; None where it cannot be read"""
    import _patina
    from patina.chart import png

    try:
        image = _patina.read_image(path)
    except RuntimeError:
        return None
    pixels = np.asarray(image.pixels, np.float32)
    pixels = pixels[..., :3] if pixels.shape[2] >= 3 else np.repeat(pixels[..., :1], 3, axis=2)
    if not path.lower().endswith(".exr"):  # other files hold what a display shows
        pixels = np.where(pixels <= 0.04045, pixels / 12.92, ((np.maximum(pixels, 0.0) + 0.055) / 1.055) ** 2.4)
    step = max(1, -(-pixels.shape[1] // WIDTH))
    height, width = (size // step * step for size in pixels.shape[:2])
    small = pixels[:height, :width].reshape(height // step, step, width // step, step, 3).mean(axis=(1, 3))
    return png.encode(small)
