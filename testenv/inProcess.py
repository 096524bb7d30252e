# SPDX-License-Identifier: Apache-2.0
"""Renders and commands of tests, in the test's own process: no start of Python, nothing written that is not asked for.

Path traced references are kept in the build folder by what they are made of: the stage with all that it uses, settings, and
the build itself (the compiled module and the package's Python files).
"""
import argparse
import contextlib
import functools
import glob
import hashlib
import io
import os
import shutil
import types

import numpy as np

from patina import experiment

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes")
STALE_SECONDS = 7 * 24 * 3600  # references of other builds are removed after so long


def scene(name):
    """:returns: the path of a test scene"""
    return os.path.join(SCENES, *name.split("/")) + ".usda"


def patina(*arguments, check=True):
    """Runs a command as the command line does, without a process of its own.

    :returns: returncode, stdout and stderr, as a finished process has them (what libraries print themselves is missing)
    :raises AssertionError: with the command's own words, where it fails and `check` is true"""
    from patina.cli import main

    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = main.main([str(a) for a in arguments])
        except SystemExit as end:  # --help
            status = end.code or 0
    if check and status != 0:
        raise AssertionError(f"patina {' '.join(map(str, arguments))}\n{err.getvalue()}")
    return types.SimpleNamespace(returncode=status, stdout=out.getvalue(), stderr=err.getvalue())


def record(stage, image, *arguments, check=True):
    _as_on_disk(stage)
    return patina("record", stage, image, "--quiet", *arguments, check=check)


def shot(folder, text, *arguments, name="image"):
    """Writes a stage, NAME.usda in a folder, and renders it to NAME.exr. :returns: the path of the image"""
    stage, image = (folder / f"{name}.{ending}" for ending in ("usda", "exr"))
    stage.write_text(text, encoding="utf-8")
    record(stage, image, *arguments)
    return image


class Stage:
    """A stage that is read once and rendered often: a renderer, and images of several seeds."""

    def __init__(self, stage, *arguments, image_height=None):
        """:param arguments: those of `patina record` that follow the image, --backend and --imageWidth among them
        :raises RuntimeError: where the stage cannot be read"""
        import _patina
        from patina import stage as reader
        from patina.cli import openStage, overrides, recordFlags

        _as_on_disk(stage)
        parser = argparse.ArgumentParser(allow_abbrev=False)
        recordFlags.add_arguments(parser)
        a = parser.parse_args([str(stage), "none.exr", *map(str, arguments)])
        opened = openStage.open_stage(a.stage, a.mask, a.sessionLayer)
        overrides.apply(opened, a.set)
        frame = float(a.frames) if a.frames else None if a.defaultTime else opened.GetStartTimeCode()
        options = reader.StageOptions(frame=frame, purposes=recordFlags.purposes_of(a), complexity=a.complexity,
                                      camera=a.camera, headlight=not a.disableCameraLight,
                                      rendering_color_space=a.renderingColorSpace,
                                      motion=any(name.startswith("motion") for name in recordFlags.aovs_of(a)))
        self.module, self.scene, self.backend = _patina, _patina.Scene(), a.backend
        with self.scene.edit() as edit:
            self.camera = reader.read_stage(opened, edit, options).camera
        aspect = self.scene.camera(self.camera)["image_aspect"]
        self.settings = dict(recordFlags.settings_of(a), width=a.imageWidth, checkpointSeconds=0.0,
                             height=image_height or a.imageHeight or max(1, round(a.imageWidth / aspect)))
        self.renderer = _patina.make_renderer(a.backend)

    def image(self, seed=None, **settings):
        """:returns: linear float array (height, width, 3)
        :raises RuntimeError: where the render fails, another back end takes over, or a value is not finite"""
        if seed is not None:
            settings["seed"] = seed
        pixels = np.array(self.film(**settings).resolve("color"), np.float64)[..., :3]
        if not np.isfinite(pixels).all():
            raise RuntimeError(f"the image has {np.sum(~np.isfinite(pixels))} values that are no numbers")
        return pixels

    def film(self, **settings):
        """:param settings: that differ from those of the arguments
        :raises RuntimeError: where the render fails, or another back end takes over"""
        film = self.module.Film()
        self.state = experiment.draw(self.renderer, self.scene, self.camera, {**self.settings, **settings}, film, self.backend)
        return film

    def warnings(self):
        return [f"{w['prim']}: {w['message']}" for w in self.scene.warnings()]


