# SPDX-License-Identifier: Apache-2.0
"""Times the rasterizer: python rasterTimes.py STAGE WIDTHxHEIGHT PRIM.INPUT=NUMBERS [REPEATS [BACKEND]]. A process that has
drawn nothing yet; prints one line of JSON: seconds of a first frame, after an edit of a shader's or light's input and after
a camera move, each of one sample per pixel, where their time goes, and peak memory."""
import json
import resource
import statistics
import sys
import time

import numpy as np

import _patina
from patina import experiment
from patina import stage as reader
from patina.cli import openStage

SHARES = ("secondsBuild", "secondsAovs", "secondsShadows", "secondsSurfaces", "secondsRead")


class Noted:
    """An edit that keeps what materials, cameras and lights were set to, so that a single one can be set again."""

    def __init__(self, edit):
        self._edit, self.materials, self.cameras, self.lights = edit, {}, {}, {}

    def __getattr__(self, name):
        return getattr(self._edit, name)

    def set_material(self, path, network):
        self.materials[path] = network
        self._edit.set_material(path, network)

    def set_camera(self, path, **values):
        self.cameras[path] = values
        self._edit.set_camera(path, **values)

    def set_light(self, path, **values):
        self.lights[path] = values
        self._edit.set_light(path, **values)


class Frames:
    def __init__(self, stage, size, backend):
        self.start = time.perf_counter()
        self.backend, self.renderer = backend, _patina.make_renderer(backend)
        self.scene, self.film = _patina.Scene(), _patina.Film()
        with self.scene.edit() as edit:
            self.noted = Noted(edit)
            self.info = reader.read_stage(openStage.open_stage(stage), self.noted, reader.StageOptions())
        self.translated = time.perf_counter() - self.start
        self.settings = {"width": size[0], "height": size[1], "samples": 1, "interactive": True}

    def draw(self, start):
        """:returns: seconds since `start`, and the shares of this frame"""
        found = experiment.draw(self.renderer, self.scene, self.info.camera, self.settings, self.film, self.backend)
        pixels = self.film.resolve("color")
        seconds = time.perf_counter() - start
        shares = {name[len("seconds"):].lower(): found["statistics"].get(name, 0.0) for name in SHARES}
        return seconds, shares, float(np.mean(pixels))

    def edit(self, path, name, numbers):
        if path in self.noted.lights:
            with self.scene.edit() as edit:
                edit.set_light(path, **dict(self.noted.lights[path], **{name: numbers}))
            return
        for material, network in self.noted.materials.items():
            for node in network.nodes():
                if node["path"] == path:
                    network.set_input(path, name, node["inputs"][name]["type"], numbers)
                    with self.scene.edit() as edit:
                        edit.set_material(material, network)
                    return
        sys.exit(f"there is no shader or light {path} with {name}")

    def move(self, step):
        values = dict(self.noted.cameras[self.info.camera])
        transform = np.array(values["transform"], dtype=np.float32)
        transform[..., 3, 0] += 0.01 * step
        values["transform"] = transform
        with self.scene.edit() as edit:
            edit.set_camera(self.info.camera, **values)


def middle(frames):
    """:returns: the frame of median time, of pairs of (seconds, shares)"""
    median = statistics.median_low(seconds for seconds, *_ in frames)
    return next(frame for frame in frames if frame[0] == median)


def main(stage, size, edit, repeats=5, backend="raster"):
    frames = Frames(stage, size, backend)
    target, value = edit.split("=")
    path, name = target.rsplit(".", 1)
    numbers = np.array([float(x) for x in value.split(",")])
    found = {"first": frames.draw(frames.start)}
    found["first"][1]["translate"] = frames.translated
    edits, moves = [], []
    for step in range(1, repeats + 1):
        start = time.perf_counter()
        frames.edit(path, name, list(numbers * (0.5 + 0.5 * step / repeats)) if len(numbers) > 1
                    else float(numbers[0] * (0.5 + 0.5 * step / repeats)))
        edits.append(frames.draw(start))
        start = time.perf_counter()
        frames.move(step)
        moves.append(frames.draw(start))
    if len({mean for *_, mean in edits}) < min(2, repeats):
        sys.exit("the edit changes nothing")
    found["edited"], found["moved"] = middle(edits), middle(moves)
    report = {key: frame[0] for key, frame in found.items()}
    report["shares"] = {key: frame[1] for key, frame in found.items()}
    report["memory"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    print(json.dumps(report))


if __name__ == "__main__":
    main(sys.argv[1], tuple(map(int, sys.argv[2].split("x"))), sys.argv[3], *map(int, sys.argv[4:5]), *sys.argv[5:6])
