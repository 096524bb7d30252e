# SPDX-License-Identifier: Apache-2.0
"""The cost of a constant material's lobes at a vertex of a path, beside Mitsuba's `principled`.

A closed room of one material, with a lamp at its ceiling and without Russian roulette: every path has as many vertices as it
may, and at each of them the material is set up, evaluated and weighed for a light sample, and sampled for the way on. The time
of a vertex is the difference of two depths. The time of the same room with a diffuse material in its place is taken off: rays,
lights, surface points and random numbers are in both. So a row is what the material costs more than a diffuse one, in
nanoseconds.

Renderers and materials take turns, image by image; times are of processors; a row is the median of the runs.
"""
import statistics

import benchRun
import pathBench
import pathScenes
from patina import experiment
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
    with benchRun.Workers("lobes") as workers:
        here = [who for who, command in commands.items() if all(
            workers.start((who, name, depth), command, room(material), {
                "width": SIZE[0], "height": SIZE[1], "depth": depth, "threads": 1, "roulette": False})
            for name, material in MATERIALS.items() for depth in DEPTHS)]

        def nanoseconds(asked, run):
            took = [workers[(*asked, depth)].draw(options.samples, run)["processor"] for depth in DEPTHS]
            return 1e9 * (took[1] - took[0]) / (SIZE[0] * SIZE[1] * options.samples * (DEPTHS[1] - DEPTHS[0]))

        found = experiment.turns(options.runs, [(who, name) for who in here for name in MATERIALS], nanoseconds)
    return {who: {name: found[who, name] for name in MATERIALS} for who in here}


def main(arguments):
    parser = benchRun.Parser("lobes", __doc__, runs=(5, "images of each"), samples=(64, "of a pixel"))
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
