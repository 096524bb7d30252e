# SPDX-License-Identifier: Apache-2.0
"""Rays per second of a whole path traced frame, beside the same rays traced with nothing around.

The scenes are those of `patina bench path`. Every call of rtcIntersect1 and rtcOccluded1 of a frame on one thread is noted by
a library between the renderer and Embree, and traced again in the same order. The ratio of both rates is the share of a frame's
time that its rays alone take. Processor time, medians of the runs, which take turns.
"""
import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile

import pathScenes
import pathWorker
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
            "width": options.size[0], "height": options.size[1], "depth": options.depth, "threads": 1})
        command = [sys.executable, os.path.join(HERE, "rayWorker.py"), folder, library, str(options.samples), str(options.runs)]
        process = subprocess.run(command, env=dict(os.environ, LD_PRELOAD=library), capture_output=True, text=True, check=False)
    if process.returncode != 0:
        raise SystemExit(f"{name}: {(process.stderr.strip().splitlines() or ['no message'])[-1]}")
    return json.loads(process.stdout.strip().splitlines()[-1])


def main(arguments):
    parser = argparse.ArgumentParser(prog="patina bench rays", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", help=f"of {', '.join(pathScenes.SCENES)} (default: all)")
    parser.add_argument("--size", default="192x108", help="of the images (default: 192x108)")
    parser.add_argument("--samples", type=int, default=8, help="of a pixel (default: 8)")
    parser.add_argument("--runs", type=int, default=5, help="of each (default: 5)")
    parser.add_argument("--depth", type=int, default=8, help="bounces (default: 8)")
    parser.add_argument("--json", help="writes the figures to this file")
    options = parser.parse_args(arguments)
    outputs.check_all([options.json])
    options.size = tuple(map(int, options.size.split("x")))
    unknown = [name for name in options.scenes if name not in pathScenes.SCENES]
    if unknown or options.runs < 1 or options.samples < 1:
        parser.error(f"there is no scene {unknown[0]}" if unknown else "--runs and --samples take at least 1")
    results = {}
    print("| scene | rays of a frame, of that to lights | rays per second | the same rays alone | ratio (target 0.6) |\n"
          "|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="rayBench") as folder:
        library = recorder(folder)
        for name in options.scenes or pathScenes.SCENES:
            found = results[name] = measure(name, library, options)
            rays = found["intersect"] + found["occluded"]
            frame, bare = (rays / statistics.median(found[key]) for key in ("frame", "bare"))
            ratios = sorted(b / f for b, f in zip(found["bare"], found["frame"]))
            shadows = 100 * found["occluded"] / rays
            print(f"| {name} | {rays / 1e6:.2f} M, {shadows:.0f} % | {frame / 1e6:.2f} M | {bare / 1e6:.2f} M | "
                  f"{statistics.median(ratios):.2f} ({ratios[0]:.2f} to {ratios[-1]:.2f}) |", flush=True)
    outputs.write_json(options.json, {"size": options.size, "samples": options.samples, "scenes": results})
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
