# SPDX-License-Identifier: Apache-2.0
"""patina chart --lobes, and what --method list says of what it measured."""
import csv
import json
import os
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from patina.chart import lobes, measurePaths, measureSubdivision
from patina.cli import compiled, main

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
MEASURED = ("energyCompensation", "directionalAlbedo", "sampling", "fresnel", "thinFilm", "diffuse", "sheen",
            "subsurface", "areaLight", "domeLight")


def test_rows_csv_and_charts(capsys, tmp_path):
    out = tmp_path / "charts"
    assert main.main(["chart", "--lobes", "--point", "fresnel", "--out", str(out), "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {row["method"] for row in rows} == {"exact", "schlick", "f82"}
    assert all(row["nsLow"] <= row["ns"] <= row["nsHigh"] for row in rows)
    assert all(row["cost"] == 1.0 for row in rows if row["method"] == "exact")
    with open(out / "lobes.csv", newline="", encoding="utf-8") as file:
        written = list(csv.DictReader(file))
    assert [row["method"] for row in written] == [row["method"] for row in rows]
    for row in rows:
        assert float(written[rows.index(row)]["mean"]) == pytest.approx(row["mean"], rel=1e-5)
    charts = sorted(out.glob("*.svg"))
    assert len(charts) == len({row["subject"] for row in rows})
    for chart in charts:
        assert ElementTree.parse(chart).getroot().tag.endswith("svg")


def test_errors_are_those_of_the_table():
    """The compiled-in table is the one measured now; times are the machine's, errors are not. Methods that the renderer does
    not have are in the chart's table alone."""
    patina = compiled.load()
    table = {(r["point"], r["method"], r["subject"]): r for r in patina.method_table()}
    rows = patina.measure_methods("", False)
    assert {r["point"] for r in rows} == set(MEASURED)
    assert len(lobes.of_renderer(rows, patina.choice_points())) == sum(point in MEASURED for point, _, _ in table)
    with open(os.path.join(ROOT, "docs", "charts", "lobes.csv"), newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            table.setdefault((row["point"], row["method"], row["subject"]),
                             {name: float(row[name]) for name in ("mean", "largest", "rms")})
    for row in rows:
        known = table[row["point"], row["method"], row["subject"]]
        for figure in ("mean", "largest", "rms"):
            assert row[figure] == pytest.approx(known[figure], rel=0.02, abs=2e-6), row


def cells(row):
    return np.array(row["errors"]).reshape(8, 4)


def of_table(row):
    return cells(next(r for r in compiled.load().method_table()
                      if (r["point"], r["method"], r["subject"]) == (row["point"], row["method"], row["subject"])))


def test_errors_of_pictures_are_those_of_the_table():
    """A few cells of the rows that take whole pictures: the same random numbers as in the table, so nearly the same errors."""
    for row in measureSubdivision.rows(False, shapes=("smooth",), sizes=(20,), bins=(4,)):
        found = (slice(None), 1) if row["kind"] == "diffuse" else (4, 1)
        assert cells(row)[found] == pytest.approx(of_table(row)[found], rel=0.1, abs=1e-4), row["method"]
    for row in measurePaths.path_depth(False, scenes=("box",), bins=(3,)):
        assert cells(row)[3] == pytest.approx(of_table(row)[3], rel=0.1, abs=1e-4), row["method"]


def test_without_roulette_a_sample_has_less_noise():
    """Variance alone: up to 16 bright surfaces in a white box no method ends a path by chance, so the noise is the same.

    Beyond them, without roulette, a sample has less noise, and takes longer.
    """
    rows = measurePaths.roulette(False, scenes=("box",), bins=(7,), depths=(16, 64))
    none = next(row for row in rows if row["method"] == "none")
    assert cells(none)[7, 1] == 1.0
    assert cells(none)[7, 2] < 0.5


def test_listing_shows_figures(capsys):
    with pytest.raises(SystemExit) as end:
        main.main(["bsdf", "--method", "list"])
    assert not end.value.code
    text = capsys.readouterr().out
    for point, methods in compiled.load().choice_points():
        assert point in text and all(name in text for name, _ in methods)
    assert text.count("measured: ") == len({(r["point"], r["method"]) for r in compiled.load().method_table()})


@pytest.mark.parametrize("arguments", [[], ["--lobes", "--point", "nothing"], ["--lobes", "--point", "thinWalled"],
                                       ["--lobes", "--point", "fresnel", "--out", "/dev/null/x"]])
def test_what_cannot_be_charted(arguments, capsys):
    assert main.main(["chart", *arguments]) in (1, 2)
    error = capsys.readouterr().err
    assert "Traceback" not in error and len(error.strip().splitlines()) == 1


def test_a_point_goes_into_the_table_alone():
    table = [{"point": p, "subject": s} for p, s in (("a", "1"), ("b", "2"), ("b", "3"), ("c", "4"))]
    rows = [{"point": "b", "subject": "new"}]
    assert [row["subject"] for row in lobes.merged(rows, table, "b")] == ["1", "new", "4"]
    assert [row["subject"] for row in lobes.merged(rows, table[:1], "b")] == ["1", "new"]


def test_costs_of_counts_are_over_the_default_without_one():
    rows = [{"point": "p", "method": m, "subject": s, "ns": ns}
            for m, s, ns in (("a", "x", 10.0), ("a", "x, 16 passes", 160.0), ("b", "x, 4 samples", 5.0),
                             ("b", "y", 3.0))]
    costs = [row["cost"] for row in lobes.with_cost(rows, [("p", [("a", ""), ("b", "")])])]
    assert costs == [1.0, 1.0, 0.5, 1.0]


def test_methods_that_are_only_measured_stand_last_and_are_not_in_the_table():
    points = [("p", [("a", "")])]
    rows = [{"point": p, "method": m, "subject": "x", "ns": ns}
            for p, m, ns in (("q", "c", 2.0), ("q", "d", 4.0), ("p", "b", 3.0), ("p", "a", 1.0))]
    rows = lobes.with_cost(rows, points)
    assert [(row["method"], row["cost"]) for row in rows] == [("a", 1.0), ("b", 3.0), ("c", 1.0), ("d", 2.0)]
    assert [row["method"] for row in lobes.of_renderer(rows, points)] == ["a"]


def test_table_text(tmp_path):
    row = {"point": "p", "method": "m", "subject": "s", "errorOf": "albedo", "ns": 3.0, "cost": 1.0, "mean": 0.0,
           "largest": 1e-5, "rms": 0.5, "kind": "conductor", "reflectance": 0.9, "axis": "roughness", "axisEnd": 1.0,
           "errors": [0.0, 0.25], "truths": [1.0, 0.5]}
    path = tmp_path / "table.cpp"
    lobes.write_table([row], path)
    text = " ".join(path.read_text().split())
    assert ('{"p", "m", "s", "albedo", 3.0f, 1.0f, 0.0f, 1e-05f, 0.5f, "conductor", 0.9f, "roughness", 1.0f, '
            '{0, 0.25f}, truths[0]},') in text
    assert "truths[] = { {1.0f, 0.5f}, };" in text
