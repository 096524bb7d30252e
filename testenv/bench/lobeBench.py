# SPDX-License-Identifier: Apache-2.0
"""The cost of a constant material's lobes at a vertex of a path, beside Mitsuba's `principled`.

A closed room of one material, with a lamp at its ceiling and without Russian roulette: every path has as many vertices as it
may, and at each of them the material is set up, evaluated and weighed for a light sample, and sampled for the way on. The time
of a vertex is the difference of two depths. The time of the same room with a diffuse material in its place is taken off: rays,
lights, surface points and random numbers are in both. So a row is what the material costs more than a diffuse one, in
nanoseconds.

Renderers and materials take turns, image by image; times are of processors; a row is the median of the runs.
"""
import os
import statistics
import tempfile

import experiment
import pathBench
import pathScenes
import pathWorker
from patina.cli import outputs

DEPTHS = (2, 6)  # few, for some paths end where a sample goes below the surface
SIZE = (64, 64)


def room(material):
    """:param material: as of pathScenes.Scene.materials"""
    made = pathScenes.Scene(camera=((0.0, 1.5, 2.5), (0.0, 1.4, 0.0), 60.0))
    made.materials["wall"] = material
    made.meshes["room"] = (*pathScenes.box((-3, 0, -3), (3, 3, 3), inward=True), "wall")
    made.rects.append((pathScenes.facing((0.0, 2.98, 0.0), (0.0, 0.0, 0.0)), 0.8, 0.8, 12.0))
    return made


MATERIALS = {
    "diffuse": {"diffuse": [0.6, 0.5, 0.4]},
    "plastic": {"standard": True, "color": [0.6, 0.5, 0.4], "roughness": 0.4, "metallic": 0.0, "image": None},
    "metal": {"standard": True, "color": [0.9, 0.7, 0.4], "roughness": 0.4, "metallic": 1.0, "image": None},
}


def measure(commands, options):
    """:returns: renderer -> material -> list of ns of a vertex, one per run"""
    found, workers = {}, {}
    with tempfile.TemporaryDirectory(prefix="lobeBench") as folder, open(os.path.join(folder, "log"), "w+",
                                                                         encoding="utf-8") as log:
        try:
            for who, command in commands.items():
                try:
                    for name, material in MATERIALS.items():
                        for depth in DEPTHS:
                            own = os.path.join(folder, f"{who}{name}{depth}".replace(" ", "_"))
                            os.makedirs(own)
                            pathWorker.save(room(material), own, {"width": SIZE[0], "height": SIZE[1], "depth": depth,
                                                                  "threads": 1, "roulette": False})
                            workers[who, name, depth] = pathBench.start(command, own, log)
                    found[who] = {}
                except RuntimeError as error:
                    if who == "Patina":
                        raise SystemExit(f"Patina: {error}") from error
                    print(f"{who} is left out: {error}")
            for run in range(options.runs):
                for who in found:
                    for name in MATERIALS:
                        took = [workers[who, name, depth].draw(options.samples, run + 1, os.devnull)["processor"]
                                for depth in DEPTHS]
                        vertices = SIZE[0] * SIZE[1] * options.samples * (DEPTHS[1] - DEPTHS[0])
                        found[who].setdefault(name, []).append(1e9 * (took[1] - took[0]) / vertices)
        finally:
            for worker in workers.values():
                worker.close()
    return found


def main(arguments):
    parser = experiment.Parser("lobes", __doc__, runs=(5, "images of each"), samples=(64, "of a pixel"))
    options = parser.parse(arguments)
    if options.runs < 1 or options.samples < 1:
        parser.error("--runs and --samples take 1 or more")
    commands = pathBench.peers("Mitsuba")
    if len(commands) < 2:
        print("Mitsuba is not installed here")
    found = measure(commands, options)
    print(f"{'ns more than diffuse':<24}" + "".join(f"{name:>12}" for name in MATERIALS if name != "diffuse")
          + "   a diffuse vertex")
    own = {}
    for who, rows in found.items():
        plain = rows["diffuse"]
        more = {name: statistics.median(a - b for a, b in zip(rows[name], plain)) for name in MATERIALS if name != "diffuse"}
        own = own or more
        print(f"{who:<24}" + "".join(f"{ns:12.0f}" for ns in more.values()) + f"{statistics.median(plain):19.0f}"
              + ("" if more is own else "   Patina: " + ", ".join(f"x{own[name] / more[name]:.2f}" for name in more)))
    outputs.write_json(options.json, found)
    return 0
