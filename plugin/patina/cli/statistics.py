# SPDX-License-Identifier: Apache-2.0
"""The statistics of a render that --json shows: times by phase, rays, samples, memory, warnings."""
import contextlib
import math
import sys
import time

from patina import __version__, messages
from patina.cli import colours, memory, outputs, planText
from patina.cli.causes import Causes

ERROR_IS = ("noise of the samples, as --tolerance means it: the mean over the pixels of |luminance - its limit| / (limit + "
            "0.01); left out: the errors of methods (predictedError), of edges and of the length of paths (plan), and light "
            "that no sample found")
PHASES = ("open", "translate", "build", "render", "write", "total")


def report(warnings, json=True):
    """Prints the causes of warnings, worst first.

    :param json: whether the command has a --json that holds all warnings"""
    for text in Causes(warnings).lines(json=json):
        print(colours.painted(text, sys.stderr), file=sys.stderr)


class Statistics:
    """Collects the numbers of all frames. Times are in seconds of wall clock."""

    def __init__(self, arguments):
        self._begin = time.perf_counter()
        self._total = {"stage": arguments.stage, "requestedBackend": arguments.backend, "version": __version__}
        self._seconds = dict.fromkeys(PHASES, 0.0)
        self._frames = []
        self._frame = None
        self._own, self._scene, self._notes = [], [], []

    @contextlib.contextmanager
    def phase(self, name):
        begin = time.perf_counter()
        try:
            yield
        finally:
            spent = time.perf_counter() - begin
            for times in (self._seconds, *([self._frame["seconds"]] if self._frame else [])):
                times[name] = times.get(name, 0.0) + spent
            if self._frame:
                self._frame["memory"][name] = memory.resident()

    def begin_frame(self, frame, images):
        self._frame = {"frame": frame, "image": images[0], "images": images, "seconds": {}, "memory": {}}
        if not self._frames:  # reading is the first frame's
            self._frame["seconds"]["open"], self._frame["memory"]["open"] = self._seconds["open"], memory.resident()

    def built(self):
        """The scene is made ready: what comes now are samples."""
        self._frame["memory"]["build"] = memory.resident()

    def current(self):
        """:returns: the numbers of the frame that is being made"""
        return self._frame

    def frames(self):
        """:returns: those of all frames, the one that is being made last"""
        return self._frames + ([self._frame] if self._frame else [])

    def notes(self):
        return list(self._notes)

    def end_frame(self):
        self._frames.append(self._frame)
        self._frame = None

    def rendered(self, state, film):
        """:param state: what Renderer.progress() said at the end"""
        numbers = dict(state["statistics"])
        build = numbers.pop("secondsBuild", 0.0)
        for times in (self._seconds, self._frame["seconds"]):
            times["build"] = times.get("build", 0.0) + build
            times["render"] -= build
        self._frame["memory"].setdefault("build", memory.resident())
        counts = film.resolve("sampleCount") if film.width else None
        samples = int(counts.astype("float64").sum()) if counts is not None else 0
        self._frame.update(
            backend=state["backend"], width=film.width, height=film.height, samples=samples,
            samplesPerPixel=samples / counts.size if samples else 0.0, converged=state["converged"],
            droppedSamples=film.dropped_samples,
            **{name: int(value) if float(value).is_integer() else value for name, value in numbers.items()
               if name not in ("samples", "droppedSamples")})
        if state["materialSeconds"]:
            self._frame["materialSeconds"] = state["materialSeconds"]
        if state["plans"] or state["sceneChoices"]:
            self._frame["plan"] = planText.of_scene(state["plans"], state["sceneChoices"])
        if film.width:
            error = film.relative_error(shared=state["backend"] == "raster")
            if counts is not None and counts.max() > 1 and math.isfinite(error):  # one sample tells of no noise
                self._frame["estimatedError"] = error
                self._frame["estimatedErrorIs"] = ERROR_IS

    def warn(self, prim, name, id_, *fields):
        self._own.append(messages.warning(prim, name, id_, *fields))

    def note(self, texts):
        """Keeps what was decided for the user. :returns: those that are new"""
        fresh = [text for text in texts if text not in self._notes]
        self._notes += fresh
        return fresh

    def collect(self, scene):
        """Takes the warnings of a scene: all that were reported so far."""
        self._scene = scene.warnings()

    def warnings(self):
        return self._own + self._scene

    def metadata(self, arguments, settings, camera):
        """:returns: dict of what the image's file says about its making"""
        frame = self._frame
        values = {"Software": f"Patina {__version__}", "patina:stage": arguments.stage, "patina:camera": camera,
                  "patina:backend": frame["backend"], "patina:seed": settings["seed"],
                  "patina:samples": frame["samplesPerPixel"], "patina:maxDepth": frame.get("maxDepth", 1),
                  "patina:seconds": frame["seconds"].get("build", 0.0) + frame["seconds"].get("render", 0.0),
                  "patina:warnings": len(self.warnings())}
        if frame["frame"] is not None:
            values["patina:frame"] = float(frame["frame"])
        if arguments.denoise:
            values["patina:denoised"] = 1
        if settings["tolerance"] >= 0.0:
            values["patina:tolerance"] = settings["tolerance"]
            if "predictedError" in frame:
                values["patina:predictedError"] = frame["predictedError"]
            if "plan" in frame:
                values["patina:methods"] = planText.metadata(frame["plan"])
        if getattr(arguments, "layer", None):
            values["patina:layers"] = " ".join(arguments.layer)
        if getattr(arguments, "settings", None):
            values["patina:settings"] = arguments.settings
        if arguments.set:
            values["patina:set"] = " ".join(arguments.set)
        return values

    def write(self, file):
        """:param file: a path, or - for standard output"""
        self._seconds["total"] = time.perf_counter() - self._begin
        result = dict(self._total, seconds={name: round(s, 6) for name, s in self._seconds.items()})
        made = sorted({frame["backend"] for frame in self._frames if "backend" in frame})
        result["backend"] = made[0] if len(made) == 1 else made or None
        for name in ("samples", "rays", "shadowRays", "paths", "droppedSamples"):
            if any(name in frame for frame in self._frames):
                result[name] = sum(frame.get(name, 0) for frame in self._frames)
        spent = self._seconds["render"]
        if result.get("rays") and spent > 0.0:
            result["raysPerSecond"] = result["rays"] / spent
        result["peakMemoryBytes"] = memory.peak()
        result["notes"] = self._notes
        result["causes"] = Causes(self.warnings()).groups
        result["warnings"] = self.warnings()
        result["frames"] = self._frames
        outputs.write_json(file, result)


def of_snapshot(arguments, film, camera):
    """:returns: dict of what the file of a snapshot says about its making"""
    return {"Software": f"Patina {__version__}", "patina:stage": arguments.stage, "patina:camera": camera, "patina:snapshot": 1,
            "patina:seed": arguments.seed, "patina:samples": float(film.resolve("sampleCount").mean())}
