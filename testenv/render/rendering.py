# SPDX-License-Identifier: Apache-2.0
"""Helpers of the image tests: render a stage as the command line does, read pixels back."""
import os

import numpy as np
import pytest
import scipy.stats

from inProcess import SCENES, Stage, patina, record, references, scene, shot  # noqa: F401  (for tests beside this)
from inProcess import pixels as color  # noqa: F401


def pixels(image):
    """:returns: float array (height, width, channels) of all channels, linear for EXR"""
    import _patina

    return np.array(_patina.read_image(str(image)).pixels)


def assert_same_mean(name, flag, few, many, *arguments):
    """What a number decides is the noise, not the mean. Welch's test of eight images each, whose seeds are fixed, at a
    significance of 1e-4.

    :param name: of a test scene, or the path of a stage
    :returns: the means of both"""
    means = []
    for value in (few, many):
        path = name if os.path.isabs(name) else scene(name)
        stage = Stage(path, "--imageWidth", 24, "--imageHeight", 16, "--samples", 64, flag, value, *arguments)
        means.append([stage.image(100 * value + seed).mean() for seed in range(8)])
    assert scipy.stats.ttest_ind(*means, equal_var=False).pvalue > 1e-4
    assert np.mean(means[0]) == pytest.approx(np.mean(means[1]), rel=0.02)
    return means
