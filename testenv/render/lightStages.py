# SPDX-License-Identifier: Apache-2.0
"""Stages of a white Lambertian floor under each kind of light, with closed forms of its irradiance.

A floor of albedo 0.5 reflects 0.5 E / pi. The irradiances E are those of textbooks (Siegel and
Howell, Thermal Radiation Heat Transfer, configuration factors); the emitted radiance is what the
UsdLux overview says: intensity * 2^exposure * color, divided by the area when normalised.
"""
import math

import usda

DOWN = {"at": (0, 2, 0), "rotateX": -90}
ABOVE = {"at": (0, 2, 0)}


def stage(*prims):
    """:returns: the text of the floor with these"""
    return usda.stage(
        usda.camera(lens=(500, 1, 1), clippingRange=(0.01, 1000), at=(0, 3, 9), rotateX=-18.434948822922),
        usda.floor("floor", 5, bind="white"),
        usda.lobe("white", "oren_nayar_diffuse_bsdf", color=(0.5, 0.5, 0.5)), *prims)


def light(kind, *lines, place=DOWN, **inputs):
    """:param place: transforms, as usda.prim() takes them"""
    return usda.prim(kind, "light", *lines, **inputs, **place)


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
    "sphere": (light("SphereLight", intensity=3, radius=0.5, place=ABOVE), 3 * math.pi * (0.5 / 2) ** 2),
    "sphere normalized": (light("SphereLight", intensity=3, radius=0.5, normalize=True, place=ABOVE),
                          3 / (4 * math.pi * 0.25) * math.pi * (0.5 / 2) ** 2),
    "sphere with exposure and colour": (light("SphereLight", intensity=3, exposure=2, color=(0.5, 0.5, 0.5), radius=0.5,
                                              place=ABOVE), 6 * math.pi * (0.5 / 2) ** 2),
    "disk": (light("DiskLight", intensity=3, radius=1), 3 * math.pi * 1 / (1 + 4)),
    "disk normalized": (light("DiskLight", intensity=3, radius=1, normalize=True), 3 / math.pi * math.pi / (1 + 4)),
    "disk facing away": (light("DiskLight", intensity=3, radius=1, place={**DOWN, "rotateX": 90}), 0.0),
    "rect": (light("RectLight", intensity=3, width=2, height=1), 3 * rect_irradiance(2, 1, 2)),
    "rect normalized": (light("RectLight", intensity=3, width=2, height=1, normalize=True), 1.5 * rect_irradiance(2, 1, 2)),
    "cylinder": (light("CylinderLight", intensity=3, radius=0.25, length=2, place=ABOVE),
                 3 * cylinder_irradiance(0.25, 2, 2)),
    "distant": (light("DistantLight", intensity=3, angle=20), 3 * math.pi * math.sin(math.radians(10)) ** 2),
    "distant normalized": (light("DistantLight", intensity=3, angle=20, normalize=True), 3.0),
    "dome": (light("DomeLight", intensity=3, place={}), 3 * math.pi),
    "cone that misses nothing": (light("DiskLight", "float inputs:shaping:cone:angle = 30", intensity=3, radius=0.01,
                                       apis=("ShapingAPI",)), 3 * math.pi * 1e-4 / (1e-4 + 4)),
    "focus straight ahead": (light("DiskLight", "float inputs:shaping:focus = 8", intensity=3, radius=0.01,
                                   apis=("ShapingAPI",)), 3 * math.pi * 1e-4 / (1e-4 + 4)),
}
