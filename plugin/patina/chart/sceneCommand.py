# SPDX-License-Identifier: Apache-2.0
"""patina chart STAGE...: seconds against error of both back ends."""
import math
import os
import shlex
import sys

from patina import inputs
from patina.chart import machine, sceneCharts, sceneLadder, scenePage, sceneResults
from patina.chart.sceneRenders import BACKENDS, DEFAULT_WIDTH, WORDS
from patina.cli import denoiser, imageMetrics, methods, outputs, overrides, recordFlags
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError, UsageError
from patina.cli.progress import Progress
from patina.cli.usd import reader

DEFAULT_SAMPLES, DEFAULT_TOLERANCES = 64, "0.05,0.01"


def add_arguments(parser):
    group = parser.add_argument_group("scenes")
    group.add_argument("--backend", default="both", choices=["both", *BACKENDS], help="the renderer (default: both)")
    group.add_argument("--imageWidth", "-w", type=recordFlags._size, metavar="PIXELS",
                       help=f"width of the images (default: {DEFAULT_WIDTH})")
    group.add_argument("--maxSamples", type=recordFlags._count, metavar="N",
                       help=f"the last of 1, 4, 16, ... samples per pixel, also for tolerances (default: {DEFAULT_SAMPLES})")
    group.add_argument("--tolerances", type=_tolerances, metavar="T[,T...]",
                       help=f"also render to each of these tolerances; none: to no tolerance (default: {DEFAULT_TOLERANCES})")
    group.add_argument("--seconds", type=recordFlags._not_negative, default=0.0, metavar="S",
                       help="time for each stage: fewer samples where all would take longer (default: 0, no limit)")
    group.add_argument("--referenceSamples", type=recordFlags._count, metavar="N",
                       help="samples of the reference (default: 16 times the most samples tested)")
    group.add_argument("--reference", metavar="FILE", help="an OpenEXR, HDR or PFM image to compare with instead (one stage)")
    group.add_argument("--camera", "-cam", metavar="PATH", help="as in patina record")
    group.add_argument("--threads", type=recordFlags._count, default=0, metavar="N", help="threads (default: all cores)")
    group.add_argument("--seed", type=recordFlags._seed, default=0, metavar="N", help="seed of the first render (default: 0)")
    group.add_argument("--set", action="append", default=[], metavar="PRIM.INPUT=VALUE", help=overrides.SET_HELP)
    group.add_argument("--denoise", action="store_true",
                       help="also the path tracer's images as Open Image Denoise cleans them; those to a tolerance end when "
                            "they are within it")
    methods.add_flag(group)
    group.add_argument("--quiet", "-q", action="store_true", help="no progress")


def _tolerances(text):
    if text == "none":
        return []
    values = [float(word) for word in text.split(",")]
    if not values or not all(v > 0.0 and math.isfinite(v) for v in values):
        raise ValueError
    return list(dict.fromkeys(values))


_tolerances.__name__ = "list of numbers above 0"


def run(arguments):
    a = arguments
    a.maxSamples = a.maxSamples or DEFAULT_SAMPLES
    a.tolerances = _tolerances(DEFAULT_TOLERANCES) if a.tolerances is None else a.tolerances
    if a.reference and len(a.stages) > 1:
        raise UsageError("patina chart: --reference is of one stage")
    chosen = methods.parse(a.method)
    overrides.parse(a.set)
    if a.denoise:
        denoiser.prepare(_patina)
    outputs.make_folder(a.out)
    command = shown(shlex.join(["patina", *sys.argv[1:]]))
    for stage in a.stages:
        inputs.note(stage)
    inputs.note(a.reference)
    if a.reference and not os.path.isfile(a.reference):  # before hours of renders
        raise CommandError(f"there is no file {a.reference}")
    outputs.check_all([a.json])
    here = machine.describe()
    if imageMetrics.flip_missing():
        print(f"patina: {imageMetrics.flip_missing()}", file=sys.stderr)
    progress = Progress("", a.quiet)
    results = []
    for stage in dict.fromkeys(a.stages):
        results.append(_chart(stage, a, chosen, progress))
        if a.out:  # after each: what an interrupted run has measured stays
            _write(results, a.out, here, command, a.seed)
    outputs.write_json(a.json, sceneResults.as_json(results, here, command) if a.json else None)
    if a.json != "-":
        texts = [listing(result) for result in results if not result.problem]
        if a.out:
            texts.append(os.path.join(a.out, "index.html"))
        if texts:
            print(shown("\n\n".join(texts), keep="\n"))
    problems = [f"{r.stage}: {r.problem}" for r in results if r.problem]
    problems += [f"{r.stage}: {p}" for r in results if r.ladder for p in r.ladder.problems]
    for problem in problems:
        print("patina: " + shown(" ".join(problem.split())), file=sys.stderr)
    return 1 if problems else 0


