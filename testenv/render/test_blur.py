# SPDX-License-Identifier: Apache-2.0
"""A wide blur shows no ghosts of what it blurs: its taps lie elsewhere in every sample, on both back ends."""
import numpy as np
import pytest

from test_features import quad, render
from usda import material

WIDTH = 0.5  # of the texture's square

# Left half black, right half white.
STEP = material("step", {
    "uv": ("ND_texcoord_vector2", {}),
    "u": ("ND_separate2_vector2", {"float2 in": "<uv>"}, "float outx"),
    "half": ("ND_ifgreater_float", {"float value1": "<u>", "value2": 0.5, "in1": 1, "in2": 0}),
    "blur": ("ND_blur_float", {"float in": "<half>", "size": WIDTH}),
    "grey": ("ND_convert_float_color3", {"float in": "<blur>"}),
    "surface": ("ND_surface_unlit", {"color3f emission_color": "<grey>"})})


@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_wide_blur_is_a_ramp(tmp_path, backend):
    """Fixed taps show five steps, whose edges are half a tap's share, 0.1, off the ramp. A sample is off by 0.045 at
    most (one column of five cells of 0.2, cut at half), 64 of them over 16 rows of pixels by 0.0014."""
    image = render(tmp_path, STEP, quad("sheet", 0, 2.0, 0, "step"), samples=64, arguments=("--backend", backend))
    found = image[8:24, :, 0].mean(axis=0)
    u = (np.arange(32) + 0.5) / 32
    expected = np.clip((u + WIDTH / 2 - 0.5) / WIDTH, 0.0, 1.0)
    # 64 columns in all at 4.5 deviations: by chance in 1 of 2300 seeds, and the seed is fixed.
    assert np.abs(found - expected).max() < 4.5 * 0.0447 / np.sqrt(64 * 16) + 0.002
