# SPDX-License-Identifier: Apache-2.0
"""A floor with a block on it under lights of one's own: text of stages."""
import os

import numpy as np

# A world that a camera looks down on; prims of one's own follow.
WORLD = """#usda 1.0
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
        float focalLength = 24
        float horizontalAperture = 20.955
        float verticalAperture = 20.955
        matrix4d xformOp:transform = ((1, 0, 0, 0), (0, 0.6, -0.8, 0), (0, 0.8, 0.6, 0), (0, 5.6, 4.2, 1))
        uniform token[] xformOpOrder = ["xformOp:transform"]
    }
%s
}
"""
STAGE = WORLD % """    def Mesh "floor"
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)]
        uniform token subdivisionScheme = "none"
        color3f[] primvars:displayColor = [(0.6, 0.6, 0.6)]
    }
    def Cube "block"
    {
        double size = 0.8
        double3 xformOp:translate = (0.5, 0.4, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        color3f[] primvars:displayColor = [(0.6, 0.3, 0.2)]
    }
%s"""

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

ASIDE = """        double3 xformOp:translate = (-2.2, 3.5, 2.5)
        float3 xformOp:rotateXYZ = (-50, -40, 0)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
"""


def light(kind, text, name="light", api="", place=ASIDE):
    prepend = f'(\n        prepend apiSchemas = ["{api}"]\n    )\n' if api else ""
    return f'    def {kind} "{name}" {prepend}\n    {{\n{text}\n{place}    }}\n'


def write(folder, stage):
    """Writes the text of a stage beside `lamp.ies` and `image.exr`, which lights may use.

    :returns: its path"""
    (folder / "stage.usda").write_text(stage)
    (folder / "lamp.ies").write_text(PROFILE)
    _write_image(str(folder))
    return str(folder / "stage.usda")


def _write_image(folder):
    """Few of its texels give nearly all of its light."""
    import _patina

    values = np.zeros((8, 8, 3), np.float32)
    values[:, :3] = (0.1, 0.2, 1.0)
    values[2:4, 5:7] = (20.0, 10.0, 2.0)
    _patina.write_image(os.path.join(folder, "image.exr"), values, ["R", "G", "B"])
