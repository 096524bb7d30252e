# SPDX-License-Identifier: Apache-2.0
"""UsdSkel: skinned points by pxr's own queries, blend shapes first."""
import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdSkel, Vt

from .context import array, array_of, get, merged
from .transforms import as_transform, matrix_at, sample_times


def skinning_of(context, root):
    """:param root: a SkelRoot
    :returns: dict from prim path to Skin of what is skinned below it, instances included; None when
    nothing is"""
    cache, skel_root = UsdSkel.Cache(), UsdSkel.Root(root)
    predicate = Usd.TraverseInstanceProxies()
    skins = {}
    if not cache.Populate(skel_root, predicate):
        return None
    for binding in cache.ComputeSkelBindings(skel_root, predicate):
        skeleton = binding.GetSkeleton()
        query = cache.GetSkelQuery(skeleton)
        for target in binding.GetSkinningTargets():
            prim = target.GetPrim()
            if not query or not (target.HasJointInfluences() or target.HasBlendShapes()):
                context.warn(prim.GetPath(), "skel", "noSkeleton")
                continue
            skins[prim.GetPath()] = Skin(skeleton.GetPrim(), query, target)
    return skins or None


def skin_of(found):
    """:returns: the Skin of a found prim or None"""
    skins = found.state.skinning
    return skins.get(found.prim.GetPath()) if skins else None


class Skin:
    """How one prim is skinned."""

    def __init__(self, skeleton, query, target):
        self.skeleton, self.query, self.target = skeleton, query, target
        self.has_joints = target.HasJointInfluences()
        self.rigid = self.has_joints and target.IsRigidlyDeformed()
        self.deforms = target.HasBlendShapes() or (self.has_joints and not self.rigid)

    def offsets(self, context):
        """:returns: times relative to the frame at which the pose is evaluated"""
        interval = context.shutter_interval()
        bind = self.target.GetGeomBindTransformAttr()
        samples = set(bind.GetTimeSamplesInInterval(interval)) if bind else set()
        animation = self.query.GetAnimQuery()
        if animation:
            samples.update(animation.GetJointTransformTimeSamplesInInterval(interval))
            samples.update(animation.GetBlendShapeWeightTimeSamplesInInterval(interval))
        return context.motion_offsets(samples)

    def transform(self, context, anchor):
        """Skinned points are in the space of the skeleton."""
        place = self.skeleton if self.has_joints else self.target.GetPrim()
        times = sample_times(context, place, anchor)
        if self.rigid and context.moving:
            times = merged([*times, *self.offsets(context)])
        matrices = [matrix_at(context, place, anchor, t) for t in times]
        if self.rigid:
            matrices = [self._rigid(context.time_at(t)) * m for t, m in zip(times, matrices)]
        return as_transform(context, self.target.GetPrim(), times, matrices)

    def _rigid(self, time):
        pose = self.query.ComputeSkinningTransforms(time)
        moved = self.target.ComputeSkinnedTransform(pose, time) if pose else None
        return Gf.Matrix4d(moved) if moved else self.target.GetGeomBindTransform(time)

    def points(self, context, offset):
        """:returns: deformed points, or those of the rest pose where pxr cannot compute them"""
        time, prim = context.time_at(offset), self.target.GetPrim()
        points = UsdGeom.PointBased(prim).GetPointsAttr().Get(time)
        if points is None or not len(points):
            return []
        if self.target.HasBlendShapes():
            points = self._blend(context, time, points)
        if self.has_joints and not self.rigid:
            pose = self.query.ComputeSkinningTransforms(time)
            skinned = Vt.Vec3fArray(points)  # pxr changes it in place
            if not pose or not self.target.ComputeSkinnedPoints(pose, skinned, time):
                context.warn(prim.GetPath(), "skel", "notSkinned")
                bind = np.array(self.target.GetGeomBindTransform(time), dtype=np.float32)
                skinned = np.asarray(points) @ bind[:3, :3] + bind[3, :3]
            points = skinned
        if offset == 0.0:
            placed = array(context, prim, "points", points, 3)
            if len(placed):
                context.skinned.append((self.skeleton if self.has_joints else prim, placed))
        return points

    def _blend(self, context, time, points):
        animation = self.query.GetAnimQuery()
        weights = animation.ComputeBlendShapeWeights(time) if animation else None
        if not weights:
            return points
        mapped = self.target.GetBlendShapeMapper().Remap(weights)
        shapes = UsdSkel.BlendShapeQuery(UsdSkel.BindingAPI(self.target.GetPrim()))
        parts = shapes.ComputeSubShapeWeights(mapped)
        if not mapped or not parts:
            return points
        moved = Vt.Vec3fArray(points)  # pxr changes it in place
        if not shapes.ComputeDeformedPoints(*parts, shapes.ComputeBlendShapePointIndices(),
                                            shapes.ComputeSubShapePointOffsets(), moved):
            context.warn(self.target.GetPrim().GetPath(), "skel:blendShapes", "blendShapesLeftOut")
            return points
        return moved

    def normals(self, context, found):
        """:returns: a primvar of smooth normals of the deformed points, None when subdivision makes
        its own or the rest pose had none"""
        prim, time = found.prim, context.time
        if get(prim, "subdivisionScheme", time, "catmullClark") != "none":
            return None
        if get(prim, "normals", time) is None and get(prim, "primvars:normals", time) is None:
            return None
        points = array(context, prim, "points", self.points(context, 0.0), 3)
        counts, indices = (array_of(context, prim, name, 1, np.int32).astype(np.int64)
                           for name in ("faceVertexCounts", "faceVertexIndices"))
        # Each count is checked before their sum: a sum that wraps would fit, and numpy would write beyond its arrays.
        if not len(counts) or counts.min() < 3 or counts.max() > len(indices) or counts.sum() != len(indices):
            return None
        if indices.min() < 0 or indices.max() >= len(points):
            return None
        return ("normals", "vertex", smooth_normals(points, counts, indices), None)


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
    length = np.linalg.norm(total, axis=1, keepdims=True)
    return (total / np.where(length > 0.0, length, 1.0)).astype(np.float32)
