# SPDX-License-Identifier: Apache-2.0
"""Measures how image A differs from the reference B.

Values are compared as they are in the files: linear radiance in OpenEXR and HDR files, display
values from 0 to 1 in the others. NaN and infinite values are counted first; pixels with such values
are left out of the metrics. FLIP comes from NVIDIA's flip-evaluator, where it is installed
(`pip install flip-evaluator`): its HDR form for linear files, else the one for display values.

  RMSE                 square root of the mean squared difference
  relMSE               mean of (a-b)^2 / (b^2 + 0.01)
  FLIP                 mean of the error map, 0 to 1
  signed mean error    mean of a-b: energy won or lost; also relative to the mean of B
  largest difference   with the pixel, counted from the upper left corner
"""
import os
import sys

from patina import inputs
from patina.cli import imageMetrics, outputs
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError, UsageError

LINEAR = (".exr", ".hdr", ".pfm")
METRICS = ("rmse", "relMSE", "flip", "meanError", "maxDifference", "nan", "inf")


def add_arguments(parser):
    parser.add_argument("a", metavar="A", help="the image to judge")
    parser.add_argument("b", metavar="B", help="the reference")
    parser.add_argument("--aov", default="color", metavar="NAME",
                        help="which channels of OpenEXR files: color (R, G, B), alpha, or the name before the "
                             "last dot, as in albedo.R (default: color)")
    parser.add_argument("--fail", action="append", default=[], metavar="METRIC=LIMIT",
                        help=f"exit with 1 if a metric's size is above a limit; one of {', '.join(METRICS)} "
                             "(repeatable)")
    parser.add_argument("--no-flip", action="store_true", help="leave FLIP out: it takes the longest")
    parser.add_argument("--json", metavar="FILE", help="write the numbers as JSON: --json to standard output, "
                                                       "--json=FILE to a file")


def run(arguments):
    limits = _limits(arguments.fail)
    for path in (arguments.a, arguments.b):
        inputs.note(path)
    outputs.check_all([arguments.json])
    a, b = (_read(path, arguments.aov) for path in (arguments.a, arguments.b))
    if a.shape != b.shape:
        raise CommandError(f"{arguments.a} is {_size(a)}, but {arguments.b} is {_size(b)}")
    result = measure(a, b, _is_linear(arguments.a) and _is_linear(arguments.b),
                     not arguments.no_flip)
    _show(result, arguments)
    if result["channels"] == 3 and not arguments.no_flip and imageMetrics.flip_missing():
        print(f"patina: {imageMetrics.flip_missing()}", file=sys.stderr)
    over = [f"{name} {value:.6g} > {limit:.6g}" for name, limit in limits.items()
            for value in [_metric(result, name)] if not abs(value) <= limit]
    if over:
        raise CommandError(f"{arguments.a} differs too much from {arguments.b}: {', '.join(over)}")


def measure(a, b, linear, with_flip=True):
    """:returns: dict of everything that the command shows"""
    result = {"width": a.shape[1], "height": a.shape[0], "channels": a.shape[2],
              "notFinite": {"a": imageMetrics.count_not_finite(a), "b": imageMetrics.count_not_finite(b)}}
    result.update(imageMetrics.differences(a, b))
    result["flip"] = imageMetrics.mean_flip(a, b, linear) if with_flip and a.shape[2] == 3 else None
    return result


def _limits(texts):
    limits = {}
    for text in texts:
        name, _, limit = text.partition("=")
        if name not in METRICS:
            raise UsageError(f"patina compare: --fail {text}: no such metric (there are: {', '.join(METRICS)})")
        try:
            limits[name] = float(limit)
        except ValueError:
            raise UsageError(f"patina compare: --fail {text}: '{limit}' is no number") from None
    return limits


def _metric(result, name):
    if name in ("nan", "inf"):
        return float(result["notFinite"]["a"][name])
    value = result[name]
    if value is not None:
        return value
    if result["rmse"] is None:
        raise CommandError(f"{name} could not be measured: no pixel is a number in both images")
    if imageMetrics.flip_missing():
        raise CommandError(f"{name} could not be measured: {imageMetrics.flip_missing()}")
    raise CommandError(f"{name} could not be measured: the reference is black")


def _is_linear(path):
    return path.lower().endswith(LINEAR)


def _size(image):
    return f"{image.shape[1]} x {image.shape[0]} with {image.shape[2]} channels"


def _read(path, aov):
    if not os.path.exists(path):
        raise CommandError(f"there is no file {path}")
    image = _patina.read_image(path)
    if aov == "color":
        chosen = [i for name in "RGB" for i, c in enumerate(image.channels) if c == name]
        if len(chosen) != 3:  # grey images
            chosen = [i for i, c in enumerate(image.channels) if c != "A"][:3]
    elif aov == "alpha":
        chosen = [i for i, c in enumerate(image.channels) if c == "A"]
    else:
        chosen = [i for i, c in enumerate(image.channels) if c == aov or c.rpartition(".")[0] == aov]
    if not chosen:
        raise CommandError(f"{path} has no channels of {aov} (it has: {', '.join(image.channels)})")
    return image.pixels[..., chosen]


def _show(result, arguments):
    if arguments.json:
        outputs.write_json(arguments.json, result)
        return
    for label, path in (("a", arguments.a), ("b", arguments.b)):
        bad = result["notFinite"][label]
        if bad["nan"] or bad["inf"]:
            print(f"{path}: {bad['nan']} NaN, {bad['inf']} infinite values")
    if result["rmse"] is None:
        print("no pixel is a number in both images")
        return
    relative = result["relativeMeanError"]
    print(f"RMSE                {result['rmse']:.6g}")
    print(f"relMSE              {result['relMSE']:.6g}")
    print("FLIP                " + ("not measured" if result["flip"] is None else f"{result['flip']:.6g}"))
    print(f"signed mean error   {result['meanError']:+.6g}" +
          ("" if relative is None else f" ({100 * relative:+.4g} %)"))
    where = result["maxAt"]
    print(f"largest difference  {result['maxDifference']:.6g}" + (f" at {where[0]}, {where[1]}" if where else ""))