@functools.lru_cache(maxsize=None)
def without_opengl():
    """:returns: why the rasterizer cannot run here, or an empty text"""
    import _patina

    renderer = _patina.make_renderer("raster")
    if renderer.progress()["backend"] == "raster":
        return ""
    empty = _patina.Scene()
    renderer.start(empty, "/none", {}, _patina.Film())
    return empty.warnings()[0]["message"]


def needs_opengl(backend="raster"):
    """Skips a test where the back end is the rasterizer, and cannot run here."""
    if backend == "raster" and without_opengl():
        import pytest

        pytest.skip(without_opengl())


def pixels(image, channels="RGB"):
    """:returns: linear float array (height, width, 3) of the named channels of a file"""
    import _patina

    found = _patina.read_image(str(image))
    return np.array(found.pixels)[..., [found.channels.index(c) for c in channels]]


def channels(image):
    """:returns: dict of a channel to its values (height, width), linear"""
    import _patina

    found = _patina.read_image(str(image))
    return dict(zip(found.channels, np.moveaxis(np.array(found.pixels), -1, 0)))


def references(stage, seeds, *arguments):
    """Path traced images, made once for each build.

    :param seeds: one image for each
    :param arguments: those of `patina record` that follow the image, without --backend and --seed
    :returns: float array (seeds, height, width, 3)"""
    key = hashlib.sha256(repr([_contents(stage), list(map(str, arguments)), [int(s) for s in seeds]]).encode())
    folder = _folder()
    file = os.path.join(folder, key.hexdigest() + ".npy") if folder else None
    if file and os.path.exists(file):
        return np.load(file)
    rendered = Stage(stage, *arguments)
    images = np.array([rendered.image(seed) for seed in seeds])
    if file:
        temporary = f"{file[:-4]}.{os.getpid()}.npy"
        np.save(temporary, images)
        os.replace(temporary, file)
    return images


def _as_on_disk(stage):
    """:raises AssertionError: where a test has changed the stage's file in this process's memory, which renders would show"""
    from pxr import Sdf

    found = Sdf.Layer.Find(str(stage))
    assert not (found and found.dirty), f"{stage} was changed in memory: edit a layer above it"


def _folder():
    """:returns: where this build's references are kept; None without a build folder"""
    place = os.environ.get("PATINA_BUILD_DIR")
    if not place or not os.access(place, os.W_OK):
        return None
    every = os.path.join(place, "references")
    folder = os.path.join(every, build())
    if not os.path.isdir(folder):
        os.makedirs(folder, exist_ok=True)
        newest = os.stat(folder).st_mtime
        for other in glob.glob(os.path.join(every, "*")):
            with contextlib.suppress(OSError):
                if newest - os.stat(other).st_mtime > STALE_SECONDS:
                    shutil.rmtree(other, ignore_errors=True)
    return folder


@functools.lru_cache(maxsize=None)
def build():
    """:returns: a digest of the compiled module and of all Python files that take part in a render"""
    import _patina
    import patina

    package = os.path.dirname(os.path.abspath(patina.__file__))
    files = [_patina.__file__, os.path.abspath(__file__)]
    for folder in ("stage", "cli"):
        files += sorted(glob.glob(os.path.join(package, folder, "*.py")))
    return _digest(files)[:24]


def _contents(stage):
    """:returns: a digest of a stage and of all files that it uses"""
    from pxr import UsdUtils

    layers, assets, _ = UsdUtils.ComputeAllDependencies(str(stage))
    files = {layer.realPath for layer in layers} | {str(a) for a in assets} | {os.path.abspath(stage)}
    return _digest(sorted(file for file in files if os.path.isfile(file)))


def _digest(files):
    digest = hashlib.sha256()
    for file in files:
        with open(file, "rb") as data:
            digest.update(hashlib.sha256(data.read()).digest())
    return digest.hexdigest()
