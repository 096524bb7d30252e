# SPDX-License-Identifier: Apache-2.0
"""Measures the choice points `pathDepth` and `roulette` in two small scenes, by albedo.

A closed box with a lamp under its ceiling, where light is lost by absorption alone, and a corner of three walls, which most
light leaves at once. The error of a depth is the mean of |luminance - truth| over (truth + 0.01) against paths that end where
less than a ten-millionth is left, with the same random numbers and without roulette, whose noise is as large as dark walls'
loss. Roulette makes noise alone: what counts is time times variance, here over those of the default, for paths of at most 4,
16, 64 and 256 surfaces. Times are of processors.
"""
import time

import numpy as np

from patina.chart import probes
from patina.cli.compiled import _patina
from patina.experiment import LUMINANCE, draw, relative_error

SCENES = ("box", "corner")
DEPTHS = (4, 16, 64, 256)  # the four columns of rows of roulette
BINS = 8                   # of albedo
_WIDTH = 16                # pixels
_NEVER = 1 << 20           # surfaces before roulette
_FACES = {"box": range(6), "corner": (0, 2, 4)}  # of a cube: below 0, above 0, along x, y, z


def path_depth(timed=True, scenes=SCENES, bins=range(BINS), samples=64):
    """:returns: list of rows as measure_methods() gives them; the columns are all alike"""
    rows = []
    for scene in scenes:
        pictures = {b: _Pictures(scene, b, samples) for b in bins}
        truths = {b: pictures[b].render(maxDepth=_whole(b), rouletteDepth=_NEVER)[0] for b in bins}
        for method in _methods("pathDepth"):
            errors, spent = np.zeros((BINS, 4)), []
            for b in bins:
                image = pictures[b].render(maxDepth=int(method), rouletteDepth=_NEVER)[0]
                errors[b] = relative_error(image, truths[b])
                if timed:
                    spent.append(pictures[b].render(maxDepth=int(method))[2])
            rows.append(_row("pathDepth", method, scene, "picture", errors, np.ones((BINS, 4)), errors[list(bins)], spent,
                             timed))
    return rows


def roulette(timed=True, scenes=SCENES, bins=range(BINS), depths=DEPTHS, samples=32):
    """:returns: list of rows as measure_methods() gives them, errors being time times variance over the default's"""
    rows = []
    for scene in scenes:
        efforts = {method: np.zeros((BINS, 4)) for method in _methods("roulette")}
        spent = {method: [] for method in efforts}
        for b in bins:
            picture = _Pictures(scene, b, samples)
            for depth in depths:
                picture.render(maxDepth=depth, samples=4)
                for method, effort in efforts.items():
                    found = [picture.render(maxDepth=depth, methods={"roulette": method}, seed=seed) for seed in (1, 2)]
                    per = float(np.mean([f[2] for f in found]))
                    effort[b, DEPTHS.index(depth)] = np.mean([f[1] for f in found]) * (per if timed else 1.0)
                    spent[method].append(per)
        standard = efforts["throughput"].copy()
        for method, effort in efforts.items():
            effort = np.divide(effort, standard, out=np.zeros_like(effort), where=standard > 0.0)
            known = effort[standard > 0.0]
            rows.append(_row("roulette", method, scene, "effort", effort, np.ones((BINS, 4)), known, spent[method], timed))
    return rows


def _whole(b):
    """:returns: surfaces after which less than 1e-7 of the light is left"""
    return int(np.ceil(np.log(1e-7) / np.log(_albedo(b))))


def _albedo(b):
    return (b + 0.5) / BINS


def _methods(point):
    return [name for name, _ in dict(_patina.choice_points())[point]]


def _row(point, method, scene, of, errors, truths, known, spent, timed):
    low, ns, high = np.quantile(spent, (0.25, 0.5, 0.75)) if timed else (0.0, 0.0, 0.0)
    return {"point": point, "method": method, "subject": scene, "errorOf": of, "ns": float(ns), "nsLow": float(low),
            "nsHigh": float(high), "mean": float(known.mean()), "largest": float(known.max()),
            "rms": float(np.sqrt((known**2).mean())), "kind": "path", "reflectance": -1.0, "axis": "albedo", "axisEnd": 1.0,
            "errors": errors.ravel().tolist(), "truths": truths.ravel().tolist()}


class _Pictures:
    """One scene of one albedo."""

    def __init__(self, scene, b, samples):
        self.samples = samples
        self.scene, self.renderer = _patina.Scene(), _patina.make_renderer("embree")
        albedo = _albedo(b)
        with self.scene.edit() as edit:
            edit.set_camera("/camera", transform=probes.moved(0.25, 0.1, 0.45), focal_length=20.0, clip_near=0.01)
            edit.set_material("/material", probes.network("oren_nayar_diffuse_bsdf", color=(albedo,) * 3, roughness=0.0))
            edit.set_mesh("/walls", scheme="none", material="/material", double_sided=True, **_walls(_FACES[scene]))
            lamp = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0.1, 0.45, 0, 1]], np.float32)
            edit.set_light("/lamp", type="rect", transform=lamp, width=0.3, height=0.3, intensity=20.0, camera_visible=False)

    def render(self, maxDepth, methods=None, seed=1, samples=None, **more):
        """:returns: luminance, mean relative variance of a sample, and ns of a sample"""
        film = _patina.Film()
        settings = {"width": _WIDTH, "height": _WIDTH, "samples": samples or self.samples, "seed": seed, "maxDepth": maxDepth,
                    "methods": methods or {}, "checkpointSeconds": 0.0, "lightSamples": 1, "branches": 1, **more}
        begin = time.process_time()
        draw(self.renderer, self.scene, "/camera", settings, film)
        spent = time.process_time() - begin
        count = settings["samples"]
        image = np.asarray(film.resolve("color"), np.float64) @ LUMINANCE
        variance = np.asarray(film.resolve("variance"), np.float64) * count
        return image, float((variance / (image + 0.01) ** 2).mean()), 1e9 * spent / (count * _WIDTH**2)


def _walls(faces):
    points, indices = [], []
    for face in faces:
        axis, end = face // 2, (face % 2) - 0.5
        for u, v in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
            p = [0.0, 0.0, 0.0]
            p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = end, u, v
            indices.append(len(points))
            points.append(p)
    return {"points": np.array(points, np.float32), "face_vertex_counts": np.full(len(points) // 4, 4, np.int32),
            "face_vertex_indices": np.array(indices, np.int32)}
