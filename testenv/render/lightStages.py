# SPDX-License-Identifier: Apache-2.0
"""Stages of a white Lambertian floor under each kind of light, with closed forms of its irradiance.

A floor of albedo 0.5 reflects 0.5 E / pi. The irradiances E are those of textbooks (Siegel and
Howell, Thermal Radiation Heat Transfer, configuration factors); the emitted radiance is what the
UsdLux overview says: intensity * 2^exposure * color, divided by the area when normalised.
"""
import math

STAGE = """#usda 1.0
(
    upAxis = "Y"
)
def Camera "camera"
{{
    float2 clippingRange = (0.01, 1000)
    float focalLength = 500
    float horizontalAperture = 1
    float verticalAperture = 1
    double3 xformOp:translate = (0, 3, 9)
    float xformOp:rotateX = -18.434948822922
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}}
def Mesh "floor" (
    prepend apiSchemas = ["MaterialBindingAPI"]
)
{{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-5, 0, 5), (5, 0, 5), (5, 0, -5), (-5, 0, -5)]
    uniform token subdivisionScheme = "none"
    rel material:binding = </white>
}}
def Material "white"
{{
    token outputs:mtlx:surface.connect = </white/surface.outputs:out>
    def Shader "diffuse"
    {{
        uniform token info:id = "ND_oren_nayar_diffuse_bsdf"
        color3f inputs:color = (0.5, 0.5, 0.5)
        token outputs:out
    }}
    def Shader "surface"
    {{
        uniform token info:id = "ND_surface"
        token inputs:bsdf.connect = </white/diffuse.outputs:out>
        token outputs:out
    }}
}}
{light}
"""
DOWN = ('float xformOp:rotateX = -90\n    double3 xformOp:translate = (0, 2, 0)\n'
        '    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]')
ABOVE = 'double3 xformOp:translate = (0, 2, 0)\n    uniform token[] xformOpOrder = ["xformOp:translate"]'


def light(kind, attributes, place=DOWN, api=""):
    applied = f' (\n    prepend apiSchemas = ["{api}"]\n)' if api else ""
    body = "\n    ".join(attributes)
    return f'def {kind} "light"{applied}\n{{\n    {body}\n    {place}\n}}\n'


def rect_irradiance(width, height, distance):
    """Radiance 1, facing parallel rectangle, above its centre (four quarter rectangles)."""
    a, b = width / 2 / distance, height / 2 / distance
    x, y = math.sqrt(1 + a * a), math.sqrt(1 + b * b)
    return 4 * 0.5 * (a / x * math.atan(b / x) + b / y * math.atan(a / y))


def cylinder_irradiance(radius, length, distance, steps=400):
    """Radiance 1, axis parallel to the floor, by quadrature over the visible side."""
    total = 0.0
    for i in range(steps):
        x = (i + 0.5) / steps * length - length / 2
        for j in range(steps):
            angle = (j + 0.5) / steps * math.pi  # lower half only faces the point, roughly
            n = (0.0, -math.sin(angle), math.cos(angle))
            p = (x, distance + radius * n[1], radius * n[2])
            d2 = p[0] ** 2 + p[1] ** 2 + p[2] ** 2
            d = math.sqrt(d2)
            cos_light = -(p[1] * n[1] + p[2] * n[2]) / d
            if cos_light > 0:
                total += cos_light * (p[1] / d) / d2 * (length / steps) * (radius * math.pi / steps)
    return total


CASES = {
    "sphere": (light("SphereLight", ["float inputs:intensity = 3", "float inputs:radius = 0.5"], ABOVE),
               3 * math.pi * (0.5 / 2) ** 2),
    "sphere normalized": (light("SphereLight", ["float inputs:intensity = 3", "float inputs:radius = 0.5",
                                                "bool inputs:normalize = 1"], ABOVE),
                          3 / (4 * math.pi * 0.25) * math.pi * (0.5 / 2) ** 2),
    "sphere with exposure and colour": (light("SphereLight", ["float inputs:intensity = 3", "float inputs:exposure = 2",
                                                              "color3f inputs:color = (0.5, 0.5, 0.5)",
                                                              "float inputs:radius = 0.5"], ABOVE),
                                        6 * math.pi * (0.5 / 2) ** 2),
    "disk": (light("DiskLight", ["float inputs:intensity = 3", "float inputs:radius = 1"]), 3 * math.pi * 1 / (1 + 4)),
    "disk normalized": (light("DiskLight", ["float inputs:intensity = 3", "float inputs:radius = 1",
                                            "bool inputs:normalize = 1"]), 3 / math.pi * math.pi / (1 + 4)),
    "disk facing away": (light("DiskLight", ["float inputs:intensity = 3", "float inputs:radius = 1"],
                               DOWN.replace("-90", "90")), 0.0),
    "rect": (light("RectLight", ["float inputs:intensity = 3", "float inputs:width = 2", "float inputs:height = 1"]),
             3 * rect_irradiance(2, 1, 2)),
    "rect normalized": (light("RectLight", ["float inputs:intensity = 3", "float inputs:width = 2", "float inputs:height = 1",
                                            "bool inputs:normalize = 1"]),
                        1.5 * rect_irradiance(2, 1, 2)),
    "cylinder": (light("CylinderLight", ["float inputs:intensity = 3", "float inputs:radius = 0.25", "float inputs:length = 2"],
                       ABOVE),
                 3 * cylinder_irradiance(0.25, 2, 2)),
    "distant": (light("DistantLight", ["float inputs:intensity = 3", "float inputs:angle = 20"]),
                3 * math.pi * math.sin(math.radians(10)) ** 2),
    "distant normalized": (light("DistantLight", ["float inputs:intensity = 3", "float inputs:angle = 20",
                                                  "bool inputs:normalize = 1"]), 3.0),
    "dome": (light("DomeLight", ["float inputs:intensity = 3"], ""), 3 * math.pi),
    "cone that misses nothing": (light("DiskLight", ["float inputs:intensity = 3", "float inputs:radius = 0.01",
                                                     "float inputs:shaping:cone:angle = 30"], DOWN, "ShapingAPI"),
                                 3 * math.pi * 1e-4 / (1e-4 + 4)),
    "focus straight ahead": (light("DiskLight", ["float inputs:intensity = 3", "float inputs:radius = 0.01",
                                                 "float inputs:shaping:focus = 8"], DOWN, "ShapingAPI"),
                             3 * math.pi * 1e-4 / (1e-4 + 4)),
}
