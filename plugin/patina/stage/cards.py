# SPDX-License-Identifier: Apache-2.0
"""Models that stand as cards: textured sides of their extents, a cross of three planes, or pictures where they were taken."""
import _patina
import numpy as np

from patina import networks

from . import assets
from .context import get, shown

# face -> axis across, direction of its outside, axes to the right and up as seen from outside (with
# sign), so that pictures taken along the axes fit
_FACES = {
    "XPos": (0, 1, (1, 1), (2, 1)), "XNeg": (0, -1, (1, -1), (2, 1)),
    "YPos": (1, 1, (0, -1), (2, 1)), "YNeg": (1, -1, (0, 1), (2, 1)),
    "ZPos": (2, 1, (0, 1), (1, 1)), "ZNeg": (2, -1, (0, -1), (1, 1)),
}
_ST = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)


def faces_of(context, prim, geometry):
    """:param geometry: cross, box or fromTexture
    :returns: dict from face to texture (empty for none), of the faces that are drawn"""
    textures = {face: assets.existing(context, prim, "model:cardTexture" + face, "cardFileMissing") for face in _FACES}
    if geometry == "fromTexture":
        return {face: file for face, file in textures.items() if file}
    if any(textures.values()):
        # Sides without a picture of their own show that of the other side, or are left out.
        opposite = {face: face[0] + ("Neg" if face.endswith("Pos") else "Pos") for face in textures}
        textures = {face: file or textures[opposite[face]] for face, file in textures.items()
                    if file or textures[opposite[face]]}
    if geometry != "box":
        textures = {face: file for face, file in textures.items() if face.endswith("Pos")}
    return textures


def quad(face, low, high, cross):
    """:returns: four corners of a card, counterclockwise from outside"""
    axis, side, right, up = _FACES[face]
    points = np.empty((4, 3), np.float32)
    points[:, axis] = (low[axis] + high[axis]) / 2 if cross else (high if side > 0 else low)[axis]
    for (other, sign), column in ((right, 0), (up, 1)):
        ends = (low[other], high[other]) if sign > 0 else (high[other], low[other])
        points[:, other] = np.where(_ST[:, column] > 0, ends[1], ends[0])
    return points


def quad_of_picture(metadata):
    """The image's own `worldtoscreen`, 16 numbers by rows, takes the model to [-1,1]; y of the screen points down, as
    UsdImaging has it. Older files call it worldToNDC.

    :param metadata: dict of an image
    :returns: four corners of a card
    :raises RuntimeError: where the image has no such matrix, or none that can be turned back"""
    named = {name.lower(): value for name, value in metadata.items()}
    text = named.get("worldtoscreen") or named.get("worldtondc") or ""
    try:
        matrix = np.array([float(word) for word in str(text).replace(",", " ").split()]).reshape(4, 4)
        screen = np.column_stack([_ST[:, 0] * 2 - 1, 1 - _ST[:, 1] * 2, np.zeros(4), np.ones(4)])
        corners = screen @ np.linalg.inv(matrix)
    except (ValueError, np.linalg.LinAlgError):
        raise RuntimeError("the picture has no worldtoscreen matrix of 16 numbers that can be turned back") from None
    with np.errstate(all="ignore"):
        points = (corners[:, :3] / corners[:, 3:]).astype(np.float32)
    if not np.isfinite(points).all():
        raise RuntimeError("the picture's worldtoscreen matrix puts corners out of reach")
    return points


def emit(context, found, low, high, common, color):
    """:param common: fields of the meshes: group, transform"""
    prim = found.prim
    geometry = get(prim, "model:cardGeometry", context.time, "cross")
    if geometry not in ("cross", "box", "fromTexture"):
        context.warn(prim.GetPath(), "model:cardGeometry", "cardGeometryUnknown", shown(geometry))
    for face, file in faces_of(context, prim, geometry).items():
        path = f"{found.path}/card{face}"
        points = quad(face, low, high, geometry != "box")
        if geometry == "fromTexture":
            try:
                points = quad_of_picture(_patina.read_image(file).metadata)
            except RuntimeError as error:
                context.warn(prim.GetPath(), "model:cardTexture" + face, "cardLeftOut", error)
                continue
        context.edit.set_mesh(
            path, points=points, face_vertex_counts=np.array([4], np.int32),
            face_vertex_indices=np.arange(4, dtype=np.int32), double_sided=True,
            material=_material(context, path + "/material", file) if file else "",
            primvars=[("st", "vertex", _ST, None), ("displayColor", "constant", np.array([color], np.float32))],
            **common)


def _material(context, path, file):
    """As UsdImaging makes it. :returns: path of a material that shows a picture and cuts out where it is transparent"""
    network, clamp = _patina.Network(path), ("token", "clamp")
    st = networks.add(network, path + "/st", "UsdPrimvarReader_float2", {"varname": ("string", "st")})
    texture = networks.add(network, path + "/texture", "UsdUVTexture",
                           {"file": ("asset", file), "wrapS": clamp, "wrapT": clamp}, st=(st, "result"))
    surface = networks.add(network, path + "/surface", "UsdPreviewSurface", {"opacityThreshold": ("float", 0.1)},
                           diffuseColor=(texture, "rgb"), opacity=(texture, "a"))
    network.set_terminal("surface", surface, "surface")
    context.edit.set_material(path, network)
    return path
