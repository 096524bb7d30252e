# SPDX-License-Identifier: Apache-2.0
"""Bones of skeletons, as UsdSkelImaging shows them: guides, unless a purpose is authored."""
import numpy as np
from pxr import UsdGeom, UsdSkel

from .context import sampled
from .turns import turns_of_joints

_FACES = np.array([0, 2, 1, 0, 3, 2, 0, 4, 3, 0, 1, 4], np.int32)  # of a pyramid with its tip first
_THICKNESS = 0.1  # of a bone's length: half its base
_ACROSS = ((1, 2), (0, 2), (0, 1))  # axes of the parent that span the base, by the one along the bone


def purpose_of(prim, inherited):
    """:param inherited: purpose that the prim has as any other"""
    if inherited != "default" or UsdGeom.Imageable(prim).ComputePurposeInfo().isInheritable:
        return inherited
    return "guide"


def emit(context, found, common):
    """A mesh of one pyramid for each joint that has a parent, in the skeleton's pose."""
    skeleton = UsdSkel.Skeleton(found.prim)
    if not skeleton.GetJointsAttr().Get():
        return
    query = UsdSkel.Cache().GetSkelQuery(skeleton)
    bind = query.GetJointWorldBindTransforms() if query else []
    parents = [query.GetTopology().GetParent(joint) for joint in range(len(bind))] if query else []
    bones = [(joint, parent) for joint, parent in enumerate(parents) if parent >= 0]
    times = _times(context, query) if query and context.moving else [0.0]
    poses = [query.ComputeSkinningTransforms(context.time_at(t)) if query else None for t in times]
    if not bind or not all(poses):
        context.warn(found.prim.GetPath(), "joints", "primUnreadable", "bind or rest transforms do not fit them")
        return
    if not bones:
        return
    bind = np.array(bind)
    corners = np.concatenate([_pyramid(bind[joint], bind[parent]) for joint, parent in bones])
    joints = np.array([(joint, *[parent] * 4) for joint, parent in bones]).ravel()
    samples = []
    for pose in poses:
        moved = np.einsum("pi,pij->pj", np.c_[corners, np.ones(len(corners))], np.array(pose, np.float64)[joints])
        samples.append(moved[:, :3].astype(np.float32))
    if not found.state.group.name:
        context.skinned.append((found.prim, samples[0]))
    common["double_sided"] = True
    context.edit.set_mesh(
        found.path, points=sampled(times, samples), scheme="none",
        face_vertex_counts=np.full(4 * len(bones), 3, np.int32),
        face_vertex_indices=(_FACES + 5 * np.arange(len(bones), dtype=np.int32)[:, None]).ravel(), **common)


def _times(context, query):
    animation = query.GetAnimQuery()
    if not animation:
        return [0.0]
    samples = animation.GetJointTransformTimeSamplesInInterval(context.shutter_interval())
    return context.motion_offsets(samples, turns_of_joints(context, animation))


def _pyramid(joint, parent):
    """:param joint, parent: matrices of row vectors
    :returns: five points: the tip at the joint, and the base at its parent, across the parent's axes that the bone follows
        least"""
    tip, base = joint[3, :3], parent[3, :3]
    length = np.linalg.norm(tip - base)
    along = (tip - base) / length if length > 0.0 else np.zeros(3)
    axis = next((k for k in range(2) if abs(parent[k, :3] @ along) > np.pi / 4), 2)
    right, up = (_THICKNESS * length * parent[k, :3] / max(np.linalg.norm(parent[k, :3]), 1e-10) for k in _ACROSS[axis])
    return np.array([tip, base + right + up, base + right - up, base - right - up, base - right + up])
