# SPDX-License-Identifier: Apache-2.0
"""Renders of one stage for a chart: the stage is read once, each back end keeps what it built, time limits are kept."""
import time
from dataclasses import dataclass

import numpy as np

from patina.experiment import LUMINANCE
from patina.cli import denoiser, openStage
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError

BACKENDS = ("embree", "raster")
DENOISED = "denoised"  # the path tracer's images, which count as those of a back end
WORDS = {"embree": "path tracer", DENOISED: "denoised paths", "raster": "rasterizer"}
DEFAULT_WIDTH = 256
MAX_PIXELS = 1 << 24


class OutOfTime(Exception):
    """A render was given up because the stage's time is over."""


@dataclass
class Render:
    image: np.ndarray    # (height, width, 3), linear
    seconds: float       # of sampling: scene and shaders are built
    wall: float          # all of it, from the start of the render on
    busy: float          # cores that it had, mean over its wall time
    samples: float       # per pixel, mean
    maximum: float       # of any pixel
    noise: float         # relMSE of its own noise, by the variance of its pixels' luminance
    told: float = -1.0   # its error as a tolerance means it, by its own samples; below 0: not known


class StageRenders:
    """:raises CommandError, StageError: where the stage cannot be read"""

    def __init__(self, path, arguments, deadline=None):
        self.arguments, self.deadline = arguments, deadline
        begin = time.perf_counter()
        self.stage, self.scene, self.info = openStage.scene_of(path, arguments.set, camera=arguments.camera)
        self.seconds_to_read = time.perf_counter() - begin
        self.width, self.height = self._size()
        self.renderers = {}
        self.missing = {}  # back end -> why it is not there

    def _size(self):
        aspect = self.scene.camera(self.info.camera)["image_aspect"]
        width = self.arguments.imageWidth or DEFAULT_WIDTH
        height = max(1, round(width / aspect))
        if width * height > MAX_PIXELS:
            raise CommandError(f"an image of {width} x {height} pixels is too large for a chart")
        return width, height

    def left(self):
        """Seconds until the deadline, None without one."""
        return None if self.deadline is None else self.deadline - time.perf_counter()

    def settings(self, samples, seed, tolerance=None, maxDepth=None, methods=None):
        """:param tolerance: None: that of no flag; 0: the most exact methods, all samples"""
        settings = {"width": self.width, "height": self.height, "samples": samples, "seed": seed % 2**32,
                    "threads": self.arguments.threads, "methods": methods or {}, "checkpointSeconds": 0.0}
        if tolerance is not None:
            settings["tolerance"] = tolerance
        if maxDepth is not None:
            settings["maxDepth"] = maxDepth
        return settings

    def render(self, backend, settings, partial=False):
        """:param partial: when the time is over, keep the samples that are there
        :raises OutOfTime: when the time is over, and there is no sample or `partial` is not asked for
        :raises CommandError: where the back end is not there or the render fails"""
        denoised = backend == DENOISED
        renderer = self._renderer("embree" if denoised else backend)
        if denoised:
            settings = dict(settings, aovs=denoiser.aovs({"tolerance": -1.0, **settings}, "embree"))
        film = _patina.Film()
        begin, used = time.perf_counter(), time.process_time()
        renderer.start(self.scene, self.info.camera, settings, film)
        ended = renderer.wait(-1.0 if self.deadline is None else max(0.0, self.left()))
        if not ended:
            renderer.stop()
        wall, used = time.perf_counter() - begin, time.process_time() - used
        state = renderer.progress()
        if state["failed"]:
            raise CommandError(f"{WORDS[backend]}: {state['error']}")
        if not denoised and state["backend"] != backend:
            self._lost(backend)
        if not ended and not (partial and state["samplesDone"]):
            raise OutOfTime
        told, more = film.relative_error(shared=backend == "raster"), 0.0
        if denoised:
            told = state["statistics"].get("denoisedError", -1.0)
            begin = time.perf_counter()
            denoiser.run(_patina, film, self.arguments.threads)
            more = time.perf_counter() - begin
        counts = film.resolve("sampleCount")
        image = np.array(film.resolve("color"), dtype=np.float32)
        return Render(image, more + (state["secondsRendering"] if ended else wall), more + wall, used / max(wall, 1e-9),
                      float(counts.mean()), float(counts.max()), _noise(film, image), told)

    def _renderer(self, backend):
        if backend in self.missing:
            raise CommandError(self.missing[backend])
        if backend not in self.renderers:
            made = _patina.make_renderer(backend)
            if made.progress()["backend"] != backend:
                made.start(self.scene, self.info.camera, self.settings(1, 0), _patina.Film())
                made.stop()
                self._lost(backend)
            self.renderers[backend] = made
        return self.renderers[backend]

    def _lost(self, backend):
        reasons = [w["fields"]["why"] for w in self.scene.warnings() if w["id"] == "pathTracerInstead"]
        reason = reasons[-1] if reasons else "no reason is known"
        self.missing[backend] = f"no {WORDS[backend]} here: {reason}"
        raise CommandError(self.missing[backend])


def _noise(film, image):
    variance = np.maximum(np.asarray(film.resolve("variance"), dtype=np.float64), 0.0)
    luminance = image.astype(np.float64) @ LUMINANCE
    relative = variance / (luminance**2 + 0.01)
    found = relative[np.isfinite(relative)]
    return float(found.mean()) if found.size else 0.0
