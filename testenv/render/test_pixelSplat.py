# SPDX-License-Identifier: Apache-2.0
"""Samples that count for all pixels that their filter reaches: the same mean, less noise, the same bits everywhere."""
import numpy as np
import pytest
import scipy.stats

from inProcess import Stage
from patina import experiment
from rendering import scene
import usda
from usda import camera, mesh, prim

SEEDS = range(8)
SIGNIFICANCE = 1e-4  # fixed seeds
SMALL = ("--imageWidth", 32, "--samples", 16, "--disableCameraLight")


def stage(path, *arguments, method="splatted"):
    return Stage(path, *SMALL, *arguments, "--method", f"pixelFilter={method}")


def both(path, *arguments):
    """:returns: images of samples that count for others, and of those that do not, without their edges, where pixels around
        are missing"""
    return tuple(np.array([made.image(seed)[1:-1, 1:-1] for seed in SEEDS])
                 for made in (stage(path, *arguments, method=method) for method in ("splatted", "sampled")))


@pytest.mark.parametrize("name", ["diffuseBox", "lightDome", "motionBlur"])
def test_the_mean_is_that_of_the_filter_and_noise_is_less(name):
    splatted, sampled = both(scene(name))
    assert scipy.stats.ttest_ind(splatted.mean((1, 2, 3)), sampled.mean((1, 2, 3)), equal_var=False).pvalue > SIGNIFICANCE
    assert np.mean(splatted.var(0, ddof=1)) < 0.5 * np.mean(sampled.var(0, ddof=1))  # 0.35 in the mean, however uneven it is


@pytest.mark.parametrize("radius", [0.6, 1.0, 1.7])
def test_an_edge_is_as_wide_as_the_filter(tmp_path, radius):
    """A white half plane on black: along the edge's normal pixels show the filter's integral. Cells of half a pixel move none
    of its mass by more than a quarter, so the picture shifts by that at most where it rises. The edge cuts one of 1024 strata:
    1/512 of the samples in half a pixel."""
    path = tmp_path / "edge.usda"
    path.write_text(usda.stage(camera(flat=(160, 160), at=(0, 0, 5)),  # a unit is a pixel
                               mesh("half", [(0.2, -20, 0), (20, -20, 0), (20, 20, 0), (0.2, 20, 0)]),
                               prim("DistantLight", "sun", intensity=1, angle=0)))
    made = Stage(path, "--imageWidth", 16, "--imageHeight", 16, "--samples", 1024, "--disableCameraLight", "--filterRadius",
                 radius, "--method", "pixelFilter=splatted")
    alpha = np.asarray(made.film().resolve("alpha"))[4:12].mean(0)
    centers = np.arange(16) - 8 + 0.5

    def integral(x):
        """of the filter, from its left end to x"""
        beyond = scipy.stats.norm.cdf(-2.0)
        return np.clip((scipy.stats.norm.cdf(2.0 * x / radius) - beyond) / (1.0 - 2.0 * beyond), 0.0, 1.0)
    assert np.all(alpha >= integral(centers - 0.2 - 0.25) - 1 / 512)
    assert np.all(alpha <= integral(centers - 0.2 + 0.25) + 1 / 512)
    assert alpha[4] == 0.0 and alpha[-4] == 1.0


def test_bits_depend_on_no_threads_and_no_crop():
    """A crop has no samples beyond its edge: pixels within reach of it differ."""
    one, three = (stage(scene("diffuseBox"), "--threads", n) for n in (1, 3))
    whole = one.image(5)
    assert np.array_equal(whole, three.image(5)) and whole.any()
    crop = three.image(5, dataWindow=(3, 2, 12, 9))
    assert np.array_equal(crop[3:9, 4:12], whole[3:9, 4:12])


@pytest.mark.parametrize("arguments, reason", [
    (("--aov", "direct"), "AOV direct is of the samples of each pixel alone"),
    (("--aov", "cryptoObject"), "AOV cryptoObject is of the samples of each pixel alone"),
    (("--deep", "deep.exr"), "deep pixels are kept"),
    (("--filterRadius", 8.1), "the filter's radius is above 8 pixels")])
def test_where_samples_cannot_be_splatted_they_count_for_their_pixel(arguments, reason):
    splatted, sampled = (stage(scene("diffuseBox"), "--samples", 2, *arguments, method=method)
                         for method in ("splatted", "sampled"))
    assert np.array_equal(splatted.image(1), sampled.image(1))
    told = [w for w in splatted.warnings() if "its own pixel" in w]
    assert len(told) == 1 and reason in told[0]
    assert not [w for w in sampled.warnings() if "its own pixel" in w]


def test_the_widest_filter_is_splatted():
    wide = stage(scene("diffuseBox"), "--samples", 2, "--filterRadius", 8)
    assert not np.array_equal(wide.image(1), stage(scene("diffuseBox"), "--samples", 2, "--filterRadius", 8,
                                                   method="sampled").image(1))
    assert not [w for w in wide.warnings() if "its own pixel" in w]


def test_around_a_crop_there_is_nothing_and_its_error_is_told():
    made = stage(scene("lightDome"))
    for window in ((1, 1, 30, 16), (8, 5, 20, 12)):
        film = made.film(dataWindow=window)
        empty = np.asarray(film.resolve("sampleCount")) == 0
        assert empty.any() and not np.asarray(film.resolve("alpha"))[empty].any()
        assert not np.asarray(film.resolve("color"))[empty].any()
    whole, cropped = made.film().relative_error(), made.film(dataWindow=(1, 1, 31, 17)).relative_error()
    assert cropped < 1.3 * whole  # 0.87 of the pixels; without the filter it is 1.7 of it


def test_surfaces_in_view_are_those_of_the_nearest_samples():
    """AOVs that are not mixed stay whole: each is one that a sample met."""
    ids = np.asarray(stage(scene("diffuseBox"), "--aov", "primId").film().resolve("primId"))
    assert ids.dtype == np.int32 and len(np.unique(ids)) > 2


def test_a_box_up_to_half_a_pixel_reaches_no_other():
    splatted, sampled = (stage(scene("diffuseBox"), "--samples", 2, "--filterRadius", 0.5, method=method)
                         for method in ("splatted", "sampled"))
    assert np.array_equal(splatted.image(1), sampled.image(1)) and not splatted.warnings()


def test_sums_are_no_picture():
    with pytest.raises(Exception, match="quarterColors"):
        stage(scene("diffuseBox"), "--aov", "quarterColors").image(1)


def test_a_tolerance_is_kept_with_fewer_samples():
    """In the mean over pictures; as many seeds as make a picture that is beyond it by chance count little."""
    errors, counts = [], []
    for method in ("splatted", "sampled"):
        made = stage(scene("lightSphere"), "--tolerance", 0.03, "--samples", 4096, method=method)
        truth = stage(scene("lightSphere"), "--samples", 8192, method=method).image(99) @ experiment.LUMINANCE
        errors.append([])
        counts.append(0)
        for seed in SEEDS:
            film = made.film(seed=seed)
            image = np.asarray(film.resolve("color"), float)[..., :3] @ experiment.LUMINANCE
            errors[-1].append(experiment.relative_error(image, truth))
            counts[-1] += np.asarray(film.resolve("sampleCount")).sum()
    assert np.mean(errors[0]) <= 0.03 and np.mean(errors[1]) <= 0.03
    assert counts[0] < counts[1]
