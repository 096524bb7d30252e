# SPDX-License-Identifier: Apache-2.0
"""Curves by the rasterizer: as wide as they are, and lit through, whether strips or tubes of polygons stand for them."""
import numpy as np
import pytest

import inProcess
import pairs
import usda

pytestmark = pytest.mark.usefixtures("opengl")

STAGE = usda.stage(
    usda.camera(flat=(20, 20), at=(0, 0, 10)),
    usda.prim("DistantLight", "sun", intensity=500, angle=5, turn="%(turn)s"),
    usda.prim("BasisCurves", "curve", bind="material", type="cubic", basis="bezier", curveVertexCounts=[4],
              points=[(-0.6, -2, 0), (0.1, -1, 0.2), (-0.1, 1, 0.2), (0.6, 2, 0)],
              widths='[%(width)s] ( interpolation = "constant" )'),
    usda.lobe("material", "chiang_hair_bsdf", **{"float3 absorption_coefficient": (0.1, 0.3, 0.6)}))


@pytest.mark.parametrize("width", [0.0003, 0.03, 0.4])  # a hundredth of a pixel, a pixel, and 13
@pytest.mark.parametrize("turn", ["(-30, 30, 0)", "(-20, 170, 0)"])  # from the front, through the hair
def test_hair_is_as_wide_and_as_bright_as_traced(tmp_path, width, turn):
    stage = tmp_path / "stage.usda"
    stage.write_text(STAGE % {"width": width, "turn": turn})
    found = {}
    thin = width < 0.01  # what one sample in 100 meets
    for backend, samples in (("raster", 4096 if thin else 64), ("embree", 8192 if thin else 256)):
        image = str(tmp_path / (backend + ".exr"))
        pairs.record(str(stage), image, "--backend", backend, "--samples", str(samples), "--maxDepth", "1", "-w", "64")
        found[backend] = {name: float(values.mean()) for name, values in inProcess.channels(image).items()}
    for channel, maximum in (("A", 0.03 if thin else 0.01), ("R", 0.1 if thin else 0.03), ("G", 0.1 if thin else 0.03)):
        assert found["embree"][channel] > (1e-6 if thin else 1e-4)
        np.testing.assert_allclose(found["raster"][channel], found["embree"][channel], rtol=maximum, err_msg=channel)


LOCK = """#usda 1.0
(
    upAxis = "Y"
)
def Camera "camera"
{
    float focalLength = 28
    float horizontalAperture = 20
    float verticalAperture = 20
    double3 xformOp:translate = (0, 1, 4)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def RectLight "key"
{
    float inputs:intensity = %(key)s
    float inputs:width = 1.5
    float inputs:height = 1.5
    double3 xformOp:translate = (-2.5, 4, 3)
    float3 xformOp:rotateXYZ = (-45, -40, 0)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
}
def RectLight "rim"
{
    float inputs:intensity = %(rim)s
    float inputs:width = 2
    float inputs:height = 2
    double3 xformOp:translate = (1, 4.5, -3)
    float3 xformOp:rotateXYZ = (-48, 162, 0)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
}
def DomeLight "sky"
{
    float inputs:intensity = %(sky)s
}
def Mesh "ground"
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-20, 0, 20), (20, 0, 20), (20, 0, -20), (-20, 0, -20)]
    uniform token subdivisionScheme = "none"
    color3f[] primvars:displayColor = [(0.02, 0.02, 0.02)]
}
def BasisCurves "lock" (
    prepend apiSchemas = ["MaterialBindingAPI"]
)
{
    uniform token type = "cubic"
    uniform token basis = "bezier"
    int[] curveVertexCounts = [%(counts)s]
    point3f[] points = [%(points)s]
    float[] widths = [0.024] (
        interpolation = "constant"
    )
    rel material:binding = </material>
}
def Material "material"
""" + STAGE.split('def Material "material"\n')[1]


@pytest.mark.parametrize("light", ["key", "rim", "sky"])
def test_fibres_of_a_lock_shade_each_other(tmp_path, light):
    """Many reach into each other, and texels of shadow maps for all of the ground are wider than they are."""
    draw = np.random.default_rng(7)
    roots = draw.uniform(-0.22, 0.22, (160, 2))
    ends = 0.7 * roots + draw.normal(0.0, 0.03, roots.shape)
    points = [(x + t * (p - x) + 0.1 * t * t, 2.0 - 1.9 * t, z + t * (q - z))
              for (x, z), (p, q) in zip(roots, ends) for t in (0, 1 / 3, 2 / 3, 1)]
    values = {"key": 0, "rim": 0, "sky": 0, "counts": ", ".join(["4"] * len(roots)),
              "points": ", ".join("(%.4f, %.4f, %.4f)" % p for p in points)}
    values[light] = 1 if light == "sky" else 20
    stage = tmp_path / "stage.usda"
    stage.write_text(LOCK % values)
    found = {}
    for backend, samples in (("raster", 192), ("embree", 1024)):
        image = str(tmp_path / (backend + ".exr"))
        pairs.record(str(stage), image, "--backend", backend, "--samples", str(samples), "--maxDepth", "1", "-w", "72")
        found[backend] = pairs.pixels(image)[18:54, 28:46].reshape(-1, 3)  # within the lock
    # Through the lock comes what few ways between fibres let pass.
    np.testing.assert_allclose(found["raster"].mean(0), found["embree"].mean(0), rtol=0.05 if light == "rim" else 0.02)
    if light != "rim":
        dark = found["embree"].mean(1) <= np.quantile(found["embree"].mean(1), 0.5)
        np.testing.assert_allclose(found["raster"][dark].mean(0), found["embree"][dark].mean(0), rtol=0.04)
