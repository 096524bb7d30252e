# SPDX-License-Identifier: Apache-2.0
"""Roulette changes the noise and the time of an image, not its mean."""
import numpy as np
import pytest
import scipy.stats

from rendering import color, record, scene

SEEDS = range(8)
SIGNIFICANCE = 1e-4  # of Welch's test of two means; fixed seeds
NEVER = 4096  # surfaces, more than any path has


@pytest.mark.parametrize("name", ["diffuseBox", "lightDome", "media"])
def test_roulette_does_not_change_the_mean(name, tmp_path):
    means = {}
    for depth in (1, NEVER):
        means[depth] = []
        for seed in SEEDS:
            image = tmp_path / f"{depth}.{seed}.exr"
            record(scene(name), image, "--imageWidth", 24, "--imageHeight", 16, "--samples", 64, "--maxDepth", 12,
                   "--seed", 100 * depth + seed, "--rouletteDepth", depth)
            means[depth].append(float(np.mean(color(image))))
    assert scipy.stats.ttest_ind(means[1], means[NEVER], equal_var=False).pvalue > SIGNIFICANCE
    assert np.mean(means[1]) == pytest.approx(np.mean(means[NEVER]), rel=0.02)
    assert means[1] != means[NEVER]
