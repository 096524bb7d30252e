# SPDX-License-Identifier: Apache-2.0
"""Path tracing beside Mitsuba 3 and Cycles: seconds until the image's error is small, each renderer against itself.

Every renderer draws every scene several times with seeds of its own, with a few and with many samples. The error of an image is
its relMSE: the mean over pixels and channels of (image - mean)^2 / (mean^2 + 0.01), where the mean is that of the renderer's
own images with many samples, and the error which that mean itself has is taken off. The cost of a sample is the difference of
the two medians of time, so that nothing which is done once per image counts. Time to a target: that cost times the samples at
which the error, taken as a power of the samples, reaches the target. Renderers take turns, image by image, so that what
disturbs the machine disturbs all of them.

All have the same geometry, camera, bounces, light and pixel filter; principled materials are each renderer's own.

Cycles is that of PyPI's bpy, with its light tree, and a second time with path guiding. $PATINA_BPY_PYTHON names a Python that
has bpy. Without it the benchmark installs bpy (requirements-cycles.txt) into an environment of its own, inside of Patina's.
"""
import argparse
import os
import statistics
import subprocess
import sys
import venv

import numpy as np

import benchRun
import pathScenes
from patina import experiment
from patina.cli import outputs

HERE = os.path.dirname(os.path.abspath(__file__))


def bpy_python():
    """:returns: a Python with bpy, None where it cannot be had"""
    named = os.environ.get("PATINA_BPY_PYTHON")
    folder = os.path.join(sys.prefix, "bpy")
    python = named or os.path.join(folder, "bin", "python")
    if named or os.path.exists(os.path.join(folder, "installed")):
        return python
    print(f"installing bpy into {folder}", file=sys.stderr)
    venv.create(folder, clear=True, with_pip=True)
    needs = os.path.join(HERE, "..", "..", "requirements-cycles.txt")
    if subprocess.run([python, "-m", "pip", "install", "-q", "-r", needs], check=False).returncode != 0:
        return None
    with open(os.path.join(folder, "installed"), "w", encoding="utf-8"):
        return python


def peers(*asked):
    """:param asked: Mitsuba, Cycles
    :returns: name -> command without the folder, of Patina and those that are here"""
    found = {"Patina": [sys.executable, os.path.join(HERE, "pathPatina.py")]}
    if "Mitsuba" in asked:
        found.update(mitsuba())
    python = bpy_python() if "Cycles" in asked else None
    if python:
        script = os.path.join(HERE, "pathCycles.py")
        found.update({"Cycles": [python, script], "Cycles guided": [python, script, None, "guided"]})
    return found


def mitsuba():
    found = {}
    probe = "import mitsuba; print(*(v for v in ('llvm_ad_rgb', 'scalar_rgb') if v in mitsuba.variants()))"
    reported = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, check=False)
    for variant in reported.stdout.split() if reported.returncode == 0 else ():
        check = f"import mitsuba; mitsuba.set_variant('{variant}'); import drjit; print(mitsuba.Float(1))"
        if subprocess.run([sys.executable, "-c", check], capture_output=True, check=False).returncode == 0:
            found["Mitsuba " + variant] = [sys.executable, os.path.join(HERE, "pathMitsuba.py"), None, variant]
    return found


def settings_of(options):
    """:returns: what pathWorker.save() takes besides a scene"""
    return {"width": options.pixels[0], "height": options.pixels[1], "depth": options.depth, "threads": options.threads,
            "methods": dict(options.method), "blur": options.blur, "filter": options.filter}


def add_choices(parser):
    """Adds what of both path benchmarks blurs, besides the denoiser."""
    def pair(word):
        choice, _, method = word.partition("=")
        if not method:
            raise argparse.ArgumentTypeError("it takes CHOICE=METHOD")
        return choice, method

    parser.add_argument("--method", type=pair, action="append", default=[], metavar="CHOICE=METHOD",
                        help="of Patina (repeatable)")
    parser.add_argument("--filter", type=float, default=0.5, metavar="R",
                        help="radius of the pixel filter in pixels: a box up to 0.5, else a Gaussian with a standard deviation "
                             "of R / 2, whose samples count for all pixels around in Patina and Mitsuba (default: 0.5)")
    parser.add_argument("--blur", type=float, default=0.0, metavar="ALPHA",
                        help="Patina's indirectRoughness; above 0 Cycles has its Filter Glossy 1, Blender's own default")


def errors_of(few, many):
    """:param few,many: images (runs, height, width, 3) of few and of many samples
    :returns: the mean relMSE of an image, of both"""
    mean = many.mean(axis=0)
    weight = 1.0 / (mean ** 2 + 0.01)
    spread = many.var(axis=0, ddof=1)
    of_mean = spread / len(many)  # what the reference itself is off by, in each pixel
    return (float(np.mean((((few - mean) ** 2).mean(axis=0) - of_mean) * weight)), float(np.mean(spread * weight)))


