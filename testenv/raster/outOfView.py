# SPDX-License-Identifier: Apache-2.0
"""Stages in which an emitter stands above the frame: a floor with a block on it, seen from low down and close.

Only the floor and the block are in view, so that whatever is lost of an emitter because the camera does not see it is missing
from the picture."""
import floorLights
from usda import camera, floor, lobe, material, mesh, prim, stage

STAGE = stage(
    prim("Xform", "World",
        camera(lens=(35, 20.955, 11.787), clippingRange=(0.01, 1000), at=(0, 1.6, 4), turn=(-22, 0, 0)),
        floor("floor", 9, "rel material:binding = </World/matte>"),
        "%(block)s",
        lobe("matte", "oren_nayar_diffuse_bsdf", inside="/World", color=(0.6, 0.5, 0.4)),
        "%(emitter)s"),
    defaultPrim="World", metersPerUnit=1)
BLOCK = prim("Cube", "block", "rel material:binding = </World/matte>", size=0.4, at=(0.5, 0.2, 0.6))
# Above the frame, turned down and a little aside; and farther away than all that is seen is deep.
PLACE = {"at": (-0.4, 2.2, 0.2), "turn": (-80, 12, 0)}
FAR = {"at": (-1.2, 8, 0.6), "turn": (-80, 12, 0), "scale": (4, 4, 4)}


def _light(kind, *lines, **inputs):
    """:returns: a function of a place"""
    return lambda place: prim(kind, "light", *lines, **inputs, **place)


def _quad(*lines, **more):
    """It faces along z before it is placed, so mostly down after."""
    corners = [(-0.4, -0.3, 0), (-0.4, 0.3, 0), (0.4, 0.3, 0), (0.4, -0.3, 0)]
    return lambda place: mesh("light", corners, *lines, **more, **place)


def _glow(edfs, shape=_quad("rel material:binding = </World/glow>")):
    """:param edfs: nodes, the last of them named edf"""
    look = material("glow", {**edfs, "surface": ("ND_surface", {"edf": "<edf>"})}, "/World")
    return lambda place: shape(place) + look


def _bound(kind, *lines, **values):
    return _light(kind, *lines, "rel material:binding = </World/glow>", **values)


UNIFORM = {"edf": ("ND_uniform_edf", {"color": (9, 8, 6)})}
CONICAL = {"edf": ("ND_conical_edf", {"color": (30, 26, 20), "inner_angle": 30, "outer_angle": 70})}
SCHLICK = {"base": ("ND_uniform_edf", {"color": (9, 8, 6)}),
           "edf": ("ND_generalized_schlick_edf", {"color0": (1, 0.9, 0.8), "color90": (0.05, 0.1, 0.2), "exponent": 1,
                                                  "base": "<base>"})}
EMITTERS = {  # functions of a place
    "rect": _light("RectLight", intensity=12, width=0.8, height=0.6),
    "rectImage": _light("RectLight", "asset inputs:texture:file = @./image.exr@", intensity=3, width=0.8, height=0.6),
    "disk": _light("DiskLight", intensity=12, radius=0.4),
    "sphere": _light("SphereLight", intensity=12, radius=0.3),
    "point": _light("SphereLight", "bool treatAsPoint = 1", intensity=12, radius=0.2),
    "cylinder": _light("CylinderLight", intensity=12, length=0.8, radius=0.1),
    "line": _light("CylinderLight", "bool treatAsLine = 1", intensity=40, length=0.8, radius=0.02),
    "spot": _light("DiskLight", "float inputs:shaping:cone:angle = 30", "float inputs:shaping:cone:softness = 0.4",
                   apis=("ShapingAPI",), intensity=40, radius=0.15),
    "profile": _light("SphereLight", "asset inputs:shaping:ies:file = @./lamp.ies@", apis=("ShapingAPI",), intensity=0.02,
                      radius=0.2),
    "sun": _light("DistantLight", intensity=3, angle=3),
    "dome": _light("DomeLight", "asset inputs:texture:file = @./image.exr@", intensity=0.3),
    "meshLight": _glow({"edf": ("ND_uniform_edf", {"color": (0, 0, 0)})},
                       _quad("float inputs:intensity = 12", apis=("MeshLightAPI",))),
    "glowingMesh": _glow(UNIFORM),
    "conical": _glow(CONICAL),
    "schlick": _glow(SCHLICK),
    "glowingCurves": _glow(UNIFORM, _bound("BasisCurves", 'float[] widths = [0.15] (interpolation = "constant")', type="linear",
                                           curveVertexCounts=[3], points=[(-0.5, 0, 0), (0, 0.1, 0), (0.5, 0, 0)])),
    "glowingPoints": _glow(UNIFORM, _bound("Points", points=[(-0.4, 0, 0), (0, 0.1, 0), (0.4, 0, 0)], widths=[0.3, 0.2, 0.3])),
    "glowingSphere": _glow(UNIFORM, _bound("Sphere", radius=0.25)),
}
PLACES = {name: PLACE for name in EMITTERS}
for name in ("rect", "meshLight", "glowingMesh"):
    EMITTERS[name + "Far"], PLACES[name + "Far"] = EMITTERS[name], FAR
WITHOUT_BLOCK = ("rect", "glowingMesh", "sun")  # nothing bounces on a floor alone: also by all light


def write(name, folder, block=True):
    """Writes the stage of an emitter with its files. :returns: its path"""
    text = STAGE % {"block": BLOCK if block else "", "emitter": EMITTERS[name](PLACES[name])}
    return floorLights.write(folder, text, f"outOfView-{name}{'' if block else '-alone'}", (0.3, 0.5, 1.0), (4.0, 2.0, 0.5))
