"""Area lights by linearly transformed cosines: near the path tracer's answer, without noise, and samples where they must be.

Both images are made of fixed seeds, so that a difference is a change of the code. Limits are about twice what was measured.
"""
import numpy as np

import bothBackEnds
from test_lights import PROFILE, STAGE, _image, light, opengl  # noqa: F401  (a fixture)

OUTLINES = ("--method", "areaLight=linearlyTransformedCosines")


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


def image(folder, name, *arguments, lights=LIGHTS, floor=FLOOR, block=BLOCK):
    text = STAGE % (lights + "".join(MATERIAL % (prim, prim, *shader)
                                     for prim, shader in (("ofFloor", floor), ("ofBlock", block))))
    for prim, bound in (('    def Mesh "floor"', "ofFloor"), ('    def Cube "block"', "ofBlock")):
        text = text.replace(prim + "\n    {", prim + ' (prepend apiSchemas = ["MaterialBindingAPI"])\n    {\n'
                            f"        rel material:binding = </World/{bound}>")
    (folder / "stage.usda").write_text(text)
    (folder / "lamp.ies").write_text(PROFILE)
    path = str(folder / (name + ".exr"))
    bothBackEnds.record(str(folder / "stage.usda"), path, "-w", "48", "--disableCameraLight", *arguments)
    return bothBackEnds.pixels(path)


def drawn(folder, name, samples, *arguments, **changes):
    return image(folder, name, "--backend", "raster", "--samples", str(samples), *arguments, **changes)


def test_outlines_are_near_the_path_tracer_and_without_noise(tmp_path):
    truth = image(tmp_path, "traced", "--backend", "embree", "--samples", "256", "--maxDepth", "1")
    outlines = drawn(tmp_path, "outlines", 16, *OUTLINES)
    for channel in range(3):
        assert truth[..., channel].mean() > 0.01, "a light is off"
        found = bothBackEnds.numbers(*(np.repeat(i[..., channel:channel + 1], 3, axis=2) for i in (outlines, truth)))
        assert abs(found["bias"]) <= 0.03, (channel, found)
        assert found["worst"] <= 0.3, (channel, found)
    error = {name: bothBackEnds.numbers(drawn(tmp_path, name, 1, *arguments), truth)["relMSE"]
             for name, arguments in (("outline", OUTLINES), ("sampled", ()))}
    assert error["outline"] < 0.1 * error["sampled"], error


def test_what_has_no_outline_is_sampled(tmp_path):
    """To the last bit: a profile, a cone, an image on a light, and then lobes that no transform stands for."""
    _image(str(tmp_path))
    shaped = (light("SphereLight", '        float inputs:intensity = 0.05\n        float inputs:radius = 0.2\n'
                    '        asset inputs:shaping:ies:file = @./lamp.ies@', "profile", api="ShapingAPI")
              + light("DiskLight", '        float inputs:intensity = 30\n        float inputs:radius = 0.3\n'
                      '        float inputs:shaping:cone:angle = 20', "cone", api="ShapingAPI")
              + light("RectLight", '        float inputs:intensity = 3\n        asset inputs:texture:file = @./image.exr@',
                      "picture"))
    for name, changes in (("lights", {"lights": shaped}), ("lobes", {"floor": BRUSHED, "block": BRUSHED})):
        sampled = drawn(tmp_path, name, 2, **changes)
        assert sampled.mean() > 0.003, "the light is off"
        assert np.array_equal(drawn(tmp_path, name + "Outlines", 2, *OUTLINES, **changes), sampled), name
