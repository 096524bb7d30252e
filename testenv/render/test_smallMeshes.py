# SPDX-License-Identifier: Apache-2.0
"""A subdivided mesh of few faces covers as much of the picture from far away as from near."""
import numpy as np
import pytest

import inProcess
import usda

STAGE = usda.stage(
    usda.camera(flat=(40, 40), clippingRange=(0.1, 100), at=(0, 0, 10)),
    usda.mesh("cube", [(-1, -1, 1), (1, -1, 1), (-1, 1, 1), (1, 1, 1), (-1, 1, -1), (1, 1, -1), (-1, -1, -1), (1, -1, -1)],
              faces=[(0, 1, 3, 2), (2, 3, 5, 4), (4, 5, 7, 6), (6, 7, 1, 0), (1, 7, 5, 3), (6, 0, 2, 4)], scheme="",
              turn=(20, 30, 0)),
    up="")


@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_a_small_cage_is_as_wide_as_its_surface(backend, tmp_path):
    """The surface is nearly a ball of 0.6 of the cage's half diagonal. Edges of half of that diagonal are chords of 48 degrees,
    so that a polygon of them covers 1 - sin(48 degrees) / 0.83 = 11 % less. The cage itself covers twice as much."""
    inProcess.needs_opengl(backend)
    stage, share = tmp_path / "cage.usda", {}
    stage.write_text(STAGE)
    for width in (10, 320):
        image = str(tmp_path / f"{width}.exr")
        inProcess.record(str(stage), image, "--backend", backend, "-w", width, "--samples", 256 if width == 10 else 4)
        share[width] = float(np.mean(inProcess.pixels(image, "A")))
    assert 0.01 < share[320] and abs(share[10] / share[320] - 1) <= 0.11, share
