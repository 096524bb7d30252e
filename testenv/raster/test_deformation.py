# SPDX-License-Identifier: Apache-2.0
"""Points that move while the shutter is open, drawn by the rasterizer, against the closed form."""
import numpy as np
import pytest

import inProcess
import usda

pytestmark = pytest.mark.usefixtures("opengl")

STAGE = usda.stage(
    usda.camera("double shutter:open = 0", "double shutter:close = 1", flat=(40, 10), clippingRange=(0.1, 100),
                at=(0.5, 0, 10)),
    usda.prim("Mesh", "bar", bind="white", faceVertexCounts=[4], faceVertexIndices=[0, 1, 2, 3], subdivisionScheme="none",
              points={0: [(-0.5, -2, 0), (0.5, -2, 0), (0.5, 2, 0), (-0.5, 2, 0)],
                      1: [(0.5, -2, 0), (1.5, -2, 0), (1.5, 2, 0), (0.5, 2, 0)]}),
    usda.material("white", {"surface": ("ND_surface_unlit", {})}),
    startTimeCode=0, endTimeCode=0)


def test_points_move_while_the_shutter_is_open(tmp_path):
    image = inProcess.shot(tmp_path, STAGE, "--backend", "raster", "--samples", "64", "-w", "64", "-f", "0")
    row = inProcess.pixels(image)[8, :, 0]
    x = 0.5 + (np.arange(64) + 0.5) / 64 * 4 - 2
    # The bar is over x from x - 0.5 to x + 0.5 of the shutter.
    covered = np.clip(np.minimum(x + 0.5, 1.0) - np.maximum(x - 0.5, 0.0), 0.0, 1.0)
    # Eight steps of the shutter, each an eighth of the bar's way.
    np.testing.assert_allclose(row, covered, atol=0.16)
    assert abs(row.mean() - covered.mean()) < 0.02
