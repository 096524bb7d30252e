# SPDX-License-Identifier: Apache-2.0
"""Rows of measured methods: CSV, SVG, and the table that is compiled in."""
import os
import re
from collections import defaultdict

from patina import experiment
from patina.chart import look, measurePaths, measureSubdivision
from patina.chart.front import pareto
from patina.chart.plot import Plot
from patina.cli import outputs
from patina.cli.compiled import _patina

COLUMNS = ("point", "method", "subject", "errorOf", "ns", "nsLow", "nsHigh", "cost", "mean", "largest", "rms")

_TABLE_HEAD = """\
// SPDX-License-Identifier: Apache-2.0
// Written by `patina chart --lobes --table`: measure again after a change to a lobe or a method.
#include "materialNetwork/plan/methodTable.h"

namespace patina {

// clang-format off
const std::vector<MeasuredMethod>& methodTable() {
    static const MethodCells truths[] = {
"""
_TABLE_ROWS = """\
    };
    static const std::vector<MeasuredMethod> rows = {
"""
_TABLE_TAIL = """\
    };
    return rows;
}
// clang-format on

} // namespace patina
"""


def measure(point, timed=True):
    """Rows of one choice point, or of all for an empty name: those of lobes, and those that take whole pictures."""
    rows = _patina.measure_methods(point, timed)
    for name, pictures in (("subdivision", measureSubdivision.rows), ("pathDepth", measurePaths.path_depth),
                           ("roulette", measurePaths.roulette)):
        if point in ("", name):
            rows += pictures(timed)
    return rows


def with_cost(rows, points):
    """Adds `cost`, the time over that of the point's default method on the same subject, and orders rows: those that are
    only measured stand behind the renderer's.

    :param points: choice points with their methods, as _patina.choice_points() gives them
    """
    places = {point: i for i, (point, _) in enumerate(points)}
    order = {(point, name): k for point, methods in points for k, (name, _) in enumerate(methods)}
    default = {row["point"]: row["method"] for row in reversed(rows)}
    default.update((point, methods[0][0]) for point, methods in points)
    reference = {(row["point"], row["subject"]): row["ns"] for row in rows if row["method"] == default[row["point"]]}
    for row in rows:
        # Counts of samples or passes are told after the subject, which the default has without one too.
        alone = re.sub(r", \d+ (samples|passes)$", "", row["subject"])
        # The default of the diffuse model is the node's own choice: its cost is that of the first row.
        first = next(r["ns"] for r in rows if r["point"] == row["point"] and r["subject"] == row["subject"])
        base = reference.get((row["point"], row["subject"]), reference.get((row["point"], alone), first))
        row["cost"] = row["ns"] / base if base > 0.0 else 1.0
    return sorted(rows, key=lambda row: (places.get(row["point"], len(places)),
                                         order.get((row["point"], row["method"]), len(order))))


def of_renderer(rows, points):
    """:returns: the rows without methods that are only measured: what the planner's table has"""
    names = {(point, name) for point, methods in points for name, _ in methods}
    return [row for row in rows if (row["point"], row["method"]) in names]


def merged(rows, table, point):
    """The table with these rows in place of those it has of a point."""
    found = next((i for i, row in enumerate(table) if row["point"] == point), len(table))
    return table[:found] + rows + [row for row in table[found:] if row["point"] != point]


def with_times(rows, table):
    """Gives rows that were measured without times those of the table that is built in; a method or subject that is
    not in it takes the mean of its point's default method.
    """
    known = {(row["point"], row["method"], row["subject"]): row for row in table}
    for row in rows:
        found = known.get((row["point"], row["method"], row["subject"]))
        if not found:
            found = next((r for r in table if (r["point"], r["method"]) == (row["point"], row["method"])), None)
        ns = found["ns"] if found else next((r["ns"] for r in table if r["point"] == row["point"]), 0.0)
        row["ns"] = row["nsLow"] = row["nsHigh"] = ns
    return rows


def write_csv(rows, path):
    experiment.write_csv(path, COLUMNS, rows)


def write_table(rows, path):
    """The C++ data of materialNetwork/methodTable.h."""
    def number(value):
        text = f"{value:.4g}"
        return (text if "." in text or "e" in text else text + ".0") + "f"

    def cells(values):
        return "{" + ", ".join("0" if value == 0.0 else number(float(f"{value:.3g}")) for value in values) + "}"

    with outputs.writing(path) as file:
        truths = list(dict.fromkeys(cells(row["truths"]) for row in rows))  # methods of a subject share them
        file.write(_TABLE_HEAD)
        file.writelines(f"        {truth},\n" for truth in truths)
        file.write(_TABLE_ROWS)
        for row in rows:
            texts = ", ".join(f'"{row[name]}"' for name in ("point", "method", "subject", "errorOf"))
            numbers = ", ".join(number(row[name]) for name in ("ns", "cost", "mean", "largest", "rms"))
            where = f'"{row["kind"]}", {number(row["reflectance"])}, "{row["axis"]}", {number(row["axisEnd"])}'
            file.write(f"        {{{texts}, {numbers},\n         {where},\n         {cells(row['errors'])}, "
                       f"truths[{truths.index(cells(row['truths']))}]}},\n")
        file.write(_TABLE_TAIL)


def write_charts(rows, folder):
    """One SVG per choice point and subject, of time against mean error.

    :returns: the paths
    """
    charts = defaultdict(list)
    for row in rows:
        charts[row["point"], row["subject"]].append(row)
    paths = []
    for (point, subject), group in charts.items():
        points = [(row["ns"], row["mean"], row["method"]) for row in group]
        name = "".join(c if c.isalnum() else "_" for c in f"{point}_{subject}") + ".svg"
        path = os.path.join(folder, name)
        outputs.write_text(path, scatter(f"{point}, {subject}", points, f"mean error ({group[0]['errorOf']})"))
        paths.append(path)
    return paths


def scatter(title, points, y_label):
    """:param points: list of (ns, error, method); exact ones stand below all others
    :returns: an `svg` element"""
    plot = Plot(title, "ns per evaluation, one thread", y_label)
    low = 0.3 * min((error for _, error, _ in points if error > 0.0), default=1.0)
    shown = [(ns, error, method) if error > 0.0 else (ns, low, method + " (0)") for ns, error, method in points]
    for i, (ns, error, name) in enumerate(shown):
        plot.add(name, [(ns, error, "")], look.COLOURS[i % len(look.COLOURS)])
    plot.set_front([point[:2] for point in pareto(shown)])
    return plot.svg()


def listing(rows):
    """The rows as text, for a terminal."""
    wide = {name: max([14] + [len(row[name]) + 1 for row in rows]) for name in ("method", "subject")}
    method, subject = wide["method"], wide["subject"]
    lines = [f"{'choice point':<19}{'method':<{method}}{'subject':<{subject}}{'ns':>9}{'cost':>8}  {'mean error':>10}"
             f"{'largest':>10}{'RMSE*65535':>12}"]
    for row in rows:
        lines.append(f"{row['point']:<19}{row['method']:<{method}}{row['subject']:<{subject}}{row['ns']:>9.1f}"
                     f"{row['cost']:>8.2f}  {row['mean']:>10.2g}{row['largest']:>10.2g}{row['rms'] * 65535:>12.1f}")
    return "\n".join(lines)
