# SPDX-License-Identifier: Apache-2.0
"""How fast things turn. Renderers move matrices and points along chords between the times at which they are read."""
import numpy as np
from pxr import UsdGeom, UsdSkel

_OPS = {getattr(UsdGeom.XformOp, "TypeRotate" + axes) for axes in ("X", "Y", "Z", "XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX")}


def rate_of_ops(context, xformable):
    """:returns: a bound of the radians per time code; matrices are interpolated element by element, and turn nothing"""
    total = 0.0
    for op in xformable.GetOrderedXformOps():
        orients = op.GetOpType() == UsdGeom.XformOp.TypeOrient
        if (orients or op.GetOpType() in _OPS) and op.MightBeTimeVarying():
            total += _rate(context, op.GetTimeSamplesInInterval(context.shutter_interval()), op.Get,
                           _between_quaternions if orients else _between_degrees)
    return total


def rate_of_instances(context, instancer):
    """:returns: the most radians per time code that orientations or angular velocities of a UsdGeomPointInstancer turn by"""
    rate = 0.0
    for name in ("orientations", "orientationsf"):
        attribute = instancer.GetPrim().GetAttribute(name)
        if attribute and attribute.ValueMightBeTimeVarying():
            samples = attribute.GetTimeSamplesInInterval(context.shutter_interval())
            rate = max(rate, _rate(context, samples, attribute.Get, _between_quaternions))
    velocities = instancer.GetAngularVelocitiesAttr().Get(context.time)
    if velocities:
        most = np.nan_to_num(np.linalg.norm(np.asarray(velocities, dtype=np.float64), axis=-1)).max()
        rate = max(rate, np.radians(most) / context.time_codes_per_second)
    return rate


def rate_of_joints(context, animation):
    """:param animation: a UsdSkelAnimQuery
    :returns: a bound of the radians per time code that any joint turns by: it turns with those above it"""
    if not animation.JointTransformsMightBeTimeVarying():
        return 0.0
    parents = UsdSkel.Topology(animation.GetJointOrder()).GetParentIndices()

    def turn(before, after):
        angles = _quaternion_angles(before, after)
        for joint, parent in enumerate(parents[:len(angles)]):
            angles[joint] += angles[parent] if 0 <= parent < joint else 0.0
        return angles.max(initial=0.0)

    return _rate(context, animation.GetJointTransformTimeSamplesInInterval(context.shutter_interval()),
                 lambda time: animation.ComputeJointLocalTransformComponents(time)[1], turn)


def _rate(context, samples, value_at, turn):
    """:param samples: authored time codes inside the shutter
    :param turn: gives the angle between two values in radians
    :returns: the most radians per time code between two times"""
    offsets = context.shutter_offsets(samples)
    values = [value_at(context.time_at(offset)) for offset in offsets]
    return max((turn(a, b) / (t - s) for s, t, a, b in zip(offsets, offsets[1:], values, values[1:])
                if a is not None and b is not None), default=0.0)


def _between_degrees(before, after):
    return np.radians(np.abs(np.subtract(after, before, dtype=np.float64)).sum())


def _between_quaternions(before, after):
    return _quaternion_angles(before, after).max(initial=0.0)


def _quaternion_angles(before, after):
    """:returns: the angles of the ways that slerp takes between quaternions, or between arrays of as many; else none"""
    before, after = (np.asarray([[q.real, *q.imaginary]] if hasattr(q, "real") else q, dtype=np.float64)
                     for q in (before, after))
    if before.shape != after.shape or before.ndim != 2:
        return np.zeros(0)
    lengths = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    cosines = np.abs(np.sum(before * after, axis=1)) / np.where(lengths > 0.0, lengths, 1.0)
    return 2.0 * np.arccos(np.minimum(np.nan_to_num(cosines, nan=1.0), 1.0))
