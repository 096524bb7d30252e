# SPDX-License-Identifier: Apache-2.0
"""Seconds of an edit of one colour: python editTimes.py PRIMS BACKEND [REPEATS [KIND]]. A stage of that many quads with eleven
materials, of which one has a single user. The colour is that of the material (KIND material, the default), of a quad (mesh) or
of a light (light). Prints a line of JSON: median milliseconds of a commit and of what the back end does before its first
sample, and how many prims it looked at."""
import json
import statistics
import sys
import time

import numpy as np

import _patina
from patina import experiment
from patina.chart import probes


def color(value):
    return probes.network("oren_nayar_diffuse_bsdf", color=(value, 0.4, 0.2))


def quad(edit, count, i, value=0.5):
    points = np.float32([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * np.float32(0.01)
    matrix = probes.moved(0.02 * (i % 100) - 1.0, 0.02 * (i // 100 % 100) - 1.0, -4.0 - i // 10000)
    edit.set_mesh(f"/quad{i}", points=points, face_vertex_counts=[4], face_vertex_indices=[0, 1, 2, 3], transform=matrix,
                  material="/one" if i == count // 2 else f"/others{i % 10}",
                  primvars=[("displayColor", "constant", np.float32([[value, 0.4, 0.2]]), None)])


def light(edit, value=1.0):
    edit.set_light("/sun", type="distant", intensity=3.0, color=(value, 1.0, 1.0))


EDITS = {"material": lambda edit, count, value: edit.set_material("/one", color(value)),
         "mesh": lambda edit, count, value: quad(edit, count, count // 2, value),
         "light": lambda edit, count, value: light(edit, value)}


def fill(scene, count):
    with scene.edit() as edit:
        edit.set_material("/one", color(0.1))
        for i in range(10):
            edit.set_material(f"/others{i}", color(0.1 * i))
        for i in range(count):
            quad(edit, count, i)
        light(edit)
        edit.set_camera("/camera")


def main(count, backend, repeats=15, kind="material"):
    scene, renderer, film = _patina.Scene(), _patina.make_renderer(backend), _patina.Film()
    fill(scene, int(count))

    def render():
        settings = {"width": 32, "height": 32, "samples": 1, "interactive": True}
        return experiment.draw(renderer, scene, "/camera", settings, film)["statistics"]

    last, commits, builds, looked = render(), [], [], []
    for i in range(int(repeats)):
        edit = scene.edit().__enter__()
        EDITS[kind](edit, int(count), 0.05 * i)
        start = time.perf_counter()
        edit.__exit__(None, None, None)
        commits.append(time.perf_counter() - start)
        before, last = last, render()
        builds.append(last["secondsBuild"])
        looked.append(last["primsLookedAt"] - before["primsLookedAt"])
    print(json.dumps({"backend": backend, "edit": kind, "prims": int(count), "primsLookedAt": statistics.median(looked),
                      "commitMilliseconds": round(1e3 * statistics.median(commits), 4),
                      "buildMilliseconds": round(1e3 * statistics.median(builds), 3)}))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
