# SPDX-License-Identifier: Apache-2.0
"""One scene through both back ends, and the numbers of the pair."""
import json
import os
import sys
import time

import numpy as np

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

import everyAsset  # noqa: E402
import inProcess  # noqa: E402
from inProcess import needs_opengl, pixels  # noqa: E402, F401
from patina.cli import imageMetrics  # noqa: E402

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
SCENES = os.path.join(ROOT, "testenv", "scenes")
DIRECT, WHOLE = 1, 16  # longest paths of the path tracer: what the rasterizer draws, and what there is
TRACED_SEED = 7        # the back ends share no random numbers
TRUTH_SEED = 991


def names():
    """:returns: every test scene, as paths below testenv/scenes without suffix"""
    found = []
    for folder, _, files in os.walk(SCENES):
        for file in files:
            if file.endswith(".usda") and os.path.exists(os.path.join(folder, file)):
                found.append(os.path.relpath(os.path.join(folder, file[:-5]), SCENES).replace(os.sep, "/"))
    return sorted(found)


def stage_path(name, folder):
    """:param name: of a test scene, or one of everyAsset.names()
    :param folder: where the stage of a document's material is written"""
    if name.startswith(everyAsset.PREFIX):
        return everyAsset.path(name, folder)
    return os.path.join(SCENES, *name.split("/")) + ".usda"


def record(stage, image, *arguments):
    """:returns: seconds that the command took
    :raises RuntimeError: with the command's own words"""
    start = time.monotonic()
    process = inProcess.record(stage, image, *arguments, check=False)
    if process.returncode != 0:
        raise RuntimeError(process.stderr.strip())
    return time.monotonic() - start


def numbers(raster, traced):
    """:returns: a dict: `bias` of the mean, `rmse`, `relMSE`, `flip` (None where it cannot be measured), and `worst`, the
    largest relative difference of a block of 8x8 pixels, which noise hardly reaches
    :raises RuntimeError: where an image holds NaN or Inf"""
    for image, made in ((raster, "rasterizer"), (traced, "path tracer")):
        if not np.isfinite(image).all():
            raise RuntimeError(f"the image of the {made} has {np.sum(~np.isfinite(image))} values that are no numbers")
    found = imageMetrics.differences(raster, traced)
    h, w = (n // 8 * 8 for n in raster.shape[:2])

    def blocks(image):
        return image[:h, :w].reshape(h // 8, 8, w // 8, 8, 3).mean(axis=(1, 3, 4))

    a, b = blocks(raster), blocks(traced)
    return {"bias": found["relativeMeanError"] or 0.0, "rmse": found["rmse"], "relMSE": found["relMSE"],
            "flip": imageMetrics.mean_flip(raster, traced, True),
            "worst": float(np.max(np.abs(a - b) / (b + 0.05 * max(traced.mean(), 1e-9))))}


def command(name, samples, width):
    return f"./patina python testenv/raster/bothBackEnds.py OUTPUT {name} --samples {samples} --width {width}"


def pair(name, folder, samples, width, depths=(DIRECT, WHOLE), seed=0):
    """Renders one scene by the rasterizer once, and by the path tracer once per length of paths.

    :param seed: of the rasterizer
    :returns: a dict: `name`, `command`, `raster` (array), `rasterSeconds`, and `traced`: depth -> dict of `image`,
        `seconds` and numbers()
    :raises RuntimeError: with the words of the command that failed"""
    stage = stage_path(name, folder)
    flat = everyAsset.flat(name)

    def render(backend, *extra):
        image = os.path.join(folder, f"{flat}.{backend}{''.join(extra[1::2])}.exr")
        seconds = record(stage, image, "--backend", backend, "--samples", str(samples), "-w", str(width), *extra)
        return pixels(image), seconds

    row = {"name": name, "command": command(name, samples, width), "settings": [samples, width, seed],
           "build": inProcess.build(), "traced": {}}
    row["raster"], row["rasterSeconds"] = render("raster", "--seed", str(seed))
    for depth in depths:
        image, seconds = render("embree", "--maxDepth", str(depth), "--seed", str(TRACED_SEED))
        row["traced"][depth] = {"image": image, "seconds": seconds, **numbers(row["raster"], image)}
    return row


def beside_truth(row, truth, samples):
    """How far both back ends' direct light is from nearly converged pixels, which tells their noise from a difference.

    :param row: of pair()
    :param truth: array of `samples` path traced samples, see truth_of()
    :returns: a dict: `samples`, and FLIP of the `raster` and of the `traced` image of the row"""
    images = {"raster": row["raster"], "traced": row["traced"][DIRECT]["image"]}
    return {"samples": samples, **{name: imageMetrics.mean_flip(image, truth, True) for name, image in images.items()}}


def truth_of(name, folder, samples, width):
    """:returns: direct light by so many path traced samples, with a seed of its own"""
    image = os.path.join(folder, f"{everyAsset.flat(name)}.truth{samples}.exr")
    record(stage_path(name, folder), image, "--backend", "embree", "--samples", str(samples),
           "-w", str(width), "--maxDepth", str(DIRECT), "--seed", str(TRUTH_SEED))
    return pixels(image)


def keep(row, folder):
    """Writes a row of pair() beside its images, for kept()."""
    light = {key: value for key, value in row.items() if key not in ("raster", "traced")}
    light["traced"] = {depth: {key: value for key, value in found.items() if key != "image"}
                       for depth, found in row["traced"].items()}
    with open(os.path.join(folder, everyAsset.flat(row["name"]) + ".json"), "w", encoding="utf-8") as out:
        json.dump(light, out, indent=1)


def of_this_build(row):
    return row.get("build") == inProcess.build()


def kept(name, folder, samples, width, seed=0):
    """:returns: the row of an earlier run into the folder with the same settings, or None"""
    flat = everyAsset.flat(name)
    try:
        with open(os.path.join(folder, flat + ".json"), encoding="utf-8") as file:
            row = json.load(file)
        if row["settings"] != [samples, width, seed]:
            return None
        row["raster"] = pixels(os.path.join(folder, f"{flat}.raster{seed}.exr"))
        row["traced"] = {int(depth): {**found, "image": pixels(os.path.join(folder, f"{flat}.embree{depth}{TRACED_SEED}.exr"))}
                         for depth, found in row["traced"].items()}
    except (OSError, RuntimeError, ValueError, KeyError):  # half written, or of another version
        return None
    return row