def _chart(stage, arguments, chosen, progress):
    """:returns: a StageResult; with its problem, where there is one"""
    name = shown(os.path.basename(stage))
    try:
        ladder = sceneLadder.climb(stage, arguments, chosen, truth(chosen),
                                   os.path.join(arguments.out, "references") if arguments.out else "",
                                   lambda text: progress.say(f"{name}: {text}"))
        return sceneResults.of(shown(stage), ladder, arguments.seed)
    except failures() as error:
        return sceneResults.StageResult(shown(stage), problem=problem_of(error))


def failures():
    """:returns: errors that end one stage of several"""
    return CommandError, reader.StageError, UsageError, RuntimeError, OSError, MemoryError


def problem_of(error):
    """:returns: what one of failures() says, in one line"""
    return shown(" ".join(str(error).split())) or type(error).__name__


def shown(text, keep=""):
    """Text that every file may hold: names of files can have any bytes."""
    return "".join(c if c.isprintable() or c in keep else "?" for c in text)


def truth(chosen):
    """Methods of the reference: those that change what a material means, not how exactly it is computed."""
    measured = {row["point"] for row in _patina.method_table()}
    return {point: name for point, name in chosen.items() if point not in measured}


def _write(results, folder, here, command, seed):
    try:
        sceneResults.write_csv(results, os.path.join(folder, "scenes.csv"))
        sceneCharts.write([r for r in results if not r.problem], folder, machine.sentence(here))
        scenePage.write(results, os.path.join(folder, "index.html"), here, command, seed)
    except OSError as error:
        raise CommandError(f"cannot write {error.filename}: {error.strerror}") from error


def listing(result):
    """A stage's rows and findings as text, for a terminal."""
    lines = [result.stage, f"  {'back end':<15}{'samples':>8}{'tolerance':>11}{'seconds':>10}{'in all':>9}{'relMSE':>11}"
                           f"{'FLIP':>8}{'bias':>10}"]
    for row in result.rows:
        tolerance = f"{row['tolerance']:g}{'' if row['toleranceMet'] == 'yes' else '!'}" if row["tolerance"] else ""
        flip = "-" if row["flip"] is None else f"{row['flip']:.4f}"
        bias = "-" if row["meanError"] is None else f"{100 * row['meanError']:+.2f} %"
        error = "-" if row["relMSE"] is None else f"{row['relMSE']:.3g}"
        lines.append(f"  {WORDS[row['backend']]:<15}{row['samples']:>8.4g}{tolerance:>11}{row['seconds']:>10.3g}"
                     f"{row['secondsInAll']:>9.3g}{error:>11}{flip:>8}{bias:>10}")
    for measure, found in result.crossovers.items():
        lines.append(f"  by {sceneResults.NAMES[measure]}: {found['text']}")
    for backend, found in result.slopes.items():
        if found:
            tiles = f", {found['byTile']['median']:.2f} by tile" if found["byTile"] else ""
            lines.append(f"  slope of the {WORDS[backend]}: {found['slope']:.2f}{tiles}")
    lines += [f"  {note}" for note in result.ladder.notes]
    return "\n".join(lines)
