# SPDX-License-Identifier: Apache-2.0
"""`patina compare` reads files, picks channels, and can judge."""
import json

import numpy as np
import pytest

import _patina
from patina.cli import imageMetrics, main


@pytest.fixture
def pair(tmp_path):
    b = np.random.default_rng(3).random((8, 12, 3), dtype=np.float32)
    paths = [str(tmp_path / name) for name in ("a.exr", "b.exr")]
    _patina.write_image(paths[0], b + np.float32(0.125))
    _patina.write_image(paths[1], b)
    return paths


def numbers(capsys, *arguments):
    assert main.main(["compare", *map(str, arguments), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_numbers_of_files(pair, capsys):
    result = numbers(capsys, *pair)
    assert result["rmse"] == pytest.approx(0.125, rel=1e-5)
    assert result["meanError"] == pytest.approx(0.125, rel=1e-5)
    assert result["notFinite"] == {"a": {"nan": 0, "inf": 0}, "b": {"nan": 0, "inf": 0}}
    assert numbers(capsys, *pair, "--no-flip")["flip"] is None


def test_limits_decide_the_exit_status(pair, capsys):
    assert main.main(["compare", *pair, "--fail", "rmse=0.2"]) == 0
    assert main.main(["compare", *pair, "--fail", "rmse=0.1", "--fail", "maxDifference=1"]) == 1
    assert "rmse" in capsys.readouterr().err
    assert main.main(["compare", *pair[::-1], "--fail", "meanError=0.1"]) == 1  # its size counts
    assert main.main(["compare", *pair, "--fail", "beauty=1"]) == 2


def test_not_finite_values_are_shown(pair, tmp_path, capsys):
    image = np.ones((8, 12, 3), np.float32)
    image[2, 3, 1] = np.nan
    path = str(tmp_path / "nan.exr")
    _patina.write_image(path, image)
    assert main.main(["compare", path, pair[1]]) == 0
    assert "1 NaN" in capsys.readouterr().out


def test_what_cannot_be_compared(pair, tmp_path, capsys):
    small = str(tmp_path / "small.exr")
    _patina.write_image(small, np.zeros((4, 4, 3), np.float32))
    for arguments in ([small, pair[0]], ["absent.exr", pair[0]], [*pair, "--aov", "nonsense"]):
        assert main.main(["compare", *arguments]) == 1
        error = capsys.readouterr().err
        assert len(error.strip().splitlines()) == 1


def test_display_images(tmp_path, capsys):
    path = str(tmp_path / "a.png")
    _patina.write_image(path, np.full((8, 8, 3), 0.5, np.float32))
    assert numbers(capsys, path, path)["rmse"] == 0.0


@pytest.mark.parametrize("metric", ["flip", "rmse"])
def test_images_without_a_number_are_not_alike(tmp_path, capsys, monkeypatch, metric):
    """Nothing is measured before that is seen, so that it does not matter whether flip-evaluator is there."""
    monkeypatch.setattr(imageMetrics, "flip_missing", lambda: "")
    path = str(tmp_path / "nan.exr")
    _patina.write_image(path, np.full((8, 8, 3), np.nan, np.float32))
    assert imageMetrics.mean_flip(np.full((8, 8, 3), np.nan), np.ones((8, 8, 3)), True) is None
    assert main.main(["compare", path, path, "--fail", f"{metric}=0.1"]) == 1
    said = capsys.readouterr()
    assert said.err == f"patina: {metric} could not be measured: no pixel is a number in both images\n"
    assert "no pixel is a number" in said.out
    assert numbers(capsys, path, path)["flip"] is None
