# SPDX-License-Identifier: Apache-2.0
"""Coordinate systems that are bound to prims and those below them (UsdShadeCoordSysAPI, of several names or as it was before
OpenUSD 23.05), as primvars of their matrices."""
import _patina
import numpy as np
from pxr import UsdGeom

from .transforms import is_finite, matrix_at

_PREFIX, _SUFFIX = "coordSys:", ":binding"


def authored(prim, names, above):
    """:param names: of the prim's authored properties
    :param above: what is bound above it, (name, path of the target) each
    :returns: the same of the prim"""
    own = {}
    for property_ in names:
        if property_.startswith(_PREFIX) and prim.HasRelationship(property_):
            targets = prim.GetRelationship(property_).GetForwardedTargets()
            own[property_[len(_PREFIX):].removesuffix(_SUFFIX)] = targets[0] if targets else None
    return tuple(sorted((name, path) for name, path in {**dict(above), **own}.items() if path)) if own else above


def primvars_of(context, found):
    """:returns: primvars of the matrices into the spaces that are bound to a prim, as of read_primvars()"""
    primvars = []
    for name, path in found.state.spaces:
        matrix, local = _matrix(context, found, context.stage.GetPrimAtPath(path))
        if matrix is None:
            context.warn(found.prim.GetPath(), _PREFIX + name, "coordSysUnusable", path)
            continue
        rows = np.array(matrix, dtype=np.float32)
        rows[:, 3] = 0, 0, 0, local
        primvars += [(_patina.space_primvar(name, i), "constant", rows[i:i + 1], None) for i in range(4)]
    return primvars


def _matrix(context, found, target):
    """:returns: (matrix into the space of a prim or None, whether it is from the object, not from the world); a space inside
        of the prim's own prototype moves with each instance"""
    if not target or not UsdGeom.Xformable(target):
        return None, False
    group = found.state.group
    inside = bool(group.name) and target.GetPath().HasPrefix(group.source)
    space = matrix_at(context, target, group.anchor if inside else None, 0.0)
    if not space.GetDeterminant() or not is_finite(np.array(space.GetInverse())):
        return None, False
    own = matrix_at(context, found.prim, group.anchor, 0.0) if inside else 1.0
    return own * space.GetInverse(), inside
