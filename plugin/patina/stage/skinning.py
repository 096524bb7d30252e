# SPDX-License-Identifier: Apache-2.0
"""UsdSkel: skinned points by pxr's own queries, blend shapes first."""
import functools
from collections import defaultdict

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdSkel, Vt

from .context import array, merged
from .transforms import as_transform, matrix_at, sample_times
from .turns import turns_of_joints


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


def is_bound(prim):
    """:returns: whether what lies below a prim inherits a skeleton or an animation from it or from prims above"""
    binding = UsdSkel.BindingAPI(prim)
    return bool(binding.GetInheritedAnimationSource() or binding.GetInheritedSkeleton())


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
        interval, target = context.shutter_interval(), self.target
        inputs = [target.GetGeomBindTransformAttr(), target.GetJointIndicesPrimvar().GetAttr(),
                  target.GetJointWeightsPrimvar().GetAttr()]
        if self.deforms:
            inputs.append(UsdGeom.PointBased(target.GetPrim()).GetPointsAttr())
        samples = {time for attribute in inputs if attribute for time in attribute.GetTimeSamplesInInterval(interval)}
        animation, turns = self.query.GetAnimQuery(), []
        if animation:
            turns = turns_of_joints(context, animation) if self.has_joints else []
            samples.update(animation.GetJointTransformTimeSamplesInInterval(interval))
            if target.HasBlendShapes() and animation.BlendShapeWeightsMightBeTimeVarying():
                samples.update(self._bends(animation, interval))
        return context.motion_offsets(samples, turns)

    def _bends(self, animation, interval):
        """:returns: time codes in an interval at which points take another direction: samples of the weights of blend shapes,
            and where weights pass those of in-betweens"""
        times = sorted({interval.min, interval.max, *animation.GetBlendShapeWeightTimeSamplesInInterval(interval)})
        passed = defaultdict(list)
        for number in range(self.shapes.GetNumSubShapes()):
            between = self.shapes.GetInbetween(number)
            if between:
                passed[self.shapes.GetBlendShapeIndex(number)].append(between.GetWeight())
        weights = [self._weights(time) for time in times] if passed else []
        if not all(own and len(own) == self.shapes.GetNumBlendShapes() for own in weights):
            return times
        bends = list(times)
        for shape, ends in passed.items():
            for bend in sorted((0.0, 1.0, *ends))[1:-1]:  # what lies beyond goes on straight
                away = [own[shape] - bend for own in weights]
                bends += [start + (end - start) * before / (before - after) for start, end, before, after
                          in zip(times, times[1:], away, away[1:]) if before * after < 0.0]
        return bends

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
            points = self.blend(context, points, offset)
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

    def acting_shapes(self, time):
        """:returns: (BlendShapeQuery, its sub-shapes that have weights, as it gives them); None where none has"""
        weights = self._weights(time)
        parts = self.shapes.ComputeSubShapeWeights(weights) if weights else None
        return (self.shapes, parts) if parts and parts[0] else None

    @functools.cached_property
    def shapes(self):
        return UsdSkel.BlendShapeQuery(UsdSkel.BindingAPI(self.target.GetPrim()))

    def _weights(self, time):
        """:returns: those of the prim's own blend shapes; None where the animation has none"""
        animation = self.query.GetAnimQuery()
        weights = animation.ComputeBlendShapeWeights(time) if animation else None
        return self.target.GetBlendShapeMapper().Remap(weights) if weights else None

    def blend(self, context, points, offset=0.0):
        """:returns: points that blend shapes moved, or these where pxr cannot compute them"""
        acting = self.acting_shapes(context.time_at(offset))
        if not acting:
            return points
        shapes, parts = acting
        moved = Vt.Vec3fArray(points)  # pxr changes it in place
        if not shapes.ComputeDeformedPoints(*parts, shapes.ComputeBlendShapePointIndices(),
                                            shapes.ComputeSubShapePointOffsets(), moved):
            context.warn(self.target.GetPrim().GetPath(), "skel:blendShapes", "blendShapesLeftOut")
            return points
        return moved
