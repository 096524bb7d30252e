# SPDX-License-Identifier: Apache-2.0
"""The same image has the same bits, however its work was shared among threads."""
import numpy as np
import pytest

import inProcess

pytestmark = pytest.mark.skipif(bool(inProcess.without_opengl()), reason=str(inProcess.without_opengl()))


def test_renders_repeat_their_bits():
    """Where loops had several copies of their body, 38 % of such images differed: twelve would be equal by chance once in 190
    times."""
    stage = inProcess.Stage(inProcess.scene("diffuseBox"), "--backend", "raster", "-w", 64, "--samples", 4)
    first = stage.image(3)
    assert first.std() > 0.0
    for _ in range(11):
        np.testing.assert_array_equal(stage.image(3), first)
