# SPDX-License-Identifier: Apache-2.0
"""Area lights by linearly transformed cosines: near the path tracer's answer, without noise, and samples where they must be.

Both images are made of fixed seeds, so that a difference is a change of the code.
"""
import numpy as np
import pytest

import floorLights
import inProcess
from floorLights import STAGE, light

pytestmark = pytest.mark.usefixtures("opengl")

OUTLINES = {"areaLight": "linearlyTransformedCosines"}


def behind(kind, text, color, name, x):
    """A light that the floor mirrors."""
    return light(kind, f"        color3f inputs:color = {color}\n        float inputs:intensity = 8\n" + text, name, place=f"""\
        double3 xformOp:translate = ({x}, 2.5, -3)
        float3 xformOp:rotateXYZ = (-140, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
""")


# A channel each, but for the disk.
LIGHTS = (behind("RectLight", "        float inputs:width = 1.6\n        float inputs:height = 0.8", (1, 0, 0), "rect", 0)
          + behind("SphereLight", "        float inputs:radius = 0.5", (0, 1, 0), "sphere", 0)
          + behind("CylinderLight", "        float inputs:length = 2\n        float inputs:radius = 0.3", (0, 0, 1), "tube", -1)
          + behind("DiskLight", "        float inputs:radius = 0.4", (0, 0, 0.7), "disk", 1.6))

MATERIAL = """    def Material "%s"
    {
        token outputs:surface.connect = </World/%s/surface.outputs:surface>
        def Shader "surface"
        {
            uniform token info:id = "%s"
%s
            token outputs:surface
        }
    }
"""


def preview(roughness, metallic):
    return "UsdPreviewSurface", f"""            color3f inputs:diffuseColor = (0.4, 0.3, 0.2)
            float inputs:roughness = {roughness}
            float inputs:metallic = {metallic}"""


FLOOR, BLOCK = preview(0.5, 1), preview(0.35, 0)
BRUSHED = ("ND_open_pbr_surface_surfaceshader", """            color3f inputs:base_color = (0.6, 0.5, 0.4)
            float inputs:base_metalness = 1
            float inputs:specular_roughness = 0.4
            float inputs:specular_roughness_anisotropy = 0.8""")


def stage_of(folder, *arguments, lights=LIGHTS, floor=FLOOR, block=BLOCK):
    text = STAGE % (lights + "".join(MATERIAL % (prim, prim, *shader)
                                     for prim, shader in (("ofFloor", floor), ("ofBlock", block))))
    for prim, bound in (('    def Mesh "floor"', "ofFloor"), ('    def Cube "block"', "ofBlock")):
        text = text.replace(prim + "\n    {", prim + ' (prepend apiSchemas = ["MaterialBindingAPI"])\n    {\n'
                            f"        rel material:binding = </World/{bound}>")
    return inProcess.Stage(floorLights.write(folder, text), "-w", 48, "--disableCameraLight", *arguments)


def test_outlines_keep_the_tolerance_that_they_would_be_taken_for_and_have_no_noise(tmp_path):
    """They are taken where their error in the table is at most 0.4 of the tolerance: each channel has to be within it."""
    truth = stage_of(tmp_path, "--samples", 256, "--maxDepth", 1).image(7)
    drawn = stage_of(tmp_path, "--backend", "raster")
    outlines = drawn.image(0, samples=16, tolerance=1.0, methods=OUTLINES)
    error = max(c["error"] for plan in drawn.state["plans"].values()
                for c in plan["choices"] if c["point"] == "areaLight")
    for channel in range(3):
        assert truth[..., channel].mean() > 0.01, "a light is off"
        off = np.abs(outlines - truth)[..., channel] / (truth[..., channel] + 0.01)
        assert 0.0 < off.mean() <= error / 0.4, (channel, off.mean(), error)
    noise = {name: np.mean((drawn.image(1, samples=1, methods=methods) - outlines) ** 2 / (outlines ** 2 + 0.01))
             for name, methods in (("outline", OUTLINES), ("sampled", {}))}
    assert noise["outline"] < noise["sampled"], noise


def test_what_has_no_outline_is_sampled(tmp_path):
    """To the last bit: a profile, a cone, an image on a light, and then lobes that no transform stands for."""
    shaped = (light("SphereLight", '        float inputs:intensity = 0.05\n        float inputs:radius = 0.2\n'
                    '        asset inputs:shaping:ies:file = @./lamp.ies@', "profile", api="ShapingAPI")
              + light("DiskLight", '        float inputs:intensity = 30\n        float inputs:radius = 0.3\n'
                      '        float inputs:shaping:cone:angle = 20', "cone", api="ShapingAPI")
              + light("RectLight", '        float inputs:intensity = 3\n        asset inputs:texture:file = @./image.exr@',
                      "picture"))
    for name, changes in (("lights", {"lights": shaped}), ("lobes", {"floor": BRUSHED, "block": BRUSHED})):
        (tmp_path / name).mkdir()
        stage = stage_of(tmp_path / name, "--backend", "raster", "--samples", 2, **changes)
        sampled = stage.image(0)
        assert sampled.mean() > 0.003, "the light is off"
        assert np.array_equal(stage.image(0, methods=OUTLINES), sampled), name
