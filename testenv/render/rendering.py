# SPDX-License-Identifier: Apache-2.0
"""Helpers of the image tests: render a stage as the command line does, read pixels back."""
import numpy as np

from inProcess import SCENES, patina, record, references, scene  # noqa: F401  (for tests beside this)
from inProcess import pixels as color  # noqa: F401


def pixels(image):
    """:returns: float array (height, width, channels) of all channels, linear for EXR"""
    import _patina

    return np.array(_patina.read_image(str(image)).pixels)
