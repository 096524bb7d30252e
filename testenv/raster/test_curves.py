# SPDX-License-Identifier: Apache-2.0
"""Curves by the rasterizer: as wide as they are, and lit through, whether strips or tubes of polygons stand for them."""
import numpy as np
import pytest

import inProcess
import pairs
import usda

pytestmark = pytest.mark.usefixtures("opengl")

HAIR = usda.lobe("material", "chiang_hair_bsdf", **{"float3 absorption_coefficient": (0.1, 0.3, 0.6)})


def stage(camera, points, width, *prims):
    """:param points: four of each curve"""
    return usda.stage(camera, *prims, usda.prim(
        "BasisCurves", "curves", f'float[] widths = [{width}] (interpolation = "constant")', bind="material", type="cubic",
        basis="bezier", curveVertexCounts=[4] * (len(points) // 4), points=points), HAIR)


@pytest.mark.parametrize("width", [0.0003, 0.03, 0.4])  # a hundredth of a pixel, a pixel, and 13
@pytest.mark.parametrize("turn", [(-30, 30, 0), (-20, 170, 0)])  # from the front, through the hair
def test_hair_is_as_wide_and_as_bright_as_traced(tmp_path, width, turn):
    path = tmp_path / "stage.usda"
    points = [(-0.6, -2, 0), (0.1, -1, 0.2), (-0.1, 1, 0.2), (0.6, 2, 0)]
    path.write_text(stage(usda.camera(flat=(20, 20), at=(0, 0, 10)), points, width,
                          usda.prim("DistantLight", "sun", intensity=500, angle=5, turn=turn)))
    found = {}
    thin = width < 0.01  # what one sample in 100 meets
    for backend, samples in (("raster", 4096 if thin else 64), ("embree", 8192 if thin else 256)):
        image = str(tmp_path / (backend + ".exr"))
        pairs.record(str(path), image, "--backend", backend, "--samples", str(samples), "--maxDepth", "1", "-w", "64")
        found[backend] = {name: float(values.mean()) for name, values in inProcess.channels(image).items()}
    for channel, maximum in (("A", 0.03 if thin else 0.01), ("R", 0.1 if thin else 0.03), ("G", 0.1 if thin else 0.03)):
        assert found["embree"][channel] > (1e-6 if thin else 1e-4)
        np.testing.assert_allclose(found["raster"][channel], found["embree"][channel], rtol=maximum, err_msg=channel)


LIGHTS = {
    "key": usda.prim("RectLight", "key", intensity=20, width=1.5, height=1.5, at=(-2.5, 4, 3), turn=(-45, -40, 0)),
    "rim": usda.prim("RectLight", "rim", intensity=20, width=2, height=2, at=(1, 4.5, -3), turn=(-48, 162, 0)),
    "sky": usda.prim("DomeLight", "sky", intensity=1)}


@pytest.mark.parametrize("light", LIGHTS)
def test_fibres_of_a_lock_shade_each_other(tmp_path, light):
    """Many reach into each other, and texels of shadow maps for all of the ground are wider than they are."""
    draw = np.random.default_rng(7)
    roots = draw.uniform(-0.22, 0.22, (160, 2))
    ends = 0.7 * roots + draw.normal(0.0, 0.03, roots.shape)
    points = [(round(x + t * (p - x) + 0.1 * t * t, 4), round(2.0 - 1.9 * t, 4), round(z + t * (q - z), 4))
              for (x, z), (p, q) in zip(roots.tolist(), ends.tolist()) for t in (0, 1 / 3, 2 / 3, 1)]
    path = tmp_path / "stage.usda"
    path.write_text(stage(usda.camera(lens=(28, 20, 20), at=(0, 1, 4)), points, 0.024, LIGHTS[light],
                          usda.floor("ground", 20, color=(0.02, 0.02, 0.02))))
    found = {}
    for backend, samples in (("raster", 192), ("embree", 1024)):
        image = str(tmp_path / (backend + ".exr"))
        pairs.record(str(path), image, "--backend", backend, "--samples", str(samples), "--maxDepth", "1", "-w", "72")
        found[backend] = pairs.pixels(image)[18:54, 28:46].reshape(-1, 3)  # within the lock
    # Through the lock comes what few ways between fibres let pass.
    np.testing.assert_allclose(found["raster"].mean(0), found["embree"].mean(0), rtol=0.05 if light == "rim" else 0.02)
    if light != "rim":
        dark = found["embree"].mean(1) <= np.quantile(found["embree"].mean(1), 0.5)
        np.testing.assert_allclose(found["raster"][dark].mean(0), found["embree"][dark].mean(0), rtol=0.04)
