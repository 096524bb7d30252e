# SPDX-License-Identifier: Apache-2.0
"""How fast things turn. Renderers move matrices and points along chords between the times at which they are read."""
import numpy as np
from pxr import UsdGeom, UsdSkel

_OPS = {getattr(UsdGeom.XformOp, "TypeRotate" + axes) for axes in ("X", "Y", "Z", "XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX")}


def turns_of_ops(context, xformable):
    """:returns: list of functions of two times relative to the frame: a bound of the radians between them. Matrices are
        interpolated element by element, and turn nothing"""
    found = []
    for op in xformable.GetOrderedXformOps():
        orients = op.GetOpType() == UsdGeom.XformOp.TypeOrient
        if (orients or op.GetOpType() in _OPS) and op.MightBeTimeVarying():
            found.append(_turn(context, op.Get, _between_quaternions if orients else _between_degrees))
    return found


def turns_of_orientations(context, instancer):
    """:returns: the same of the instances of a UsdGeomPointInstancer"""
    attributes = [instancer.GetPrim().GetAttribute(name) for name in ("orientations", "orientationsf")]
    return [_turn(context, a.Get, _between_quaternions) for a in attributes if a and a.ValueMightBeTimeVarying()]


def rate_of_velocities(context, instancer):
    """:returns: the most radians per time code that angular velocities of a UsdGeomPointInstancer turn by"""
    velocities = instancer.GetAngularVelocitiesAttr().Get(context.time)
    if not velocities:
        return 0.0
    most = np.nan_to_num(np.linalg.norm(np.asarray(velocities, dtype=np.float64), axis=-1)).max()
    return np.radians(most) / context.time_codes_per_second


def turns_of_joints(context, animation):
    """:param animation: a UsdSkelAnimQuery
    :returns: as turns_of_ops(), of all joints: each turns with those above it"""
    if not animation.JointTransformsMightBeTimeVarying():
        return []
    order = animation.GetJointOrder()
    parents = UsdSkel.Topology(order).GetParentIndices()
    from_above = sorted(range(len(order)), key=lambda joint: order[joint].count("/"))  # animations need not be in this order

    def most(before, after):
        angles = _quaternion_angles(before, after)
        if len(angles) != len(order):
            return 0.0  # pxr takes the rest pose
        for joint in from_above:
            angles[joint] += angles[parents[joint]] if parents[joint] >= 0 else 0.0
        return angles.max(initial=0.0)

    return [_turn(context, lambda time: animation.ComputeJointLocalTransformComponents(time)[1], most)]


def _turn(context, value_at, angle):
    """:param angle: gives the radians between two values"""
    def turn(*times):
        values = [value_at(context.time_at(time)) for time in times]
        return 0.0 if any(value is None for value in values) else angle(*values)
    return turn


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
