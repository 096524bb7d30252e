#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How far the rasterizer's first images are from converged direct light.

    firstPass.py [STAGE...] [--passes N[,N...]] [--seeds N[,N...]] [--width PIXELS] [--truth N] [--cache FOLDER] [--images
    FOLDER]

Prints, per stage, mean FLIP and the worst relative difference of a tile (an eighth of the image each way) for each number of
passes, and the processor seconds of the first. Stages are names of STAGES, or paths; those without a light get a sky.
Converged images are path traced, and kept in the cache by stage and settings.
"""
import argparse
import hashlib
import os
import sys
import time

import numpy as np

import _patina
from patina import experiment
from patina import stage as reader
from patina.chart import png
from patina.cli import imageMetrics, openStage

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
SCENES = os.path.join(ROOT, "testenv", "scenes")
SKY = os.path.join(SCENES, "textures", "sky.exr")
ASSETS = os.environ.get("PATINA_ASSETS", "")
TRUTH_SEED = 991
TILES = 8

OWN = ["lightDome", "lightDistant", "lightRect", "lightSphere", "shaderball", "roughConductor", "instances", "texturedMesh",
       "plastic", "classic/hematite", "classic/rustedSteel"]
PUBLIC = {  # below PATINA_ASSETS
    "Teapot": "Teapot/Teapot.usd",
    "StandardShaderBall": "StandardShaderBall/standard_shader_ball_scene.usda",
    "teapot": "test_assets/_common/teapot.usda",
    "AlphaBlendModeTest": "test_assets/AlphaBlendModeTest/AlphaBlendModeTest.usd",
    "NormalsTexture": "test_assets/NormalsTextureBiasAndScale/NormalsTextureBiasAndScale.usda",
    "RoughnessTest": "test_assets/RoughnessTest/RoughnessTest.usdz",
    "CesiumMan": "test_assets/USDZ/CesiumMan/CesiumMan.usdz",
    "BrainStem": "test_assets/USDZ/BrainStem/BrainStem.usdz",
    "allPrimitives": "test_assets/schemaTests/usdGeom/primitives/all_primitives.usda",
}


def stages():
    """:returns: dict of name to path; the public ones where PATINA_ASSETS names their folder"""
    found = {name: os.path.join(SCENES, *name.split("/")) + ".usda" for name in OWN}
    if ASSETS:
        found.update({name: os.path.join(ASSETS, *path.split("/")) for name, path in PUBLIC.items()})
    return found


class Stage:
    """A stage that both back ends render, each with one renderer."""

    def __init__(self, path, width):
        self.path = path
        self.scene = _patina.Scene()
        stage = openStage.open_stage(path)
        with self.scene.edit() as edit:
            info = reader.read_stage(stage, edit, reader.StageOptions(headlight=False))
            if not self._has_light(stage):
                edit.set_light("/FirstPassSky", type="dome", texture_file=SKY, texture_format="latlong",
                               texture_color_space="auto", transform=self._upright(stage))
        self.camera = info.camera
        aspect = self.scene.camera(info.camera)["image_aspect"]
        self.size = {"width": width, "height": max(8, round(width / aspect))}
        self.renderers = {}

    @staticmethod
    def _has_light(stage):
        from pxr import UsdLux

        return any(prim.HasAPI(UsdLux.LightAPI) for prim in stage.Traverse())

    @staticmethod
    def _upright(stage):
        """:returns: what turns a sky's y up to the stage's up"""
        from pxr import UsdGeom

        turn = np.eye(4, dtype=np.float32)
        if UsdGeom.GetStageUpAxis(stage) == "Z":
            turn[1:3, 1:3] = [[0.0, 1.0], [-1.0, 0.0]]
        return turn

    def render(self, backend, samples, seed, **more):
        """:returns: float array (height, width, 3), linear"""
        renderer = self.renderers.setdefault(backend, _patina.make_renderer(backend))
        film = _patina.Film()
        settings = {**self.size, "samples": samples, "seed": seed, "checkpointSeconds": 0.0, **more}
        self.progress = experiment.draw(renderer, self.scene, self.camera, settings, film, backend)
        return np.array(film.resolve("color"), dtype=np.float32).reshape(self.size["height"], self.size["width"], -1)[..., :3]

    def truth(self, samples, cache):
        """:returns: direct light, path traced"""
        key = hashlib.sha256(repr((os.path.abspath(self.path), os.path.getmtime(self.path), self.size, samples)).encode())
        file = os.path.join(cache, f"{os.path.basename(self.path)}-{key.hexdigest()[:16]}.npy")
        if os.path.exists(file):
            return np.load(file)
        image = self.render("embree", samples, TRUTH_SEED, maxDepth=1)
        os.makedirs(cache, exist_ok=True)
        np.save(file, image)
        return image


def tiles(image):
    """:returns: means of TILES x TILES parts of an image, each of about the same size"""
    rows = np.array_split(np.arange(image.shape[0]), TILES)
    columns = np.array_split(np.arange(image.shape[1]), TILES)
    return np.array([[image[np.ix_(r, c)].mean(axis=(0, 1)) for c in columns] for r in rows])


def worst_tile(image, truth):
    """:returns: the largest difference of a tile's mean, relative to its value and a twentieth of the image's"""
    a, b = tiles(image), tiles(truth)
    return float(np.max(np.abs(a - b) / (b + 0.05 * max(truth.mean(), 1e-9))))


def write_png(image, path, scale):
    with open(path, "wb") as out:
        out.write(png.encode(image * scale))


def main():
    def counts(text):
        return [int(part) for part in text.split(",")]

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stages", nargs="*")
    parser.add_argument("--passes", type=counts, default=[1, 2, 4])
    parser.add_argument("--seeds", type=counts, default=[0])
    parser.add_argument("--width", type=int, default=112)
    parser.add_argument("--truth", type=int, default=256)
    parser.add_argument("--cache", default="/tmp/firstPass")
    parser.add_argument("--images")
    a = parser.parse_args()
    known = stages()
    means = {}
    for name in a.stages or known:
        stage = Stage(known.get(name, name), a.width)
        try:
            truth = stage.truth(a.truth, a.cache)
            line = f"{name:20}"
            for passes in a.passes:
                found, worst = [], []
                for seed in a.seeds:
                    before = time.process_time()
                    image = stage.render("raster", passes, seed)
                    seconds = time.process_time() - before
                    found.append(imageMetrics.mean_flip(image, truth, True))
                    worst.append(worst_tile(image, truth))
                    s = stage.progress["statistics"]
                    if a.images:
                        scale = 0.5 / max(float(np.median(truth[truth > 0])), 1e-6)
                        flat = name.replace("/", "-")
                        write_png(np.concatenate([image, truth], axis=1), os.path.join(a.images, f"{flat}.{passes}.{seed}.png"),
                                  scale)
                means.setdefault(passes, []).append(np.mean(found))
                line += (f" | {passes}: FLIP {' '.join(f'{f:.3f}' for f in found)} tile {max(worst):5.2f} {seconds:5.2f}s"
                         f" (shadow {s['secondsShadows']:.2f} surf {s['secondsSurfaces']:.2f})")
            print(line, flush=True)
        except RuntimeError as error:
            print(f"{name:20} {error}", file=sys.stderr, flush=True)
    print("mean FLIP: " + ", ".join(f"{passes} passes {np.mean(found):.4f}" for passes, found in means.items()))


if __name__ == "__main__":
    main()
