# SPDX-License-Identifier: Apache-2.0
"""Back plates of cameras (UsdGeomBackPlateAPI, OpenUSD 26.08): pictures that fill the camera's frame where it is in focus.

Cameras see them. They light nothing, cast no shadow, and are in no reflection.
"""
import _patina
import numpy as np
from pxr import Gf

from patina import networks

from . import assets, marks
from .context import get, number, vector
from .transforms import transform_of

_APERTURE_UNIT = 0.1  # of an aperture, in scene units
_ST = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)
_ONLY_CAMERAS = {"patina:visibility:indirect": False, "patina:visibility:shadow": False}
_ALPHAS = {1: ("float", None), 2: ("vector2", 1), 4: ("color4", 3)}  # by channels: type of the node, channel


def emit(context, cameras, chosen):
    """Draws the plates that the camera of the picture shows.

    :param cameras: list of Found"""
    for found in cameras:
        for schema in found.prim.GetAppliedSchemas():
            if not schema.startswith("BackPlateAPI:"):
                continue
            name = schema.partition(":")[2]
            seen = get(found.prim, f"backPlate:{name}:plateVisibility", context.time, "solo")
            if seen == "all" or seen == "solo" and found is chosen:
                _emit(context, found, f"backPlate:{name}:", f"{found.path}/{name}")


def _emit(context, found, prefix, path):
    prim = found.prim
    size = np.array([number(context, prim, side + "Aperture", fallback) * _APERTURE_UNIT
                     for side, fallback in (("horizontal", 20.955), ("vertical", 15.2908))])
    distance = number(context, prim, "focusDistance", 0.0)
    if get(prim, "projection", context.time, "perspective") != "orthographic":
        size *= distance / (number(context, prim, "focalLength", 50.0) * _APERTURE_UNIT)
    size *= np.array(vector(context, prim, prefix + "scale:tweak", (1.0, 1.0)))
    if not (np.isfinite(size).all() and (size != 0.0).all()):
        context.warn(prim.GetPath(), "focusDistance", "backPlateSizeless", prefix[10:-1])
        return
    if get(prim, prefix + "depth:image", context.time):
        context.warn(prim.GetPath(), prefix + "depth:image", "backPlateFlat")
    turns = vector(context, prim, prefix + "rotateXYZ:tweak", (0.0, 0.0, 0.0))
    rotation = Gf.Rotation(Gf.Vec3d(0, 0, 1), turns[2]) * Gf.Rotation(Gf.Vec3d(0, 1, 0), turns[1]) * Gf.Rotation(
        Gf.Vec3d(1, 0, 0), turns[0])
    place = Gf.Matrix4d().SetTransform(
        rotation, Gf.Vec3d(*vector(context, prim, prefix + "translate:tweak", (0.0, 0.0, 0.0))) - Gf.Vec3d(0, 0, distance))
    points = np.column_stack([(_ST - 0.5) * size, np.zeros(4)]).astype(np.float32)
    fields = marks.fields(found)
    context.edit.set_mesh(
        path, points=points, face_vertex_counts=np.array([4], np.int32), face_vertex_indices=np.arange(4, dtype=np.int32),
        double_sided=True, transform=transform_of(context, prim, None, lambda offset: place),
        material=_material(context, prim, prefix, path + "/material"), primvars=[("st", "vertex", _ST, None)],
        **{**fields, "marks": {**fields.get("marks", {}), **_ONLY_CAMERAS}})
    context.count("backPlates")


def _material(context, prim, prefix, path):
    """:returns: path of a material that glows as the plate says"""
    network = _patina.Network(path)
    surface = path + "/surface"
    network.add_node(surface, "ND_surface_unlit")
    picture = assets.existing(context, prim, prefix + "image", "backPlateFileMissing")
    if picture:
        color = _image(network, path + "/image", "color3", picture,
                       context.color_spaces.space_of(prim.GetAttribute(prefix + "image"), reads_colors=True) or "auto")
        network.connect(surface, "emission_color", _graded(context, prim, prefix + "luma:", network, color))
    else:
        network.set_input(surface, "emission_color", "color3", (0.0, 0.0, 0.0))
    alpha = assets.existing(context, prim, prefix + "alpha:image", "backPlateFileMissing")
    if alpha:
        channels = len(_patina.read_image(alpha).channels)
        if channels in _ALPHAS:
            type_, index = _ALPHAS[channels]
            opacity = _image(network, path + "/alpha", type_, alpha, "raw")
            if index is not None:
                opacity = networks.add(network, path + "/channel", "ND_extract_" + type_, {"index": ("integer", index)},
                                       **{"in": opacity})
            network.connect(surface, "opacity", opacity)
        else:
            context.warn(prim.GetPath(), prefix + "alpha:image", "backPlateChannels", channels)
    network.set_terminal("surface", surface)
    context.edit.set_material(path, network)
    return path


def _image(network, path, type_, file, space):
    clamp = ("string", "clamp")
    return networks.add(network, path, "ND_image_" + type_, {"file": ("filename", file, space), "uaddressmode": clamp,
                                                             "vaddressmode": clamp})


def _graded(context, prim, prefix, network, color):
    """(value (gain - lift) + lift)^(1 / gamma)

    :returns: path of the last node"""
    gain, lift, gamma = (np.array(vector(context, prim, prefix + name, fallback)) for name, fallback in
                         (("gain", (1.0, 1.0, 1.0)), ("lift", (0.0, 0.0, 0.0)), ("gamma", (1.0, 1.0, 1.0))))
    if not (gamma > 0.0).all():
        context.warn(prim.GetPath(), prefix + "gamma", "backPlateGamma")
        gamma = np.ones(3)
    for operation, value, idle in (("multiply", gain - lift, 1.0), ("add", lift, 0.0), ("power", 1.0 / gamma, 1.0)):
        if (value != idle).any():
            color = networks.add(network, f"{color}_{operation}", f"ND_{operation}_color3",
                                 {"in2": ("color3", tuple(map(float, value)))}, in1=color)
    return color
