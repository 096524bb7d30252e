# SPDX-License-Identifier: Apache-2.0
"""The ways that a stage is drawn: the command line with both back ends, and Hydra by the delegate and by scene indices."""
import dataclasses
import json
import os
import sys
import types

import hydraBuild
import watched

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


@dataclasses.dataclass(frozen=True)
class Way:
    """`title`: of the page; `backend`: of the command line, None for Hydra; `scene_index`: Hydra's mode; `samples`: per pixel
    in place of those that are asked for, where the picture is compared with no other"""
    name: str
    title: str
    backend: str = None
    scene_index: bool = False
    samples: int = None

    def command(self, shot, image, told, samples, seed):
        """:param shot: dict of prepare.py
        :param told: file for statistics
        :returns: the words of the command"""
        width, height = shot["size"]
        samples = self.samples or samples
        if self.backend:
            return [sys.executable, "-m", "patina", "record", shot["stage"], image, "--backend", self.backend, "--camera",
                    shot["camera"], "-w", width, "--imageHeight", height, "--samples", samples, "--seed", seed,
                    "--disableCameraLight", "--quiet", f"--json={told}"]
        settings = {"samples": samples, "seed": seed, "enableInteractive": "false"}  # as the command line renders
        return [hydraBuild.folder("host"), shot["stage"], image, "--camera", shot["camera"], "--frame", shot["frame"],
                "--size", f"{width}x{height}", *(["--sceneIndex"] if self.scene_index else []),
                *(word for name, value in settings.items() for word in ("--set", f"{name}={value}"))]

    def environment(self):
        return None if self.backend else hydraBuild.environment(self.scene_index)

    def warnings(self, told, ending):
        """:returns: lines"""
        if not self.backend:
            return hydraBuild.warnings_of(types.SimpleNamespace(stderr=ending.error))
        if not os.path.exists(told):
            return []
        with open(told, encoding="utf-8") as file:
            return [f"{w['prim']}.{w['input']}: {w['message']}" for w in json.load(file)["warnings"]]


WAYS = {way.name: way for way in (
    Way("embree", "path tracer", backend="embree"),
    Way("raster", "rasterizer", backend="raster", samples=1),
    Way("delegate", "Hydra, delegate's way"),
    Way("sceneIndex", "Hydra, scene indices", scene_index=True))}
COMPARED = ("delegate", "sceneIndex")  # each with the path tracer of the command line: the rasterizer may differ


def draw(way, shot, folder, samples, seed, limits):
    """:param limits: seconds and gigabytes of watched.run()
    :returns: (pixels (height, width, 3) or None, dict of status, seconds, memory, message and warnings)"""
    import numpy as np

    from inProcess import pixels

    image, told = (os.path.join(folder, f"{way.name}.{seed}.{kind}") for kind in ("exr", "json"))
    ending = watched.run(way.command(shot, image, told, samples, seed), way.environment(), folder=folder, **limits)
    status, drawn = ending.word(), None
    if status == "ok":
        try:
            drawn = pixels(image)
        except RuntimeError as error:
            return None, row_of("crash", ending, f"no image: {error}", [])
        bad = int((~np.isfinite(drawn)).any(axis=2).sum())
        if bad:
            status, ending.error = "NaN", f"{bad} of {drawn[..., 0].size} pixels are no numbers"
    message = f"no end after {limits['seconds']:g} s" if status == "timeout" else "" if status == "ok" else ending.reason()
    return drawn, row_of(status, ending, message, way.warnings(told, ending))


def row_of(status, ending, message, warnings):
    return {"status": status, "seconds": round(ending.seconds, 2), "memory": ending.peak >> 20, "message": message[:400],
            "warnings": warnings}
