# SPDX-License-Identifier: Apache-2.0
"""Stages in which an emitter stands above the frame: a floor with a block on it, seen from low down and close.

Only the floor and the block are in view, so that whatever is lost of an emitter because the camera does not see it is missing
from the picture."""
import os

import numpy as np

STAGE = """#usda 1.0
(
    defaultPrim = "World"
    upAxis = "Y"
    metersPerUnit = 1
)
def Xform "World"
{
    def Camera "camera"
    {
        float2 clippingRange = (0.01, 1000)
        float focalLength = 35
        float horizontalAperture = 20.955
        float verticalAperture = 11.787
        float3 xformOp:rotateXYZ = (-22, 0, 0)
        double3 xformOp:translate = (0, 1.6, 4)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
    }
    def Mesh "floor"
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-9, 0, 9), (9, 0, 9), (9, 0, -9), (-9, 0, -9)]
        uniform token subdivisionScheme = "none"
        rel material:binding = </World/matte>
    }
%(block)s
    def Material "matte"
    {
        token outputs:mtlx:surface.connect = </World/matte/surface.outputs:out>
        def Shader "bsdf"
        {
            uniform token info:id = "ND_oren_nayar_diffuse_bsdf"
            color3f inputs:color = (0.6, 0.5, 0.4)
            token outputs:out
        }
        def Shader "surface"
        {
            uniform token info:id = "ND_surface"
            token inputs:bsdf.connect = </World/matte/bsdf.outputs:out>
            token outputs:out
        }
    }
%(emitter)s
}
"""
BLOCK = """    def Cube "block"
    {
        double size = 0.4
        double3 xformOp:translate = (0.5, 0.2, 0.6)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        rel material:binding = </World/matte>
    }
"""
# Above the frame, turned down and a little aside.
PLACE = """        double3 xformOp:translate = (-0.4, 2.2, 0.2)
        float3 xformOp:rotateXYZ = (-80, 12, 0)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
"""
FAR = """        double3 xformOp:translate = (-1.2, 8, 0.6)
        float3 xformOp:rotateXYZ = (-80, 12, 0)
        float3 xformOp:scale = (4, 4, 4)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ", "xformOp:scale"]
"""
# A quad that faces along z before it is placed, so mostly down after.
QUAD = """        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-0.4, -0.3, 0), (-0.4, 0.3, 0), (0.4, 0.3, 0), (0.4, -0.3, 0)]
        uniform token subdivisionScheme = "none"
"""
PROFILE = """IESNA:LM-63-1995
TILT=NONE
1 1000 1 5 5 1 1 0 0 0
1.0 1.0 100
0 20 40 60 90
0 90 180 270 360
1000 900 500 100 0
1000 600 200 50 0
1000 300 100 20 0
1000 600 400 50 0
1000 900 500 100 0
"""


def _light(kind, text, api=""):
    prepend = f'(\n        prepend apiSchemas = ["{api}"]\n    )\n' if api else ""
    lines = "\n".join("        " + line for line in text.split("; "))
    return f'    def {kind} "light" {prepend}    {{\n{lines}\n{PLACE}    }}\n'


def _glow(edf, shape="Mesh", geometry=QUAD):
    """:param edf: text of shaders, the last of them named edf"""
    return f"""    def {shape} "light"
    {{
{geometry}{PLACE}        rel material:binding = </World/glow>
    }}
    def Material "glow"
    {{
        token outputs:mtlx:surface.connect = </World/glow/surface.outputs:out>
{edf}
        def Shader "surface"
        {{
            uniform token info:id = "ND_surface"
            token inputs:edf.connect = </World/glow/edf.outputs:out>
            token outputs:out
        }}
    }}
"""


def _edf(name, node, text):
    lines = "\n".join("            " + line for line in text.split("; "))
    return f"""        def Shader "{name}"
        {{
            uniform token info:id = "{node}"
{lines}
            token outputs:out
        }}
"""


UNIFORM = _edf("edf", "ND_uniform_edf", "color3f inputs:color = (9, 8, 6)")
CONICAL = _edf("edf", "ND_conical_edf", "color3f inputs:color = (30, 26, 20); float inputs:inner_angle = 30; "
               "float inputs:outer_angle = 70")
