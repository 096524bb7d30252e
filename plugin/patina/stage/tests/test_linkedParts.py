# SPDX-License-Identifier: Apache-2.0
"""Links that name parts of instances, and lights in instances that are linked to parts of their own: what a stage's lights light
is the same where it is instanced and where it is not."""
import pytest


def lit(reading):
    """:returns: dict of (light, kind of link) -> set of the shapes that it means, by name and place on the x axis"""
    prims = {}
    for line in reading.text.splitlines():
        if not line.startswith(" "):
            own = prims.setdefault(line.partition(" ")[2], [line.partition(" ")[0]])
        else:
            own.append(line.strip())
    print(reading.text)
    return prims


LAMP = """
class "lamp" {
    def Sphere "shade" { }
    def Sphere "other" { }
    def SphereLight "bulb" {
        bool collection:lightLink:includeRoot = 0
        rel collection:lightLink:includes = </lamp/shade> }
}
"""


def test_it(read):
    lit(read(LAMP + """
    def Xform "a" (inherits = </lamp>  instanceable = true) { double3 xformOp:translate = (1, 0, 0)  uniform token[] xformOpOrder = ["xformOp:translate"] }
    def Xform "b" (inherits = </lamp>  instanceable = true) { }
    def PointInstancer "pi" { rel prototypes = </lamp>  int[] protoIndices = [0]  point3f[] positions = [(0,0,0)] }
    """))
    assert 0
