# SPDX-License-Identifier: Apache-2.0
"""patina chart --lobes: ns per evaluation against error of every method."""
import os

from patina.chart import lobes
from patina.cli import outputs
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError, UsageError


def add_arguments(parser):
    group = parser.add_argument_group("methods of lobes")
    group.add_argument("--lobes", action="store_true", help="ns per evaluation against error, per method")
    group.add_argument("--point", default="", metavar="NAME", help="only this choice point")
    group.add_argument("--errors", action="store_true",
                       help="measure errors only; times are those of the table that is built in")
    group.add_argument("--table", default="", metavar="FILE",
                       help="writes the C++ table of measured methods; with --point, other points as they are built in")


def run(arguments):
    points = _patina.choice_points()
    names = [point for point, _ in points]
    outputs.check_all([arguments.table, arguments.json])
    outputs.make_folder(arguments.out)
    rows = lobes.measure(arguments.point, not arguments.errors)
    if not rows and arguments.point not in names:
        raise UsageError(f"patina chart: there is no choice point '{arguments.point}' (there are: {', '.join(names)})")
    if not rows:
        raise CommandError(f"nothing is measured at '{arguments.point}': its methods differ in meaning, not in accuracy")
    if arguments.errors:
        rows = lobes.with_times(rows, _patina.method_table())
    rows = lobes.with_cost(rows, points)
    if arguments.table:
        table = lobes.of_renderer(rows, points)
        if arguments.point:
            table = lobes.merged(table, _patina.method_table(), arguments.point)
        lobes.write_table(table, arguments.table)
    if arguments.out:
        lobes.write_csv(rows, os.path.join(arguments.out, "lobes.csv"))
        lobes.write_charts(rows, arguments.out)
    if not outputs.write_json(arguments.json, rows):
        print(lobes.listing(rows))
    return 0