SCHLICK = _edf("base", "ND_uniform_edf", "color3f inputs:color = (9, 8, 6)") + _edf(
    "edf", "ND_generalized_schlick_edf", "color3f inputs:color0 = (1, 0.9, 0.8); color3f inputs:color90 = (0.05, 0.1, 0.2); "
    "float inputs:exponent = 1; token inputs:base.connect = </World/glow/base.outputs:out>")

EMITTERS = {
    "rect": _light("RectLight", "float inputs:intensity = 12; float inputs:width = 0.8; float inputs:height = 0.6"),
    "rectImage": _light("RectLight", "float inputs:intensity = 3; float inputs:width = 0.8; float inputs:height = 0.6; "
                        "asset inputs:texture:file = @./image.exr@"),
    "disk": _light("DiskLight", "float inputs:intensity = 12; float inputs:radius = 0.4"),
    "sphere": _light("SphereLight", "float inputs:intensity = 12; float inputs:radius = 0.3"),
    "point": _light("SphereLight", "float inputs:intensity = 12; float inputs:radius = 0.2; bool treatAsPoint = 1"),
    "cylinder": _light("CylinderLight", "float inputs:intensity = 12; float inputs:length = 0.8; float inputs:radius = 0.1"),
    "line": _light("CylinderLight", "float inputs:intensity = 40; float inputs:length = 0.8; float inputs:radius = 0.02; "
                   "bool treatAsLine = 1"),
    "spot": _light("DiskLight",
                   "float inputs:intensity = 40; float inputs:radius = 0.15; float inputs:shaping:cone:angle = 30; "
                   "float inputs:shaping:cone:softness = 0.4", "ShapingAPI"),
    "profile": _light("SphereLight", "float inputs:intensity = 0.02; float inputs:radius = 0.2; "
                      "asset inputs:shaping:ies:file = @./lamp.ies@", "ShapingAPI"),
    "sun": _light("DistantLight", "float inputs:intensity = 3; float inputs:angle = 3"),
    "dome": _light("DomeLight", "asset inputs:texture:file = @./image.exr@; float inputs:intensity = 0.3"),
    "meshLight": _glow(UNIFORM.replace("(9, 8, 6)", "(0, 0, 0)")).replace(
        'def Mesh "light"\n', 'def Mesh "light" (\n        prepend apiSchemas = ["MeshLightAPI"]\n    )\n').replace(
        "        rel material:binding = </World/glow>\n", "        float inputs:intensity = 12\n", 1),
    "glowingMesh": _glow(UNIFORM),
    "conical": _glow(CONICAL),
    "schlick": _glow(SCHLICK),
    "glowingCurves": _glow(UNIFORM, "BasisCurves", """        uniform token type = "linear"
        int[] curveVertexCounts = [3]
        point3f[] points = [(-0.5, 0, 0), (0, 0.1, 0), (0.5, 0, 0)]
        float[] widths = [0.15] (
            interpolation = "constant"
        )
"""),
    "glowingPoints": _glow(UNIFORM, "Points", """        point3f[] points = [(-0.4, 0, 0), (0, 0.1, 0), (0.4, 0, 0)]
        float[] widths = [0.3, 0.2, 0.3]
"""),
    "glowingSphere": _glow(UNIFORM, "Sphere", "        double radius = 0.25\n"),
}
# Farther away than all that is seen is deep.
EMITTERS.update({name + "Far": EMITTERS[name].replace(PLACE, FAR) for name in ("rect", "meshLight", "glowingMesh")})
WITHOUT_BLOCK = ("rect", "glowingMesh", "sun")  # nothing bounces on a floor alone: also by all light


def write(name, folder, block=True):
    """Writes the stage of an emitter with its files. :returns: its path"""
    import _patina

    path = os.path.join(folder, f"outOfView-{name}{'' if block else '-alone'}.usda")
    with open(path, "w", encoding="utf-8") as out:
        out.write(STAGE % {"block": BLOCK if block else "", "emitter": EMITTERS[name]})
    with open(os.path.join(folder, "lamp.ies"), "w", encoding="utf-8") as out:
        out.write(PROFILE)
    values = np.zeros((8, 8, 3), np.float32)
    values[:, :3] = (0.3, 0.5, 1.0)
    values[2:4, 5:7] = (4.0, 2.0, 0.5)
    _patina.write_image(os.path.join(folder, "image.exr"), values, ["R", "G", "B"])
    return path
