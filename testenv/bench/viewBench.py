# SPDX-License-Identifier: Apache-2.0
"""Pages of `patina view`: how large they are, how long they take to make, and how long a browser takes to their first picture
and to all 64 samples, in headless Chromium at 256 x 256 pixels. Chromium draws on the processor (Mesa, else SwiftShader);
most of the time until the first picture is the compiling of shaders.
"""
import os
import sys
import tempfile
import time

import benchRun
import browser
import inProcess
from patina import experiment
from patina.cli import outputs

# Name -> arguments of patina view.
PAGES = {
    "Cook-Torrance": [inProcess.scene("classic/hematite") + ":cookTorrance"],
    "UsdPreviewSurface": [inProcess.scene("shaderball") + ":coat"],
    "classic models": ["--demo", "classic"],
    "standard_surface": ["--demo", "layers"],
}
WAIT = """const begin = performance.now(); page.paused = true;
    viewer.invalidate(); viewer.settle(); viewer.accumulator.read(); return performance.now() - begin;"""


def _measure(chromium, name, arguments, folder):
    from patina.cli import main

    path = os.path.join(folder, name.replace(" ", "_") + ".html")
    begin = time.monotonic()
    if main.main(["view", *arguments, "-o", path]) != 0:
        return None
    made = time.monotonic() - begin
    chromium.open(path, "?width=256")
    # Reading back waits for what has only been asked of the driver.
    first = chromium.evaluate("while (!page.firstPicture) await new Promise(r => setTimeout(r, 5));"
                              "viewer.accumulator.read(); return performance.now();")
    return {"page": name, "megabytes": os.path.getsize(path) / 1e6, "secondsToMake": made,
            "secondsToFirstPicture": first / 1000.0, "secondsFor64Samples": chromium.evaluate(WAIT) / 1000.0}


def main(arguments):
    options = benchRun.Parser("view", __doc__).parse(arguments)
    if browser.missing():
        print("patina bench view: " + browser.missing(), file=sys.stderr)
        return 1
    chromium, rows = browser.Browser(), []
    try:
        with tempfile.TemporaryDirectory() as folder:
            for name, of_page in PAGES.items():
                rows.append(_measure(chromium, name, of_page, folder))
    finally:
        chromium.close()
    rows = [row for row in rows if row]
    print("\n".join(experiment.table(("page", "MB", "made in", "first picture after", "64 samples in"), [
        (row["page"], f"{row['megabytes']:.2f}", *(f"{row[name]:.1f} s" for name in (
            "secondsToMake", "secondsToFirstPicture", "secondsFor64Samples"))) for row in rows])))
    outputs.write_json(options.json, rows)
    return 0
