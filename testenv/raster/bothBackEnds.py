#!/usr/bin/env python3
"""Renders test scenes with both back ends and writes one HTML page: both images, their difference, numbers and times.

    bothBackEnds.py OUTPUT_FOLDER [SCENE...] [--samples N] [--width PIXELS] [--maxDepth N]

Without names all of testenv/scenes. The path tracer is stopped after direct light (maxDepth 1), which is what the
rasterizer draws; --maxDepth 16 shows what that leaves out.
"""
import argparse
import base64
import html
import os
import subprocess
import sys
import time

import numpy as np

SCENES = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scenes"))


def record(stage, image, *arguments):
    """:returns: seconds that the command took
    :raises RuntimeError: with the command's own words"""
    start = time.monotonic()
    process = subprocess.run([sys.executable, "-m", "patina", "record", stage, image, "--quiet", *arguments],
                             capture_output=True, text=True)
    if process.returncode != 0:
        raise RuntimeError(process.stderr.strip())
    return time.monotonic() - start


def without_opengl():
    """:returns: why the rasterizer cannot run here, or an empty text"""
    import _patina

    renderer = _patina.make_renderer("raster")
    if renderer.progress()["backend"] == "raster":
        return ""
    scene = _patina.Scene()
    renderer.start(scene, "/none", {}, _patina.Film())
    return scene.warnings()[0]["message"]


def pixels(image):
    """:returns: linear float array (height, width, 3)"""
    import _patina

    found = _patina.read_image(str(image))
    return np.array(found.pixels)[..., [found.channels.index(c) for c in "RGB"]]


def numbers(raster, traced):
    """:returns: a dict: `bias` of the mean, `relMSE`, and `worst`, the largest relative difference of a block of 8x8
    pixels, which noise does not reach"""
    bias = float((raster.mean() - traced.mean()) / max(traced.mean(), 1e-9))
    rel = float(np.mean((raster - traced) ** 2 / (traced ** 2 + 0.01)))
    h, w = (n // 8 * 8 for n in raster.shape[:2])

    def blocks(image):
        return image[:h, :w].reshape(h // 8, 8, w // 8, 8, 3).mean(axis=(1, 3, 4))

    a, b = blocks(raster), blocks(traced)
    worst = float(np.max(np.abs(a - b) / (b + 0.05 * max(traced.mean(), 1e-9))))
    return {"bias": bias, "relMSE": rel, "worst": worst}


def flip(raster, traced):
    """:returns: mean FLIP of two linear images, or None where flip-evaluator is not installed"""
    try:
        import flip_evaluator
    except ImportError:
        return None
    _, mean, _ = flip_evaluator.evaluate(traced.astype(np.float32), raster.astype(np.float32), "HDR")
    return float(mean)


def pair(name, folder, samples, width, depth):
    """Renders one scene both ways.
    :returns: the row of the page: a dict with `raster`, `traced` (arrays), seconds and numbers"""
    stage = os.path.join(SCENES, name + ".usda")
    row = {"name": name, "command": f"testenv/raster/bothBackEnds.py OUTPUT {name} --samples {samples} --width {width}"}
    for backend, extra in (("raster", []), ("embree", ["--maxDepth", str(depth)])):
        image = os.path.join(folder, f"{name}.{backend}.exr")
        row[backend + "Seconds"] = record(stage, image, "--backend", backend, "--samples", str(samples), "-w",
                                          str(width), *extra)
        row[backend] = pixels(image)
    row.update(numbers(row["raster"], row["embree"]))
    row["flip"] = flip(row["raster"], row["embree"])
    return row


def _png(array, folder):
    """:returns: an <img> of linear values, shown as sRGB"""
    import _patina  # noqa: F401  (the same module that wrote the images)
    import struct
    import zlib

    v = np.clip(array, 0, 1)
    v = np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)
    data = (v * 255 + 0.5).astype(np.uint8)
    h, w = data.shape[:2]
    raw = b"".join(b"\0" + data[y].tobytes() for y in range(h))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", w, h, 8, 2, 0, 0, 0))
           + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))
    return f'<img src="data:image/png;base64,{base64.b64encode(png).decode()}">'


def page(rows, folder):
    """Writes index.html into the folder. :returns: its path"""
    lines = ["<!doctype html><meta charset=utf-8><title>Both back ends</title>",
             "<style>body{font:14px sans-serif}td{padding:4px 8px;vertical-align:top}</style>",
             "<h1>Rasterizer, path tracer (direct light), difference x 4</h1><table>"]
    for row in rows:
        if "error" in row:
            lines.append(f"<tr><td>{html.escape(row['name'])}<td colspan=3>{html.escape(row['error'])}")
            continue
        flip_text = "not measured" if row["flip"] is None else f"{row['flip']:.4f}"
        lines.append(f"<tr><td><b>{html.escape(row['name'])}</b><br>bias {100 * row['bias']:+.2f} %<br>relMSE "
                     f"{row['relMSE']:.2e}<br>FLIP {flip_text}<br>worst block {100 * row['worst']:.0f} %<br>"
                     f"{row['rasterSeconds']:.1f} s, {row['embreeSeconds']:.1f} s<br><code>"
                     f"{html.escape(row['command'])}</code>"
                     f"<td>{_png(row['raster'], folder)}<td>{_png(row['embree'], folder)}"
                     f"<td>{_png(4 * np.abs(row['raster'] - row['embree']), folder)}")
    lines.append("</table>")
    path = os.path.join(folder, "index.html")
    with open(path, "w", encoding="utf-8") as out:
        out.write("\n".join(lines))
    return path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--width", type=int, default=320)
    parser.add_argument("--maxDepth", type=int, default=1)
    a = parser.parse_args()
    os.makedirs(a.folder, exist_ok=True)
    names = a.scenes or sorted(f[:-5] for f in os.listdir(SCENES) if f.endswith(".usda"))
    rows = []
    for name in names:
        try:
            row = pair(name, a.folder, a.samples, a.width, a.maxDepth)
            print(f"{name:22} bias {100 * row['bias']:+7.2f} %  relMSE {row['relMSE']:.2e}  FLIP "
                  f"{row['flip'] if row['flip'] is None else round(row['flip'], 4)}  worst block "
                  f"{100 * row['worst']:.0f} %  {row['rasterSeconds']:.1f} s, {row['embreeSeconds']:.1f} s", flush=True)
        except RuntimeError as error:
            row = {"name": name, "error": str(error)}
            print(f"{name:22} {error}", flush=True)
        rows.append(row)
    print(page(rows, a.folder))


if __name__ == "__main__":
    main()
