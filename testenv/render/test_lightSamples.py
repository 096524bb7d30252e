# SPDX-License-Identifier: Apache-2.0
"""More light samples where the camera looks change the noise, not the image: they and samples of the BSDF stay weighted to
one."""
import numpy as np
import pytest
import scipy.stats

from rendering import color, record, scene

SEEDS = range(8)
SIGNIFICANCE = 1e-4  # of Welch's test of two means; fixed seeds


@pytest.mark.parametrize("name", ["lightMesh", "lightDome", "media"])
def test_light_samples_do_not_change_the_mean(name, tmp_path):
    means = {}
    for count in (1, 5):
        means[count] = []
        for seed in SEEDS:
            image = tmp_path / f"{count}.{seed}.exr"
            record(scene(name), image, "--imageWidth", 24, "--imageHeight", 16, "--samples", 64, "--maxDepth", 3,
                   "--seed", 100 * count + seed, "--lightSamples", count)
            means[count].append(float(np.mean(color(image))))
    assert scipy.stats.ttest_ind(means[1], means[5], equal_var=False).pvalue > SIGNIFICANCE
    assert np.mean(means[1]) == pytest.approx(np.mean(means[5]), rel=0.02)


@pytest.mark.parametrize("name, count", [("lightRect", 1), ("lightDome", 2), ("manyLights", 4)])
def test_the_lights_decide_how_many_samples_are_taken(name, count, tmp_path):
    """One lamp, a sky, 200 lamps."""
    def image(file, *more):
        record(scene(name), tmp_path / file, "--imageWidth", 16, "--imageHeight", 9, "--samples", 2, "--maxDepth", 2, *more)
        return color(tmp_path / file)

    own = image("own.exr")
    assert np.array_equal(own, image("same.exr", "--lightSamples", count))
    assert not np.array_equal(own, image("other.exr", "--lightSamples", count + 1))
