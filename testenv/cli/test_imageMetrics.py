# SPDX-License-Identifier: Apache-2.0
"""The metrics of `patina compare` against numbers worked out by hand."""
import numpy as np
import pytest

from patina.cli import imageMetrics


def grey(*values):
    """:returns: an image of one row, three equal channels"""
    return np.repeat(np.array(values, dtype=np.float32)[None, :, None], 3, axis=2)


def test_equal_images():
    a = np.random.default_rng(1).random((5, 7, 3), dtype=np.float32)
    d = imageMetrics.differences(a, a)
    assert d["rmse"] == d["relMSE"] == d["meanError"] == d["maxDifference"] == 0.0


def test_numbers_by_hand():
    d = imageMetrics.differences(grey(1.0, 3.0), grey(1.0, 2.0))
    assert d["rmse"] == pytest.approx((1 / 2) ** 0.5)
    assert d["relMSE"] == pytest.approx(0.5 * 1.0 / (4.0 + 0.01))
    assert d["meanError"] == pytest.approx(0.5)
    assert d["relativeMeanError"] == pytest.approx(0.5 / 1.5)
    assert d["maxDifference"] == pytest.approx(1.0)
    assert d["maxAt"] == [1, 0]


def test_sign_says_which_image_is_darker():
    assert imageMetrics.differences(grey(0.5), grey(1.0))["meanError"] == pytest.approx(-0.5)


def test_pixels_that_are_no_numbers_are_left_out_and_counted():
    a, b = grey(np.nan, 2.0, np.inf), grey(1.0, 1.0, 1.0)
    assert imageMetrics.count_not_finite(a) == {"nan": 3, "inf": 3}
    assert imageMetrics.differences(a, b)["rmse"] == pytest.approx(1.0)
    assert imageMetrics.differences(grey(np.nan), grey(1.0))["rmse"] is None


def test_flip_of_equal_and_of_opposite_images():
    pytest.importorskip("flip_evaluator")
    black, white = np.zeros((16, 16, 3), np.float32), np.ones((16, 16, 3), np.float32)
    for linear in (False, True):
        assert imageMetrics.mean_flip(white, white, linear) == pytest.approx(0.0, abs=1e-6)
    assert imageMetrics.mean_flip(black, white, False) > 0.9
    assert imageMetrics.mean_flip(black, black, True) == 0.0


@pytest.mark.parametrize("brightness", [2.0 ** -12, 2.0 ** -40, 2.0 ** -135])
def test_flip_of_dim_images_is_that_of_bright_ones(brightness):
    if reason := imageMetrics.flip_missing():
        pytest.skip(reason)
    generator = np.random.default_rng(3)
    a, b = (generator.integers(1, 8, (16, 16, 3)).astype(np.float32) for _ in range(2))  # few bits: nothing is rounded
    expected = imageMetrics.mean_flip(a, b, True)
    # FLIP's exposures are 32-bit floats of some 10 stops: a rounding changes what they scale by less than 1e-6.
    assert imageMetrics.mean_flip(a * brightness, b * brightness, True) == pytest.approx(expected, rel=1e-5)
    assert imageMetrics.mean_flip(a, b * brightness, True) > expected
