# SPDX-License-Identifier: Apache-2.0
"""patina chart --predictions STAGE...: what the planner predicts against what comes."""
import os
import sys
from dataclasses import asdict

from patina import experiment, inputs
from patina.chart import predictions
from patina.chart.sceneCommand import failures, problem_of, shown
from patina.cli import outputs, overrides, recordFlags
from patina.cli.progress import Progress

TAKES_STAGES = True
DEFAULT_WIDTH, DEFAULT_SECONDS = 40, 20.0
DEFAULT_TOLERANCES = [0.001, 0.01, 0.05]


def add_arguments(parser):
    group = parser.add_argument_group("predictions")
    group.add_argument("--predictions", action="store_true",
                       help="for each stage and tolerance: the predicted error beside the measured one, and the time saved; "
                            "takes --imageWidth (here 40), --tolerances (here 0.001,0.01,0.05), --maxSamples and --seconds "
                            "(of one render, here 20)")
    group.add_argument("--methodSamples", type=recordFlags._count, default=256, metavar="N",
                       help="samples per pixel that methods are compared by (default: 256)")


def run(arguments):
    a = arguments
    a.imageWidth = a.imageWidth or DEFAULT_WIDTH
    a.set = a.set or []
    overrides.parse(a.set)
    given = a.tolerances or DEFAULT_TOLERANCES
    maximum = a.maxSamples or recordFlags.MAX_SAMPLES
    rows = []
    for stage in a.stages:
        inputs.note(stage)
    outputs.check_all([a.json])
    progress = Progress("", a.quiet)
    table = Table(a.out)
    for stage in dict.fromkeys(a.stages):
        for backend in (["embree", "raster"] if a.backend == "both" else [a.backend]):
            for row in _rows(stage, a, backend, given, maximum):
                rows.append(row)
                table.add(row)
                if not row.problem:
                    progress.say(f"{row.stage} {row.backend} {row.tolerance:g}: {row.methodError:.2g}, {row.error:.2g}, "
                                 f"{row.state}")
    if not outputs.write_json(a.json, [asdict(row) for row in rows]):
        print(predictions.listing(rows))
    problems = [row for row in rows if row.problem]
    for row in problems:
        print(f"patina: {row.stage}, {row.backend}: {row.problem}", file=sys.stderr)
    return 1 if problems else 0


def _rows(stage, a, backend, tolerances, maximum):
    name = shown(os.path.splitext(os.path.basename(stage))[0])
    try:
        yield from predictions.check(stage, name, a, backend, tolerances, a.methodSamples, maximum,
                                     a.seconds or DEFAULT_SECONDS)
    except failures() as error:
        yield predictions.Row(name, backend, 0.0, problem=problem_of(error))


class Table:
    """predictions.csv in a folder, or nothing; it is there after each row, for the whole takes long."""

    def __init__(self, folder):
        self.path, self.rows = os.path.join(folder, "predictions.csv") if folder else "", []
        if folder:
            outputs.make_folder(folder)
            self._write()

    def add(self, row):
        self.rows.append(asdict(row))
        if self.path:
            self._write()

    def _write(self):
        experiment.write_csv(self.path, predictions.COLUMNS, self.rows, digits=4)
