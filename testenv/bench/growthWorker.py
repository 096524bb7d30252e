# SPDX-License-Identifier: Apache-2.0
"""One stage from its file to its first image: python growthWorker.py STAGE WIDTHxHEIGHT SAMPLES [SETTING=NUMBER ...]. Prints a
line of JSON: processor and wall seconds to open the stage, to translate it, to build what rays need, of all to the first image,
and of one more sample of all pixels; megabytes that the process grew by until then, and those of textures."""
import json
import resource
import sys
import time

import _patina
from patina import experiment
from patina import stage as reader
from patina.cli import openStage


def peak():
    """:returns: the most megabytes that this program had. (getrusage would count those of its parent before it was started.)"""
    with open("/proc/self/status", encoding="ascii") as file:
        for line in file:
            if line.startswith("VmHWM:"):
                return float(line.split()[1]) / 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main(path, size, samples, *settings):
    width, height = map(int, size.split("x"))
    given = {name: float(value) for name, value in (word.split("=") for word in settings)}
    before, marks = peak(), [(time.perf_counter(), time.process_time())]
    stage = openStage.open_stage(path)
    marks.append((time.perf_counter(), time.process_time()))
    scene, film, renderer = _patina.Scene(), _patina.Film(), _patina.make_renderer("embree")
    with scene.edit() as edit:
        camera = reader.read_stage(stage, edit, reader.StageOptions()).camera
    marks.append((time.perf_counter(), time.process_time()))

    def draw(count):
        settings = {"width": width, "height": height, "samples": count, "checkpointSeconds": 0.0, **given}
        return experiment.draw(renderer, scene, camera, settings, film)["statistics"]

    statistics = draw(1)
    marks.append((time.perf_counter(), time.process_time()))
    report = {"peak": peak() - before, "textures": statistics.get("textureBytes", 0.0) / 2.0 ** 20,
              "build": {"wall": statistics["secondsBuild"]}, "triangles": statistics["trianglesStored"]}
    for name, a, b in (("open", 0, 1), ("read", 1, 2), ("draw", 2, 3), ("first", 0, 3)):
        report[name] = {"wall": marks[b][0] - marks[a][0], "processor": marks[b][1] - marks[a][1]}
    took = []
    for count in (1, int(samples)):
        begin = time.process_time()
        draw(count)
        took.append(time.process_time() - begin)
    report["sample"] = (took[1] - took[0]) / max(1, int(samples) - 1)
    report["warnings"] = len(scene.warnings())
    print(json.dumps(report), flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
