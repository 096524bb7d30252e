# SPDX-License-Identifier: Apache-2.0
"""Rays per second of a whole path traced frame, beside the same rays traced with nothing around.

The scenes are those of `patina bench path`. Every call of rtcIntersect1 and rtcOccluded1 of a frame on one thread is noted by
a library between the renderer and Embree, and traced again in the same order. The ratio of both rates is the share of a frame's
time that its rays alone take. Processor time, medians of the runs, which take turns.
"""
import os
import re
import statistics
import subprocess
import tempfile

import benchRun
import pathScenes
import pathWorker
from patina import experiment
from patina.cli import outputs

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))


def recorder(folder):
    """Builds it against the Embree of the compiled module. :returns: its file
    :raises CommandError: without a compiler"""
    import _patina
    from patina.cli.errors import CommandError

    needed = subprocess.run(["ldd", _patina.__file__], capture_output=True, text=True, check=True).stdout
    embree = re.search(r"libembree(\d)\S* => (\S+)", needed)
    file = os.path.join(folder, "rayRecorder.so")
    compat = os.path.join(ROOT, "hdDelegate", "embree", "compat.h")
    command = [os.environ.get("CXX", "c++"), "-std=c++17", "-O2", "-shared", "-fPIC", f"-DPATINA_EMBREE_MAJOR={embree[1]}",
               "-include", compat, os.path.join(HERE, "rayRecorder.cpp"), "-Wl,--no-as-needed", embree[2], "-ldl", "-o", file]
    try:
        built = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise CommandError(f"patina bench rays: {error}") from None
    if built.returncode != 0:
        raise CommandError("patina bench rays: " + (built.stderr.strip().splitlines() or ["no message"])[0])
    return file


def measure(name, library, options):
    """:returns: what rayWorker.py tells
    :raises SystemExit: with its reason"""
    with tempfile.TemporaryDirectory(prefix="rayBench") as folder:
        pathWorker.save(pathScenes.SCENES[name](folder), folder, {
            "width": options.pixels[0], "height": options.pixels[1], "depth": options.depth, "threads": 1})
        return benchRun.figures(name, [os.path.join(HERE, "rayWorker.py"), folder, library, options.samples, options.runs],
                                  env=dict(os.environ, LD_PRELOAD=library))


def main(arguments):
    parser = benchRun.Parser("rays", __doc__, "192x108", samples=(8, "of a pixel"), runs=(5, "of each"), depth=(8, "bounces"))
    parser.add_argument("scenes", nargs="*", help=f"of {', '.join(pathScenes.SCENES)} (default: all)")
    options = parser.parse(arguments)
    names = parser.known(options.scenes, pathScenes.SCENES, options.runs >= 1 and options.samples >= 1,
                         "--runs and --samples take at least 1")
    results = {}
    print("\n".join(experiment.table(("scene", "rays of a frame, of that to lights", "rays per second", "the same rays alone",
                                     "ratio (target 0.6)"))))
    with tempfile.TemporaryDirectory(prefix="rayBench") as folder:
        library = recorder(folder)
        for name in names:
            found = results[name] = measure(name, library, options)
            rays = found["intersect"] + found["occluded"]
            frame, bare = (rays / statistics.median(found[key]) for key in ("frame", "bare"))
            share = experiment.spread([b / f for b, f in zip(found["bare"], found["frame"])])
            shadows = 100 * found["occluded"] / rays
            print(experiment.table_row((
                name, f"{rays / 1e6:.2f} M, {shadows:.0f} %", f"{frame / 1e6:.2f} M", f"{bare / 1e6:.2f} M",
                f"{share['ratio']:.2f} ({share['least']:.2f} to {share['most']:.2f})")), flush=True)
    outputs.write_json(options.json, {"size": options.pixels, "samples": options.samples, "scenes": results})
    return 0
