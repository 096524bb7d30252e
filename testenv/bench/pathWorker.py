# SPDX-License-Identifier: Apache-2.0
"""The common part of the renderers' processes in the path tracing benchmark: scenes on disk, and the talk with the benchmark.

A worker is started with a folder and reads a line of JSON for each image: {"samples", "seed", "file", "plain"}. It answers
with the seconds and the processor seconds that the image took; the first line tells the renderer's version, what it took to get
ready, and what a first image of one sample took of that.
"""
import json
import os
import sys
import time

SAID = "path bench: "


def save(scene, folder, settings):
    """:param scene: pathScenes.Scene
    :param settings: width, height, depth, threads"""
    import numpy as np

    arrays, meshes = {}, {}
    for i, (name, (points, triangles, uv, smooth, material)) in enumerate(scene.meshes.items()):
        meshes[name] = {"number": i, "smooth": smooth, "material": material, "uv": uv is not None}
        arrays[f"points{i}"] = np.ascontiguousarray(points, np.float32)
        arrays[f"triangles{i}"] = np.ascontiguousarray(triangles, np.int32)
        if uv is not None:
            arrays[f"uv{i}"] = np.ascontiguousarray(uv, np.float32)
        if name in scene.instances:
            arrays[f"instances{i}"] = np.asarray(scene.instances[name], np.float64)
    np.savez(os.path.join(folder, "meshes.npz"), **arrays)
    rects = [[place.tolist(), width, height, radiance] for place, width, height, radiance in scene.rects]
    with open(os.path.join(folder, "scene.json"), "w", encoding="utf-8") as file:
        json.dump({"meshes": meshes, "materials": scene.materials, "rects": rects, "sky": scene.sky,
                   "camera": scene.camera, **settings}, file)


def load(folder):
    """:returns: (what scene.json holds, the arrays of meshes.npz)"""
    import numpy as np

    with open(os.path.join(folder, "scene.json"), encoding="utf-8") as file:
        return json.load(file), np.load(os.path.join(folder, "meshes.npz"))


def answer(values):
    print(SAID + json.dumps(values), flush=True)


def serve(draw, started, version=""):
    """:param draw: function of samples, seed, a file's path and plain, as benchRun.Worker.draw() has it; writes an
        array (height, width, 3) there with numpy.save
    :param started: time.perf_counter() before the scene was made"""
    begin = time.perf_counter()
    draw(1, 999, os.devnull, False)
    answer({"version": version, "ready": time.perf_counter() - started, "first": time.perf_counter() - begin})
    for line in sys.stdin:
        asked = json.loads(line)
        wall, cpu = time.perf_counter(), time.process_time()
        draw(asked["samples"], asked["seed"], asked["file"], asked["plain"])
        answer({"seconds": time.perf_counter() - wall, "processor": time.process_time() - cpu})
