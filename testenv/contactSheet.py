# SPDX-License-Identifier: Apache-2.0
"""Renders every stage under a folder and pastes the images into one sheet: an image, or a page with a caption for each.

    ./patina python testenv/contactSheet.py FOLDER SHEET.png|SHEET.html [--width 240] [--samples 32] [--record FLAGS...]
    ./patina python testenv/contactSheet.py FOLDER SHEET.png --host usdrecord [--sceneIndex] [--gl]

With usdrecord as host the images come through Hydra, with as many samples as the delegate takes.
Prints a table: stage, seconds, warnings. Stages that fail are black tiles with a line that says why.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import checkout

    checkout.enter()

import numpy as np  # noqa: E402

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "hydra"))
HYDRA_TIMEOUT = 120
STAGES = (".usd", ".usda", ".usdc", ".usdz")


def find(folder):
    if os.path.isfile(folder):
        return [folder]
    return sorted(os.path.join(root, name) for root, _, names in os.walk(folder) for name in names
                  if name.lower().endswith(STAGES))


def render_hydra(stage, folder, width, scene_index, gl):
    """:returns: as render()"""
    import hydraBuild

    image = os.path.join(folder, "image.exr")
    if os.path.exists(image):
        os.remove(image)
    start = time.perf_counter()
    try:
        process = hydraBuild.run_usdrecord(stage, image, "--imageWidth", width, "--purposes", "render",
                                           scene_index=scene_index, check=False, gl=gl, timeout=HYDRA_TIMEOUT)
    except subprocess.TimeoutExpired:
        return None, time.perf_counter() - start, [], [f"no end after {HYDRA_TIMEOUT} s"]
    seconds = time.perf_counter() - start
    if process.returncode != 0 or not os.path.exists(image):
        return None, seconds, [], process.stderr.strip().splitlines()[-1:] or ["no message"]
    return read_color(image), seconds, hydraBuild.warnings_of(process), []


def render(stage, folder, width, samples, flags):
    """:returns: (pixels or None, seconds, list of warnings, error)"""
    image, out = os.path.join(folder, "image.exr"), os.path.join(folder, "out.json")
    for path in (image, out):
        if os.path.exists(path):
            os.remove(path)
    start = time.perf_counter()
    process = subprocess.run([sys.executable, "-m", "patina", "record", stage, image, "--imageWidth", str(width),
                              "--samples", str(samples), "--quiet", f"--json={out}", *flags],
                             capture_output=True, text=True)
    seconds = time.perf_counter() - start
    if process.returncode != 0:
        return None, seconds, [], process.stderr.strip().splitlines()[-1:] or ["no message"]
    with open(out, encoding="utf-8") as file:
        warnings = json.load(file)["warnings"]
    return read_color(image), seconds, warnings, []


def read_color(path):
    import _patina

    image = _patina.read_image(path)
    return np.asarray(image.pixels)[..., [image.channels.index(c) for c in "RGB"]]


def paste(images, width, columns):
    height = max([image.shape[0] for image in images if image is not None] or [width])
    rows = math.ceil(len(images) / columns)
    sheet = np.full((rows * (height + 4), columns * (width + 4), 3), 0.15, np.float32)
    for i, image in enumerate(images):
        y, x = i // columns * (height + 4), i % columns * (width + 4)
        tile = np.zeros((height, width, 3)) if image is None else image
        sheet[y:y + tile.shape[0], x:x + width] = tile[:height]
    return sheet


def page(path, title, shots):
    """Writes a page of pictures with captions.

    :param shots: list of (pixels or None, name, line below it)"""
    from html import escape

    from patina.chart import look, png

    style = "figure{width:min-content}figcaption{overflow-wrap:anywhere}img{display:block}"
    lines = [look.page(escape(title), style), f"<h1>{escape(title)}</h1>", '<div class="shots">']
    for pixels, name, below in shots:
        picture = "" if pixels is None else f'<img alt="{escape(name, quote=True)}" src="{png.data_uri(pixels)}">'
        lines.append(f"<figure>{picture}<figcaption><b>{escape(name)}</b><br>{escape(below)}</figcaption></figure>")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join([*lines, "</div>", look.END]))


def check(arguments, found, kind):
    """Ends in one line, before anything slow, where there is nothing to render or no place for the sheet."""
    import _patina

    if not found:
        sys.exit(f"{arguments.folder}: there are no {kind}")
    try:
        if not arguments.sheet.lower().endswith(".html"):
            _patina.check_image_path(arguments.sheet, ["color", "alpha"])
        _patina.check_output(arguments.sheet)
    except RuntimeError as error:
        sys.exit(str(error))


def parser_of(description, width, samples, columns):
    """:returns: a parser of what every sheet is told"""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("sheet")
    parser.add_argument("--width", type=int, default=width)
    parser.add_argument("--samples", type=int, default=samples)
    parser.add_argument("--columns", type=int, default=columns)
    parser.add_argument("--record", nargs=argparse.REMAINDER, default=[])
    return parser


def write(arguments, found, kind, draw):
    """Renders all subjects, tells how it goes, and writes the sheet.

    :param found: the subjects; `kind` is their plural
    :param draw: subject, folder -> what render() returns, name for the terminal, name on the sheet, words below it or None
    """
    check(arguments, found, kind)
    images, shots = [], []
    with tempfile.TemporaryDirectory() as folder:
        for subject in found:
            (pixels, seconds, warnings, error), name, title, below = draw(subject, folder)
            images.append(pixels)
            timed = f"{seconds:.2f} s" + (f", {len(warnings)} warnings" if warnings else "")
            shots.append((pixels, title, error[0] if error else below or timed))
            print(f"{len(images) - 1:4d} {seconds:7.2f} s  {name}  {'FAILED ' + error[0] if error else ''}", flush=True)
            for warning in warnings:
                print(f"              {warning}")
    import _patina

    if arguments.sheet.lower().endswith(".html"):
        page(arguments.sheet, os.path.basename(os.path.normpath(arguments.folder)), shots)
    else:
        _patina.write_image(arguments.sheet,
                            np.ascontiguousarray(paste(images, arguments.width, arguments.columns), np.float32))


def main():
    parser = parser_of(__doc__, 240, 32, 8)
    parser.add_argument("--host", choices=("patina", "usdrecord"), default="patina")
    parser.add_argument("--sceneIndex", action="store_true", help="scene indices, with usdrecord")
    parser.add_argument("--gl", action="store_true", help="with a GL context, with usdrecord")
    arguments = parser.parse_args()

    def draw(stage, folder):
        if arguments.host == "usdrecord":
            found = render_hydra(stage, folder, arguments.width, arguments.sceneIndex, arguments.gl)
        else:
            found = render(stage, folder, arguments.width, arguments.samples, arguments.record)
        name = os.path.relpath(stage, arguments.folder)
        return found, name, name, None

    write(arguments, list(find(arguments.folder)), "stages", draw)
    return 0


if __name__ == "__main__":
    sys.exit(main())
