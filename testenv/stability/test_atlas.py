# SPDX-License-Identifier: Apache-2.0
"""The atlas of stability: what is used where a method fails stays within its bound, and the method does fail there."""
import csv
import re

import numpy as np
import pytest

from patina.chart import stabilityCommand, svgLines, sweepsSky
from patina.chart.sweeps import Sweep
from patina.cli import main


@pytest.mark.parametrize("family", stabilityCommand.FAMILIES)
def test_bounds_hold_and_failures_show(family):
    found = stabilityCommand.sweeps(12, family)
    assert found
    for sweep in found:
        assert len(sweep.x) == len(sweep.truth) == len(sweep.chosen)
        assert all(len(values) == len(sweep.x) for values in sweep.curves.values())
    assert not [problem for sweep in found for problem in sweep.problems()]


def example(**changes):
    made = {"name": "n", "family": "f", "fails": "a", "x_label": "x", "x": [0.0, 1.0], "y_label": "y",
            "curves": {"good": [1.0, 1.01], "bad": [1.0, 2.0]}, "truth": [1.0, 1.0], "chosen": "good",
            "bound": 0.02, "failing": "bad"}
    return Sweep(**{**made, **changes})


def test_what_a_sweep_finds_wrong():
    assert example().problems() == []
    assert "bound 0.001" in example(bound=0.001).problems()[0]
    assert "does not fail" in example(failing="good").problems()[0]
    nan = float("nan")
    assert "is not finite" in example(curves={"good": [1.0, nan], "bad": [1.0, 2.0]}).problems()[0]
    assert example(curves={"good": [1.0, 1.0], "bad": [1.0, nan]}).problems() == []


def test_lines_hold_what_is_no_number():
    nan = float("nan")
    text = svgLines.lines(example(curves={"good": [1.0, 1.01], "bad": [nan, float("inf")]}, log_x=True, switch=0.5))
    assert text.startswith("<svg") and "nan" not in text and "inf" not in text


def test_command(tmp_path, capsys):
    assert main.main(["chart", "--stability", "--family", "classic", "--points", "4", "--out", str(tmp_path)]) == 0
    assert "Ward at grazing views" in capsys.readouterr().out
    with open(tmp_path / "stability.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {"bounded", "exact"} <= {row["method"] for row in rows}
    page = (tmp_path / "stability.html").read_text(encoding="utf-8")
    assert page.count("<figure>") == len({row["sweep"] for row in rows})
    assert set(re.findall(r"https?://[^/]*", page)) <= {"http://www.w3.org"}
    for wrong in (["--family", "nothing"], ["--points", "3"]):
        assert main.main(["chart", "--stability", *wrong]) == 2


def test_the_rasterizer_counts_a_bright_texel_once():
    """Light samples find the texel, samples of the material see it beside them in a smaller version of the image: one of
    both."""
    if not sweepsSky.has_raster():
        pytest.skip("the rasterizer does not run here")
    truth = sweepsSky.irradiance(sweepsSky.one_texel())
    lit = truth > 0.2 * truth.max()
    drawn = sweepsSky.render(sweepsSky.one_texel(), sweepsSky.DIFFUSE, "raster", 16, "--method", "domeLight=sampled")
    # A fixed seed; with the texel counted twice it is 1.68, and the mean of 12 seeds within 0.05 of it.
    assert np.mean(drawn[lit] / truth[lit]) == pytest.approx(1.0, abs=0.12)
