"""What an edit of one colour costs: python editTimes.py PRIMS BACKEND [REPEATS]. A stage of that many quads with eleven
materials, of which one has a single user; prints a line of JSON: median milliseconds of a commit and of what the back end does
before its first sample, and how many prims it looked at."""
import json
import statistics
import sys
import time

import numpy as np

import _patina
from patina.chart import probes


def color(value):
    return probes.network("oren_nayar_diffuse_bsdf", color=(value, 0.4, 0.2))


def fill(scene, count):
    points = np.float32([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * np.float32(0.01)
    with scene.edit() as edit:
        edit.set_material("/one", color(0.1))
        for i in range(10):
            edit.set_material(f"/others{i}", color(0.1 * i))
        for i in range(count):
            matrix = np.eye(4, dtype=np.float32)
            matrix[3, :3] = 0.02 * (i % 100) - 1.0, 0.02 * (i // 100 % 100) - 1.0, -4.0 - i // 10000
            edit.set_mesh(f"/quad{i}", points=points, face_vertex_counts=[4], face_vertex_indices=[0, 1, 2, 3],
                          transform=matrix, material="/one" if i == count // 2 else f"/others{i % 10}")
        edit.set_light("/sun", type="distant", intensity=3.0)
        edit.set_camera("/camera")


def main(count, backend, repeats=15):
    scene, renderer, film = _patina.Scene(), _patina.make_renderer(backend), _patina.Film()
    fill(scene, int(count))

    def render():
        renderer.start(scene, "/camera", {"width": 32, "height": 32, "samples": 1, "interactive": True}, film)
        renderer.wait()
        found = renderer.progress()
        if found["failed"]:
            sys.exit(found["error"])
        return found["statistics"]

    last, commits, builds, looked = render(), [], [], []
    for i in range(int(repeats)):
        edit = scene.edit().__enter__()
        edit.set_material("/one", color(0.05 * i))
        start = time.perf_counter()
        edit.__exit__(None, None, None)
        commits.append(time.perf_counter() - start)
        before, last = last, render()
        builds.append(last["secondsBuild"])
        looked.append(last["primsLookedAt"] - before["primsLookedAt"])
    print(json.dumps({"backend": backend, "prims": int(count), "primsLookedAt": statistics.median(looked),
                      "commitMilliseconds": round(1e3 * statistics.median(commits), 4),
                      "buildMilliseconds": round(1e3 * statistics.median(builds), 3)}))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
