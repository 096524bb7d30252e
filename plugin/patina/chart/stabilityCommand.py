# SPDX-License-Identifier: Apache-2.0
"""patina chart --stability: every method through the region where it fails, with the bound that holds there."""
import os

from patina import experiment
from patina.chart import stabilityPage, sweepsClassic, sweepsDiffuse, sweepsEnergy, sweepsMicrofacets, sweepsFilm, sweepsFrames
from patina.chart import sweepsFresnel, sweepsLayers, sweepsPlan, sweepsSequences, sweepsSky
from patina.cli import outputs
from patina.cli.errors import CommandError, UsageError

FAMILIES = {"Fresnel": sweepsFresnel, "facets": sweepsMicrofacets, "energy": sweepsEnergy, "diffuse": sweepsDiffuse,
            "film": sweepsFilm, "layers": sweepsLayers, "classic": sweepsClassic, "frames": sweepsFrames, "sky": sweepsSky,
            "plan": sweepsPlan, "sequences": sweepsSequences}
COLUMNS = ("sweep", "x", "method", "value", "truth", "error", "bound", "chosen")


def add_arguments(parser):
    group = parser.add_argument_group("stability")
    group.add_argument("--stability", action="store_true", help="methods through the regions where they fail: an atlas")
    group.add_argument("--points", type=int, default=40, metavar="N", help="points of each sweep, 4 or more (default: 40)")
    group.add_argument("--family", default="", metavar="NAME", help="only this one of " + ", ".join(FAMILIES))


def sweeps(points, family=""):
    """:returns: the sweeps of a family, or of all"""
    return [sweep for name, module in FAMILIES.items() if family in ("", name) for sweep in module.sweeps(points)]


def run(arguments):
    if arguments.points < 4:
        raise UsageError("patina chart: --points is 4 or more")
    if arguments.family and arguments.family not in FAMILIES:
        raise UsageError(f"patina chart: there is no family '{arguments.family}' (there are: {', '.join(FAMILIES)})")
    outputs.check_all([arguments.json])
    outputs.make_folder(arguments.out)
    found = sweeps(arguments.points, arguments.family)
    rows = [row for sweep in found for row in sweep.rows()]
    if arguments.out:
        experiment.write_csv(os.path.join(arguments.out, "stability.csv"), COLUMNS, rows, digits=None)
        stabilityPage.write(found, arguments.out)
    if not outputs.write_json(arguments.json, rows):
        print(stabilityPage.listing(found))
    problems = [problem for sweep in found for problem in sweep.problems()]
    if problems:
        raise CommandError(f"{len(problems)} bounds do not hold; first: {problems[0]}")
    return 0