def to_target(low, high, errors, target):
    """:param low,high: samples of the two errors
    :returns: samples at which the error is the target, taking it for a power of them"""
    power = np.log(errors[0] / errors[1]) / np.log(high / low)
    return float(high * (errors[1] / target) ** (1.0 / max(power, 0.1)))


def measure(name, commands, options, pictures):
    with benchRun.Workers(name) as workers:
        scene = pathScenes.SCENES[name](workers.folder)
        for who, command in commands.items():
            workers.start(who, command, scene, settings_of(options))
        runs = experiment.turns(options.runs, [(who, n) for n in options.samples for who in workers],
                                lambda asked, run: workers.image(*asked, run))
    few, many = options.samples
    found = {}
    for who, worker in workers.items():
        images = {n: np.array([image for _, image in runs[who, n]], float) for n in options.samples}
        errors = errors_of(images[few], images[many])
        each = {}
        for clock in ("seconds", "processor"):
            took = {n: [took[clock] for took, _ in runs[who, n]] for n in options.samples}
            each[clock] = (statistics.median(took[many]) - statistics.median(took[few])) / (many - few)
            each[clock + "Spread"] = (max(took[many]) - min(took[many])) / statistics.median(took[many])
        wanted = to_target(few, many, errors, options.target)
        found[workers.title(who)] = {
            "ready": worker.ready, "errors": errors, "samplesToTarget": wanted, **each,
            "secondsToTarget": wanted * each["seconds"], "processorToTarget": wanted * each["processor"],
            "mean": float(np.mean(images[many]))}
        if pictures:
            from patina.cli import compiled

            mean = np.mean(images[many], axis=0).astype(np.float32)
            compiled.load().write_image(os.path.join(pictures, f"{name} {who}.exr".replace(" ", "-")), mean)
    return found


def show(name, found, options):
    own = found["Patina"]
    print(f"{name}: to a relMSE of {options.target:g}; what one sample of all pixels takes; its error at {options.samples[1]} "
          "samples")
    for who, row in found.items():
        print(f"  {who:<24}{row['secondsToTarget']:9.2f} s (processor {row['processorToTarget']:8.2f} s) "
              f"{1e3 * row['seconds']:8.1f} ms (processor {1e3 * row['processor']:8.1f}, spread "
              f"{100 * row['processorSpread']:3.0f} %) {row['errors'][1]:.2e}  ready after {row['ready']:5.1f} s  mean "
              f"{row['mean']:.3f}"
              + ("" if who == "Patina" else f"   Patina: x{own['secondsToTarget'] / row['secondsToTarget']:.2f}"
                 f" (processor x{own['processorToTarget'] / row['processorToTarget']:.2f})"), flush=True)


def main(arguments):
    parser = benchRun.Parser("path", __doc__, "192x108", runs=(5, "images of each"), depth=(8, "bounces"),
                               threads=(0, "of each renderer"))
    parser.add_argument("scenes", nargs="*", help=f"of {', '.join(pathScenes.SCENES)} (default: all)")
    parser.add_argument("--samples", default="8,64", help="few and many (default: 8,64)")
    parser.add_argument("--target", type=float, default=1e-3, help="relMSE (default: 1e-3)")
    add_choices(parser)
    parser.add_argument("--without", action="append", default=[], help="leaves a renderer out, as 'Cycles guided' (repeatable)")
    parser.add_argument("--images", metavar="FOLDER", help="writes what each renderer drew")
    options = parser.parse(arguments)
    options.samples = tuple(map(int, options.samples.split(",")))
    names = parser.known(options.scenes, pathScenes.SCENES,
                         len(options.samples) == 2 and options.samples[0] < options.samples[1] and options.runs >= 2,
                         "--samples takes few and many, --runs at least 2")
    asked = [name for name in ("Mitsuba", "Cycles") if name not in options.without]
    commands = {who: command for who, command in peers(*asked).items()
                if not any(who.startswith(name) for name in options.without)}
    for who in ("Mitsuba", "Cycles"):
        if not any(name.startswith(who) for name in commands):
            print(f"{who} is left out" if who in options.without else f"{who} is not installed here")
    if options.images:
        os.makedirs(options.images, exist_ok=True)
    results = {}
    for name in names:
        results[name] = measure(name, commands, options, options.images)
        show(name, results[name], options)
    outputs.write_json(options.json, {"size": options.pixels, "samples": options.samples, "depth": options.depth,
                                      "scenes": results})
    return 0
