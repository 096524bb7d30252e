# SPDX-License-Identifier: Apache-2.0
"""Authored normals of what UsdSkel deforms: offsets of blend shapes first, then the joints, as UsdSkelBakeSkinning does."""
import numpy as np
from pxr import UsdGeom, UsdSkel, Vt

from .context import array_of


def skin_normals(context, found, skin, primvars):
    """Deforms normals as the pose at the frame's time does; they have no motion samples.

    :param primvars: list, in which normals that are drawn are replaced"""
    prim, time = found.prim, context.time
    at = next((i for i, item in enumerate(primvars) if item[0] == "normals"), None)
    if at is None or (prim.IsA(UsdGeom.Mesh) and found.authored("subdivisionScheme", time) != "none"):
        return  # a subdivision surface has its own
    rest = array_of(context, prim, "points", 3)
    placed = _placed(context, prim, len(rest), primvars[at])
    if placed is None:
        context.warn(prim.GetPath(), "normals", "notSkinned")
        return
    interpolation, normals, points = placed
    if skin.target.HasBlendShapes():
        normals = _blended(context, skin, rest, normals, points)
    if skin.has_joints and not skin.rigid:
        normals = _posed(skin, time, len(rest), normals, points)
    primvars[at] = ("normals", interpolation, np.asarray(normals), None)


def _placed(context, prim, count, primvar):
    """:param count: of points
    :returns: (interpolation, normals, the point of each); None where they do not fit the prim. What has one normal for
        several points gets one for each, since these may turn apart"""
    _, interpolation, normals, indices = primvar
    if normals.ndim != 2 or normals.shape[1] != 3 or not count:
        return None
    if indices is not None:
        if indices.min() < 0 or indices.max() >= len(normals):
            return None
        normals = normals[indices]
    points = np.arange(count)
    if interpolation == "constant":
        interpolation, normals = "vertex", np.repeat(normals[:1], count, axis=0)
    elif interpolation in ("uniform", "faceVarying"):
        corners, counts = points, array_of(context, prim, "curveVertexCounts", 1, np.int32)
        if prim.IsA(UsdGeom.Mesh):
            counts, corners = _faces(context, prim, count)
        if interpolation == "uniform" and _fit(counts, corners) and len(counts) == len(normals):
            interpolation = "vertex" if corners is points else "faceVarying"
            normals = np.repeat(normals, counts, axis=0)
        points = corners
    return (interpolation, normals.astype(np.float32), points) if len(points) == len(normals) else None


def _faces(context, prim, count):
    """:returns: (numbers of corners of a mesh's faces, their points: those of broken faces are any)"""
    counts, corners = (array_of(context, prim, name, 1, np.int32) for name in ("faceVertexCounts", "faceVertexIndices"))
    return counts, np.clip(corners, 0, count - 1)


def _fit(counts, corners):
    """:returns: whether numpy may repeat and add by these counts: it does not look for the ends of its arrays"""
    return len(counts) and counts.min() >= 0 and counts.sum(dtype=np.int64) == len(corners)


def _blended(context, skin, rest, normals, points):
    """:returns: the normals, with the offsets that the blend shapes at work have; where none of the mesh's shapes has any, or
        they do not fit, turned as the deformed mesh is"""
    acting = skin.acting_shapes(context.time)
    if not acting:
        return normals
    shapes, parts = acting
    offsets = [_normal_offsets(shapes, number) for number in range(shapes.GetNumSubShapes())]
    total = Vt.Vec3fArray(len(rest))  # pxr changes it in place
    if any(offsets) and shapes.ComputeDeformedPoints(*parts, shapes.ComputeBlendShapePointIndices(), offsets, total):
        return _normalized(normals + np.asarray(total)[points])
    counts, corners = _faces(context, skin.target.GetPrim(), len(rest))
    if not _fit(counts, corners):
        return normals
    moved = np.asarray(skin.blend(context, Vt.Vec3fArray.FromNumpy(rest)))
    before, after = (smooth_normals(places, counts, corners)[points] for places in (rest, moved))
    axis, cosine = np.cross(before, after), np.sum(before * after, axis=1, keepdims=True)
    turned = np.cross(axis, normals)  # Rodrigues' formula for the smallest turn between both
    return normals + turned + np.cross(axis, turned) / np.maximum(1.0 + cosine, 1e-6)


def _normal_offsets(shapes, number):
    """:returns: those of a sub-shape, an in-between or a shape itself; empty where it has none"""
    shape = shapes.GetInbetween(number) or shapes.GetBlendShape(shapes.GetBlendShapeIndex(number))
    attribute = shape.GetNormalOffsetsAttr() if shape else None
    value = attribute.Get() if attribute else None
    return value if isinstance(value, Vt.Vec3fArray) else Vt.Vec3fArray()


def _normalized(vectors):
    length = np.linalg.norm(vectors.astype(np.float64), axis=1, keepdims=True)
    return (vectors / np.where(length > 0.0, length, 1.0)).astype(np.float32)


def _posed(skin, time, count, normals, points):
    """:returns: the normals in the space of the skeleton; those of the rest pose where pxr cannot compute them"""
    target, pose = skin.target, skin.query.ComputeSkinningTransforms(time)
    influences = target.ComputeVaryingJointInfluences(count, time)
    bind = _for_normals(target.GetGeomBindTransform(time))
    if pose and influences:
        mapper = target.GetJointMapper()
        matrices = Vt.Matrix3dArray([_for_normals(m) for m in (mapper.RemapTransforms(pose) if mapper else pose)])
        joints, weights = (np.asarray(values).reshape(count, -1)[points].ravel() for values in influences)
        skinned = Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(normals, dtype=np.float32))  # pxr changes it in place
        if UsdSkel.SkinNormals(target.GetSkinningMethod(), bind, matrices, Vt.IntArray.FromNumpy(joints),
                               Vt.FloatArray.FromNumpy(weights), target.GetNumInfluencesPerComponent(), skinned):
            return skinned
    return normals @ np.array(bind, dtype=np.float32)


def _for_normals(matrix):
    return matrix.ExtractRotationMatrix().GetInverse().GetTranspose()


def smooth_normals(points, counts, indices):
    """:returns: area-weighted vertex normals; Newell's sum over the edges of each face"""
    first = np.repeat(np.cumsum(counts) - counts, counts)
    corner = np.arange(len(indices)) - first
    following = indices[first + (corner + 1) % np.repeat(counts, counts)]
    cross = np.cross(points[indices], points[following])
    face = np.repeat(np.arange(len(counts)), counts)
    normals = np.zeros((len(counts), 3))
    np.add.at(normals, face, cross)
    total = np.zeros(points.shape)
    np.add.at(total, indices, normals[face])
    return _normalized(total)
