# SPDX-License-Identifier: Apache-2.0
"""Renders of a stage, what is kept of them, and whether new ones are of the same picture."""
import contextlib
import dataclasses
import hashlib
import io
import json
import math
import os
import tempfile

import numpy as np

from patina import __version__
from patina.cli import main, outputs
from patina.cli.compiled import _patina
from patina.regression import welch

FIRST_SEED, OTHER_SEEDS = 1, 100001  # golden renders and new ones share no random numbers
MOST = 0.9  # share of the tiles that are noisy at all in which a test has to see what it is there for
DEFAULT_SAMPLES = 64  # of `patina record`


class RenderError(Exception):
    """A stage could not be rendered; the text is the command's own."""


def render(stage, seed, arguments):
    """:param arguments: of `patina record`
    :returns: linear colour, float32 array (height, width, 3)
    :raises RenderError: where the command fails, or the image has values that are no numbers"""
    said = io.StringIO()
    with tempfile.TemporaryDirectory(prefix="patina-") as folder:
        image = os.path.join(folder, "image.exr")
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
            status = main.main(["record", stage, image, "--seed", str(seed), "--quiet", *arguments])
        if status != 0 or not os.path.exists(image):
            raise RenderError(said.getvalue().strip() or f"patina record ended with {status}")
        return checked_color(image)


def checked_color(path):
    """:returns: as color_of()
    :raises RenderError: where the image has values that are no numbers"""
    pixels = color_of(path)
    bad = int((~np.isfinite(pixels)).sum())
    if bad:
        raise RenderError(f"the image has {bad} values that are no numbers")
    return pixels


def color_of(path):
    """:returns: linear colour of an OpenEXR file, float32 array (height, width, 3)"""
    found = _patina.read_image(path)
    return np.array(found.pixels)[..., [found.channels.index(c) for c in "RGB"]].astype(np.float32)


def digest(pixels):
    return hashlib.sha256(np.ascontiguousarray(pixels, np.float32).tobytes()).hexdigest()


@dataclasses.dataclass
class Golden:
    """The kept values: tile means of each render, the digest of the first, and what made them."""
    means: np.ndarray
    first: str
    size: tuple  # width, height
    arguments: list
    version: str

    @classmethod
    def made(cls, stage, scene, draw=render):
        """:param draw: makes one image, as render() does
        :returns: (the Golden, the mean image, why a test by it sees too little or an empty text)"""
        images = [draw(stage, FIRST_SEED + i, scene.arguments) for i in range(scene.renders)]
        height, width = images[0].shape[:2]
        means = welch.tiles(images)
        made = cls(means, digest(images[0]), (width, height), list(scene.arguments), __version__)
        return made, np.mean(images, axis=0), blind(seen(welch.compare(means, means), scene), scene)

    def write(self, path):
        about = {"first": self.first, "size": self.size, "arguments": self.arguments, "version": self.version}
        os.makedirs(os.path.dirname(path), exist_ok=True)
        data = io.BytesIO()
        np.savez_compressed(data, means=self.means, about=np.array(json.dumps(about)))
        with outputs.Together() as files:
            with open(files.add(path), "wb") as file:
                file.write(data.getvalue())

    @classmethod
    def read(cls, path):
        """:raises RenderError: where the file is no golden one"""
        try:
            with np.load(path, allow_pickle=False) as data:
                about = json.loads(str(data["about"]))
                return cls(data["means"], about["first"], tuple(about["size"]), about["arguments"], about["version"])
        except (OSError, ValueError, KeyError) as error:
            raise RenderError(f"{path} cannot be read: {error}") from None


@dataclasses.dataclass
class Result:
    """Of a comparison. `problem`: in words, empty where the picture is the same; `outcome`: one of reportPage's; `image`: the
    new one, or None where its first render had the golden bits; `sees`: relative difference that most noisy tiles would show,
    0 for equal bits"""
    problem: str = ""
    outcome: str = "broken"
    image: object = None
    sees: float = 0.0


def compare(stage, scene, golden, draw=render):
    """Renders a stage again, by `draw`. Where the first render has the bits of the golden one, it is the same and that is all.
    Else as many renders as the golden ones, with other seeds, are compared by `welch`.

    :raises RenderError: where the stage cannot be rendered"""
    if golden.arguments != list(scene.arguments):
        return Result(f"the golden image was made with {' '.join(golden.arguments)}, the test asks for "
                      f"{' '.join(scene.arguments)}")
    again = draw(stage, FIRST_SEED, scene.arguments)
    if again.shape[1::-1] != golden.size:
        return Result(f"the image is {again.shape[1]} x {again.shape[0]}, the golden one {golden.size[0]} x {golden.size[1]}",
                      "differs", again)
    if digest(again) == golden.first:
        return Result(outcome="equal")
    images = [draw(stage, OTHER_SEEDS + i, scene.arguments) for i in range(scene.renders)]
    interval = welch.compare(welch.tiles(images), golden.means)
    result = Result(image=np.mean(images, axis=0), sees=seen(interval, scene))
    which = interval.outside(scene.margin)
    if which.any():
        result.problem = (f"{which.any(axis=-1).sum()} of {which[..., 0].size} tiles differ by more than "
                          f"{100 * scene.margin:g} % (significance 1 % for all of them): {interval.worst(which)}")
        result.outcome = "differs"
    else:
        result.problem = blind(result.sees, scene)
        result.outcome = "unseen" if result.problem else "same"
    return result


def seen(interval, scene):
    """:param interval: welch.Interval
    :returns: relative difference that shows in most tiles. Tiles without noise, such as a plain background, show any: they do
        not count"""
    noisy = interval.half[interval.half > 1e-9]
    return scene.margin + (float(np.quantile(noisy, MOST)) if noisy.size else 0.0)


def blind(sees, scene):
    """:returns: why a test sees too little and what helps; empty where it sees what it has to"""
    if sees <= scene.sees:
        return ""
    # Noise falls with the root of the number of samples.
    samples = _samples(scene.arguments) * ((sees - scene.margin) / (scene.sees - scene.margin)) ** 2
    return (f"the picture may be the same, but noise hides differences of a tile below {100 * sees:.2g} %, and the test has "
            f"to see {100 * scene.sees:g} %: about --samples {math.ceil(samples / 16) * 16} would, or more renders; or accept "
            f'what is seen by "sees" in scenes.json')


def _samples(arguments):
    """:returns: of `patina record` with these arguments"""
    for i, word in enumerate(arguments):
        value = word.partition("=")[2] if word.startswith("--samples=") else arguments[i + 1] if (
            word == "--samples" and i + 1 < len(arguments)) else ""
        if value.isdigit():
            return int(value)
    return DEFAULT_SAMPLES
