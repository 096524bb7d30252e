# SPDX-License-Identifier: Apache-2.0
"""Each feature beside the renderer without it: processor time of a render with it over that without it, in runs that take
turns; or, by --charts FOLDER, error over time of both as charts and a table. Reading and compiling are not counted: a first
frame comes before.
"""
import argparse
import os
import statistics
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, ".."))

import featurePairs  # noqa: E402
import inProcess  # noqa: E402
from patina import experiment  # noqa: E402

RUNS = 5
COLUMNS = ("chart", "title", "line", "samples", "seconds", "relMSE", "secondsToFirst", "width", "reference")


def _stage(folder, name, variant, width):
    path = os.path.join(folder, name + ".usda")
    with open(path, "w", encoding="utf-8") as file:
        file.write(variant.text)
    return inProcess.Stage(path, *variant.arguments, "-w", width)


def _seconds(stage, samples, seed):
    """:returns: (processor seconds of all threads, image)"""
    begin = time.process_time()
    image = stage.image(seed, samples=samples)
    return time.process_time() - begin, image


def ratios(width, only=None, runs=RUNS):
    """:returns: list of dicts: feature, ratio with its least and largest, and seconds of both (medians)"""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for number, (name, pair) in enumerate(featurePairs.costs().items()):
            if only and only not in name:
                continue
            both = {which: _stage(folder, f"{which}{number}", variant, width)
                    for which, variant in (("with", pair.with_), ("without", pair.without))}
            for stage in both.values():
                stage.image(0, samples=1)
            times = experiment.turns(runs, both, lambda which, run: _seconds(both[which], pair.samples, run)[0])
            rows.append({"feature": name, **experiment.spread([a / b for a, b in zip(times["with"], times["without"])]),
                         "samples": pair.samples, **{which: statistics.median(column) for which, column in times.items()}})
    return rows


def measure(width=None, only=None, reference=None):
    """:returns: rows of COLUMNS"""
    from patina.chart import sceneMeasures

    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for chart, curve in featurePairs.curves().items():
            if only and only not in chart:
                continue
            wide, truth, lines = width or curve.width, None, {}
            for i, variant in enumerate(curve.variants.values()):  # what modules load at first is no variant's
                _stage(folder, f"{chart}first{i}", variant, 8).image(0, samples=1)
            for i, (line, variant) in enumerate(curve.variants.items()):
                begin = time.process_time()
                lines[line] = _stage(folder, f"{chart}{i}", variant, wide)
                lines[line].image(0, samples=1)
                first = time.process_time() - begin
                if truth is None:
                    truth = lines[line].image(1000, samples=reference or curve.reference)
                for seed, samples in enumerate(curve.samples):
                    runs = [_seconds(lines[line], samples, 10 * seed + k) for k in range(1, 4)]
                    errors = [sceneMeasures.errors(image, truth, with_flip=False)["relMSE"] for _, image in runs]
                    rows.append(dict(zip(COLUMNS, (chart, curve.title, line, samples, statistics.median(s for s, _ in runs),
                                                   statistics.mean(errors), first, wide, reference or curve.reference))))
    return rows


def draw(rows, folder):
    """:returns: paths of one SVG per chart"""
    from patina.chart import look
    from patina.chart.plot import Plot
    from patina.cli import outputs

    paths = []
    for chart in dict.fromkeys(row["chart"] for row in rows):
        own = [row for row in rows if row["chart"] == chart]
        plot = Plot(own[0]["title"], "processor seconds of sampling", "relMSE against the reference")
        for line, colour, kind in zip(dict.fromkeys(row["line"] for row in own), look.COLOURS, ("circle", "square")):
            plot.add(line, [(row["seconds"], row["relMSE"], f"{row['samples']}") for row in own if row["line"] == line], colour,
                     kind, below=kind == "square")
        paths.append(os.path.join(folder, chart + ".svg"))
        outputs.write_text(paths[-1], plot.svg())
    return paths


def read(path):
    numbers = ("samples", "seconds", "relMSE", "secondsToFirst", "width", "reference")
    return [{**row, **{name: float(row[name]) for name in numbers}, "samples": int(row["samples"])}
            for row in experiment.read_csv(path)]


def _write_charts(options):
    rows = measure(options.width, options.only, options.reference)
    os.makedirs(options.charts, exist_ok=True)
    experiment.write_csv(os.path.join(options.charts, "features.csv"), COLUMNS, rows, digits=4)
    print("\n".join(draw(rows, options.charts)))


def make_parser():
    parser = argparse.ArgumentParser(prog="patina bench features", description=__doc__)
    parser.add_argument("--charts", metavar="FOLDER", help="error over time as charts, with their table")
    parser.add_argument("--only", metavar="WORDS", help="features, or charts, whose name has these words")
    parser.add_argument("--width", type=int, help="of pictures, in pixels (64; of charts 48)")
    parser.add_argument("--reference", type=int, help="samples of the references of charts")
    parser.add_argument("--runs", type=int, default=RUNS)
    return parser


def main(arguments):
    options = make_parser().parse_args(arguments)
    if options.charts:
        _write_charts(options)
        return 0
    print("\n".join(experiment.table(("feature", "time with it, over that without", "seconds with, without"))))
    for row in ratios(options.width or 64, options.only, options.runs):
        print(experiment.table_row((row["feature"], f"{row['ratio']:.2f} ({row['least']:.2f} to {row['most']:.2f})",
                                    f"{row['with']:.2f}, {row['without']:.2f}")), flush=True)
    return 0
