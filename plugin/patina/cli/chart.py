# SPDX-License-Identifier: Apache-2.0
"""Measures and draws the cost and the error of methods and renderers, on this machine.

  patina chart STAGE... --out FOLDER                seconds against error of both back ends: CSV, SVG and an HTML page
  patina chart --lobes                              all choice points of lobes: rows, CSV and SVG
  patina chart --lobes --point directionalAlbedo    one of them
  patina chart --lobes --table materialNetwork/plan/methodTableData.cpp
                                                    also writes the table that --method list shows; with --point,
                                                    the rest of it as it is built in
  patina chart --stability --out FOLDER             methods through the regions where they fail: CSV, SVG, an HTML page
  patina chart --predictions STAGE... --out FOLDER  errors that the planner predicts, beside the true ones: CSV

Scenes: every back end renders with 1, 4, 16, ... samples and to each of --tolerances; errors are those against a path traced
reference of another seed, 16 times the samples and the most exact methods. Times are of warm renders, medians of three where
these are short. Columns of scenes.csv besides plain ones:
  seconds, secondsInAll   of sampling; with reading the stage and the first frame's building of scene and shaders
  cores                   that a render had on the average: few where other work slowed it
  relMSE rmse flip        as in patina compare
  meanError               signed, over the mean of the reference
  relative                mean of |error| / (luminance + 0.01), which is what a tolerance is about
  ...Direct               the rasterizer against direct light alone, which is all that it draws
Lobes: times are medians of 31 batches on one thread; a busy machine shows in the quartiles (nsLow, nsHigh). Errors do not
depend on the machine.
"""
from patina.chart import lobesCommand, predictionsCommand, sceneCommand, stabilityCommand
from patina.cli.errors import UsageError

# flag -> module that has add_arguments(parser) and run(arguments); without a flag stages are charted
NAMES_OF_ANY_BYTES = True  # a stage that cannot be opened is one of several
CHARTS = {"lobes": lobesCommand, "predictions": predictionsCommand, "stability": stabilityCommand}


def add_arguments(parser):
    parser.add_argument("stages", metavar="STAGE", nargs="*", help="chart these .usd, .usda, .usdc or .usdz files")
    parser.add_argument("--out", default="", metavar="FOLDER", help="where CSV, SVG and HTML files go (made if missing)")
    parser.add_argument("--json", metavar="FILE", help="write the rows as JSON: --json to standard output, "
                                                       "--json=FILE to a file")
    for module in (*CHARTS.values(), sceneCommand):
        module.add_arguments(parser)


def run(arguments):
    chosen = [name for name in CHARTS if getattr(arguments, name)]
    of_stages = len(chosen) == 1 and getattr(CHARTS[chosen[0]], "TAKES_STAGES", False)
    if of_stages != bool(chosen and arguments.stages) or not chosen and not arguments.stages or len(chosen) > 1:
        raise UsageError("patina chart: say what to chart: stages, or one of " +
                         ", ".join("--" + name for name in CHARTS))
    return CHARTS[chosen[0]].run(arguments) if chosen else sceneCommand.run(arguments)
