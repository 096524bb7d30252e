# SPDX-License-Identifier: Apache-2.0
"""Light that glows inside of a white cloud comes out of it, scattered: nothing of it is lost."""
import numpy as np
import pytest
from scipy import stats

import inProcess

pytestmark = pytest.mark.usefixtures("opengl")

SIGNIFICANCE = 0.01
SEEDS = {"raster": range(1, 7), "embree": range(101, 107)}
SAMPLES = {"raster": 16, "embree": 64}
BEAM = 0.28  # what is missing in red where the glow is weakened as a beam


def test_the_glow_in_the_middle_of_the_puff():
    """Red of the middle, as a Welch interval of the difference: nearer to nothing lost than to the loss of a beam."""
    red = {}
    for backend, seeds in SEEDS.items():
        stage = inProcess.Stage(inProcess.scene("volume"), "--backend", backend, "--samples", SAMPLES[backend], "-w", 48)
        red[backend] = np.array([stage.image(seed)[12:17, 19:24, 0].mean() for seed in seeds])
    found = stats.ttest_ind(red["raster"], red["embree"], equal_var=False).confidence_interval(1.0 - SIGNIFICANCE)
    mean = red["embree"].mean()
    assert -BEAM / 2 < found.low / mean and found.high / mean < BEAM / 2, (found, red)
