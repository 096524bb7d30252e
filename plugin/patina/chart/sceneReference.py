# SPDX-License-Identifier: Apache-2.0
"""References of a chart: path traced, of another seed and 16 times the samples; kept in the folder for the next time."""
import hashlib
import math
import os
from dataclasses import dataclass

import numpy as np

from patina.chart import machine
from patina.chart.sceneRenders import Render
from patina.cli import checkpoints, imageMetrics
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError

SAMPLES_FACTOR = 16  # of the most samples tested: a variance of a sixteenth or less
SEED_STEP = 7919     # far from the seeds of the ladder, which are next to each other
DIRECT = 1           # maxDepth of light that comes from lights alone


@dataclass
class Reference:
    image: np.ndarray
    words: str      # what it is
    samples: float  # 0: not known
    noise: float    # relMSE of its own noise, about; 0: not known
    seconds: float  # that it took; 0: it was there


def brought(path, renders):
    """A file of the user. :raises CommandError: where it cannot be one"""
    if not os.path.exists(path):
        raise CommandError(f"there is no file {path}")
    if not path.lower().endswith((".exr", ".hdr", ".pfm")):
        raise CommandError(f"{path}: a reference has linear values: .exr, .hdr or .pfm")
    found = _patina.read_image(path)
    chosen = [found.channels.index(c) for c in "RGB" if c in found.channels]
    if len(chosen) != 3:
        raise CommandError(f"{path} has no channels R, G and B")
    image = np.array(found.pixels, dtype=np.float32)[..., chosen]
    if image.shape[:2] != (renders.height, renders.width):
        raise CommandError(f"{path} is {image.shape[1]} x {image.shape[0]}, but the renders are {renders.width} x "
                           f"{renders.height} (--imageWidth)")
    if not _has_numbers(image):
        raise CommandError(f"{path} has no pixel that is a number")
    return Reference(image, f"brought: {os.path.basename(path)}", 0.0, 0.0, 0.0)


def made(renders, folder, samples, depth, methods):
    """Takes a reference from the folder, or renders it.

    :param depth: DIRECT, or None for all light
    :raises OutOfTime: where the stage's time is over before there is any
    """
    seed = renders.arguments.seed + SEED_STEP + (depth or 0)
    settings = renders.settings(samples, seed, 0.0, depth, methods)
    token = checkpoints.token(renders.stage, settings, [renders.info.camera, renders.arguments.set], "embree")
    path = os.path.join(folder, hashlib.sha256(token.encode()).hexdigest()[:24] + ".exr") if folder else ""
    light = "direct light only (maxDepth 1)" if depth else "all light"
    known = _read(path, samples, (renders.height, renders.width, 3))
    if known:
        return Reference(known.image, _words(light, known.samples, seed), known.samples, known.noise, 0.0)
    found = renders.render("embree", settings, partial=True)
    if path:
        _write(path, found, seed)
    return Reference(found.image, _words(light, found.samples, seed), found.samples, found.noise, found.wall)


def _words(light, samples, seed):
    return f"the path tracer, {light}, {samples:.0f} samples per pixel, seed {seed}"


def _has_numbers(image):
    return imageMetrics.finite_pixels(image, image).any()


def _read(path, samples, shape):
    """:returns: a Render, or None where the file is none that made() has written: it is rendered anew"""
    if not path or not os.path.exists(path):
        return None
    try:
        found = _patina.read_image(path)
        taken, noise = (float(found.metadata["patina:" + name]) for name in ("samples", "noise"))
        image = np.array(found.pixels, dtype=np.float32)[..., [found.channels.index(c) for c in "RGB"]]
    except (RuntimeError, KeyError, TypeError, ValueError):  # not ours, or broken off
        return None
    # Samples without end would be enough for ever.
    if image.shape != shape or not (math.isfinite(taken) and math.isfinite(noise)) or not _has_numbers(image):
        return None
    return Render(image, 0.0, 0.0, 0.0, taken, taken, noise) if taken >= samples else None


def _write(path, found, seed):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    _patina.write_image(path, found.image, ["R", "G", "B"], {},
                                {"patina:samples": found.samples, "patina:noise": found.noise, "patina:seed": seed,
                                 "patina:commit": machine.commit()})
