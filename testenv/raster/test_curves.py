"""Curves by the rasterizer: as wide as they are, and lit through, whether strips or tubes of polygons stand for them."""
import numpy as np
import pytest

import pairs
from test_bothBackEnds import opengl  # noqa: F401  skips where there is none

STAGE = """#usda 1.0
(
    upAxis = "Y"
)
def Camera "camera"
{
    token projection = "orthographic"
    float horizontalAperture = 20
    float verticalAperture = 20
    double3 xformOp:translate = (0, 0, 10)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DistantLight "sun"
{
    float inputs:intensity = 500
    float inputs:angle = 5
    float3 xformOp:rotateXYZ = %(turn)s
    uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
}
def BasisCurves "curve" (
    prepend apiSchemas = ["MaterialBindingAPI"]
)
{
    uniform token type = "cubic"
    uniform token basis = "bezier"
    int[] curveVertexCounts = [4]
    point3f[] points = [(-0.6, -2, 0), (0.1, -1, 0.2), (-0.1, 1, 0.2), (0.6, 2, 0)]
    float[] widths = [%(width)s] (
        interpolation = "constant"
    )
    rel material:binding = </material>
}
def Material "material"
{
    token outputs:mtlx:surface.connect = </material/surface.outputs:out>
    def Shader "hair"
    {
        uniform token info:id = "ND_chiang_hair_bsdf"
        float3 inputs:absorption_coefficient = (0.1, 0.3, 0.6)
        token outputs:out
    }
    def Shader "surface"
    {
        uniform token info:id = "ND_surface"
        token inputs:bsdf.connect = </material/hair.outputs:out>
        token outputs:out
    }
}
"""


@pytest.mark.parametrize("width", [0.0003, 0.03, 0.4])  # a hundredth of a pixel, a pixel, and 13
@pytest.mark.parametrize("turn", ["(-30, 30, 0)", "(-20, 170, 0)"])  # from the front, through the hair
def test_hair_is_as_wide_and_as_bright_as_traced(tmp_path, width, turn):
    stage = tmp_path / "stage.usda"
    stage.write_text(STAGE % {"width": width, "turn": turn})
    found = {}
    thin = width < 0.01  # what one sample in 100 meets
    for backend, samples in (("raster", 1024 if thin else 64), ("embree", 8192 if thin else 256)):
        image = str(tmp_path / (backend + ".exr"))
        pairs.record(str(stage), image, "--backend", backend, "--samples", str(samples), "--maxDepth", "1", "-w", "64")
        import _patina

        read = _patina.read_image(image)
        values = np.array(read.pixels)
        found[backend] = {c: float(values[..., read.channels.index(c)].mean()) for c in "RGA"}
    for channel, most in (("A", 0.03 if thin else 0.01), ("R", 0.1 if thin else 0.03), ("G", 0.1 if thin else 0.03)):
        assert found["embree"][channel] > (1e-6 if thin else 1e-4)
        np.testing.assert_allclose(found["raster"][channel], found["embree"][channel], rtol=most, err_msg=channel)
