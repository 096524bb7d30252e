# SPDX-License-Identifier: Apache-2.0
"""Transforms of prims, moving or not."""
import numpy as np
from pxr import Gf, Tf, UsdGeom

from .errors import one_line
from .turns import turns_of_ops


def sample_times(context, prim, anchor):
    """:returns: times relative to the frame at which the way from a prim up to its anchor changes"""
    if not context.moving:
        return [0.0]
    samples, turns, moves, interval = set(), [], False, context.shutter_interval()
    while prim and prim != anchor and not prim.IsPseudoRoot():
        xformable = UsdGeom.Xformable(prim)
        if xformable:
            if xformable.TransformMightBeTimeVarying():
                moves = True
                samples.update(xformable.GetTimeSamplesInInterval(interval))
                turns += turns_of_ops(context, xformable)
            if xformable.GetResetXformStack():
                break
        prim = prim.GetParent()
    return context.motion_offsets(samples, turns) if moves else [0.0]


def matrix_at(context, prim, anchor, offset):
    cache = context.xform_cache(offset)
    try:
        if anchor is None:
            return cache.GetLocalToWorldTransform(prim)
        return cache.ComputeRelativeTransform(prim, anchor)[0]
    except Tf.ErrorException as error:
        context.warn(prim.GetPath(), "xformOpOrder", "parentTransformUsed", one_line(error)[:200])
    parent = prim.GetParent()
    if not parent or parent.IsPseudoRoot() or parent == anchor:
        return Gf.Matrix4d(1.0)
    return matrix_at(context, parent, anchor, offset)


def is_finite(matrices):
    """:returns: whether a renderer, whose numbers are of 32 bits, can take matrices; per matrix for an array of them"""
    with np.errstate(over="ignore"):
        return np.isfinite(matrices.astype(np.float32)).all(axis=(-2, -1))


def transform_of(context, prim, anchor, after=None):
    """The transform from a prim to its anchor (None: the world).

    :param after: a function of the offset that gives a matrix to apply first
    :returns: what `_patina` takes as transform"""
    times = sample_times(context, prim, anchor)
    matrices = [matrix_at(context, prim, anchor, t) for t in times]
    if after:
        matrices = [after(t) * m for t, m in zip(times, matrices)]
    return as_transform(context, prim, times, matrices)


def as_transform(context, prim, times, matrices):
    """:returns: what `_patina` takes as transform; the identity for what is not finite"""
    arrays = [np.array(m, dtype=np.float64) for m in matrices]
    if not all(is_finite(a) for a in arrays):
        context.warn(prim.GetPath(), "xformOpOrder", "ownTransformNotFinite")
        return np.eye(4)
    if all(np.array_equal(arrays[0], a) for a in arrays[1:]):
        return arrays[0]
    return (list(times), arrays)
