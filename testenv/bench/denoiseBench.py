# SPDX-License-Identifier: Apache-2.0
"""Denoised images: seconds until they look like the reference, beside Cycles.

The scenes are those of `patina bench path`. Every renderer draws them with ever more samples until the mean FLIP (HDR;
Andersson et al. 2020) beside its own reference is below the last target. A reference is one image of many samples, without
denoiser, methods and blur. Times are of processors, with the denoiser's and without what is done once per scene; a row is the
median of the runs, which have seeds of their own. Between two numbers of samples the error is taken for a power of time. Cycles
is that of `patina bench path`, denoised by its own denoiser.
"""
import math
import statistics

import benchRun
import pathBench
import pathScenes
from patina import experiment
from patina.cli import outputs


def commands(without):
    """:returns: name -> command without the folder"""
    from patina.cli import compiled, denoiser

    denoiser.prepare(compiled.load())
    found = pathBench.peers(*{"Cycles"}.difference(without))
    return {who: command for who, command in found.items() if who not in without}


def time_to(points, target):
    """:param points: (seconds, error) of ever more samples
    :returns: seconds at which the error is the target, and whether that is a bound only: "<", ">" or "" """
    for i, (seconds, error) in enumerate(points):
        if error > target:
            continue
        if i == 0:
            return seconds, "<"
        before, higher = points[i - 1]
        share = math.log(higher / target) / max(math.log(higher / error), 1e-9)
        return before * (seconds / before) ** share, ""
    return points[-1][0], ">"


def climb(workers, who, reference, options):
    """:returns: list of (samples, median of seconds, median of errors) until the last target is met"""
    from patina.cli import imageMetrics

    rungs = []
    for samples in options.samples:
        runs = [workers.image(who, samples, run + 1) for run in range(options.runs)]
        rungs.append((samples, statistics.median(took["processor"] for took, _ in runs),
                      statistics.median(imageMetrics.mean_flip(image, reference, True) for _, image in runs)))
        if rungs[-1][2] < min(options.targets):
            break
    return rungs


def measure(name, options):
    with benchRun.Workers(name) as workers:
        scene = pathScenes.SCENES[name](workers.folder)
        for who, command in commands(options.without).items():
            workers.start(who, command, scene, {**pathBench.settings_of(options), "denoise": True})
        references = {who: workers.image(who, options.reference, 1000, plain=True)[1] for who in workers}
        return {workers.title(who): climb(workers, who, reference, options) for who, reference in references.items()}


def show(name, found, options):
    times = {who: [time_to([rung[1:] for rung in rungs], target) for target in options.targets]
             for who, rungs in found.items()}
    own = times["Patina"]
    for k, target in enumerate(options.targets):
        cells = []
        for who in found:
            seconds, bound = times[who][k]
            ratio = "" if times[who] is own else f" ({bound and '<' if bound == '>' else ''}{own[k][0] / seconds:.2f})"
            cells.append(f"{bound} {seconds:.2f} s{ratio}".strip())
        print(experiment.table_row([name, f"{target:g}", *cells]), flush=True)


def main(arguments):
    from patina.cli import imageMetrics
    from patina.cli.errors import CommandError

    parser = benchRun.Parser("denoise", __doc__, "192x108", reference=(1024, "samples of the references"),
                               runs=(5, "images of each"), depth=(8, "bounces"), threads=(0, "of each renderer"))
    parser.add_argument("scenes", nargs="*", help=f"of {', '.join(pathScenes.SCENES)} (default: all)")
    parser.add_argument("--samples", default="1,2,4,8,16,32,64,128,256", help="ever more (default: 1,2,4 ... 256)")
    pathBench.add_choices(parser)
    parser.add_argument("--targets", default="0.05,0.02", help="mean FLIP, falling (default: 0.05,0.02)")
    parser.add_argument("--without", action="append", default=[], choices=["Cycles", "Cycles guided"],
                        help="leaves a renderer out; Cycles: both")
    options = parser.parse(arguments)
    options.samples = sorted(map(int, options.samples.split(",")))
    options.targets = sorted(map(float, options.targets.split(",")), reverse=True)
    names = parser.known(options.scenes, pathScenes.SCENES, options.runs >= 1, "--runs takes at least 1")
    if imageMetrics.flip_missing():
        raise CommandError(imageMetrics.flip_missing())
    results = {}
    for name in names:
        results[name] = measure(name, options)
        if len(results) == 1:
            heads = [who + ("" if who == "Patina" else " (ratio)") for who in results[name]]
            print("\n".join(experiment.table(["scene", "mean FLIP", *heads])))
        show(name, results[name], options)
    outputs.write_json(options.json, {"size": options.pixels, "reference": options.reference, "scenes": results})
    return 0
