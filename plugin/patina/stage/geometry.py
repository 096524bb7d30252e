# SPDX-License-Identifier: Apache-2.0
"""Gprims: meshes, curves, points, implicit shapes, volumes and particles."""
import numpy as np
from pxr import UsdGeom

from . import coordSystems, kinds, marks, meshes, parametric, skeletons, skinning, splats, volumes
from .context import array, array_of, get, number, sampled, shown
from .primvars import add_builtin, read_primvars, text
from .skinnedNormals import skin_normals
from .transforms import transform_of

_AXES = {"X": 0, "Y": 1, "Z": 2}
_SIZES = {  # kind -> attributes that are sizes, with the schemas' fallbacks
    "sphere": {"radius": 1.0}, "cube": {"size": 2.0}, "cone": {"height": 2.0, "radius": 1.0},
    "cylinder": {"height": 2.0, "radius": 1.0}, "capsule": {"height": 1.0, "radius": 0.5},
    "plane": {"width": 2.0, "length": 2.0},
}


def emit(context, found, kind, bound, categories, fallbacks):
    """:param bound: what Bindings.resolve() tells of the prim
    :param fallbacks: primvars that it has unless others of their names are authored"""
    prim, group = found.prim, found.state.group
    material, subsets = bound
    skin = skinning.skin_of(found)
    common = {
        "group": group.name,
        "transform": skin.transform(context, group.anchor) if skin else transform_of(context, prim, group.anchor),
        "material": material,
        "categories": categories,
        **marks.fields(found),
        "double_sided": bool(found.authored("doubleSided", context.time)),
        "left_handed": found.authored("orientation", context.time) == "leftHanded",
        "primvars": read_primvars(context, prim, found.state.primvars) if found.has_primvars() else [],
    }
    if fallbacks:
        own = {item[0] for item in common["primvars"]}
        common["primvars"] += [item for item in fallbacks if item[0] not in own and item[1] == "constant"]
    if found.state.spaces:
        common["primvars"] += coordSystems.primvars_of(context, found)
    if "primvars:lightGroup" in found.names or found.state.primvars:
        common["light_group"] = text(context, prim, found.state.primvars, "lightGroup")
    if subsets:
        common["subsets"] = [_subset(context, subset, path, group) for subset, path in subsets]
    context.count(kind)
    if kind in _SIZES:
        _implicit(context, found, kind, common)
    elif kind in _POINT_BASED:
        _add_builtins(context, found, kind, skin, common["primvars"])
        _POINT_BASED[kind](context, found, common, points_of(context, prim, skin))
    else:
        {"skeleton": skeletons, "splats": splats, "volume": volumes}[kind].emit(context, found, common)


def _subset(context, subset, material, group):
    indices = subset.GetIndicesAttr().Get(context.time)
    return (group.path(subset.GetPrim()), material, array(context, subset.GetPrim(), "indices", indices, 1, np.int32))


def points_of(context, prim, skin=None):
    """:returns: what `_patina` takes as points: authored samples, velocities or skinning inside the
    shutter"""
    based = UsdGeom.PointBased(prim)
    attribute = based.GetPointsAttr()
    if skin and skin.deforms:
        offsets = skin.offsets(context) if context.moving else [0.0]
        return _sampled(context, prim, offsets, [skin.points(context, t) for t in offsets])
    offsets = context.attribute_offsets(attribute)
    velocities = based.GetVelocitiesAttr() if not context.time.IsDefault() else None
    if velocities and velocities.HasAuthoredValue():
        bent = (based.GetAccelerationsAttr(),)
        offsets = context.velocity_offsets(prim, bent) if context.moving else [0.0]
        values = based.ComputePointsAtTimes([context.time_at(t) for t in offsets], context.time)
        if len(values) == len(offsets):
            return _sampled(context, prim, offsets, values)
        offsets = [0.0]
    return _sampled(context, prim, offsets, [attribute.Get(context.time_at(t)) for t in offsets])


def _sampled(context, prim, offsets, values):
    return sampled(offsets, [array(context, prim, "points", v, 3) for v in values])


def _add_builtins(context, found, kind, skin, primvars):
    prim = found.prim
    if kind == "nurbsPatch":  # has neither
        return
    if kind in _WIDE:
        add_builtin(context, prim, "widths", _WIDE[kind](prim).GetWidthsInterpolation(), primvars)
    if "normals" in found.names:
        add_builtin(context, prim, "normals", UsdGeom.PointBased(prim).GetNormalsInterpolation(), primvars)
    if skin and skin.deforms:
        skin_normals(context, found, skin, primvars)


def _points(context, found, common, points):
    context.edit.set_points(found.path, points=points, **common)


def _curves(context, found, common, points):
    prim = found.prim
    linear = get(prim, "type", context.time, "cubic") == "linear"
    basis = "linear" if linear else get(prim, "basis", context.time, "bezier")
    wrap = get(prim, "wrap", context.time, "nonperiodic")
    if basis not in ("linear", "bezier", "bspline", "catmullRom"):
        context.warn(prim.GetPath(), "basis", "basisUnknown", shown(basis))
        basis = "bezier"
    if wrap not in ("nonperiodic", "periodic", "pinned"):
        context.warn(prim.GetPath(), "wrap", "wrapUnknown", shown(wrap))
        wrap = "nonperiodic"
    counts = array_of(context, prim, "curveVertexCounts", 1, np.int32)
    context.edit.set_curves(found.path, points=points, basis=basis, wrap=wrap, curve_vertex_counts=counts, **common)


def _implicit(context, found, kind, common):
    prim, time = found.prim, context.time
    sizes = dict(_SIZES[kind])
    for name in sizes:
        value = found.authored(name, time) if prim.GetTypeName() in kinds.GPRIMS else get(prim, name, time)
        if value is not None:
            sizes[name] = number(context, prim, name, sizes[name], value)
    if kinds.schema_among(prim, ("Cylinder_1", "Capsule_1")):
        radius = sizes["radius"]
        sizes["radius"] = number(context, prim, "radiusBottom", radius)
        sizes["radius_top"] = number(context, prim, "radiusTop", radius)
    axis = found.authored("axis", time)
    axis = _AXES.get(axis if isinstance(axis, str) else "Z", 2)
    context.edit.set_implicit(found.path, shape=kind, axis=axis, **sizes, **common)


_POINT_BASED = {"mesh": meshes.emit, "curves": _curves, "points": _points, "nurbsPatch": parametric.emit_patch,
                "tetMesh": parametric.emit_tets, "nurbsCurves": parametric.emit_nurbs_curves,
                "hermiteCurves": parametric.emit_hermite}
_WIDE = {"points": UsdGeom.Points, **dict.fromkeys(("curves", "nurbsCurves", "hermiteCurves"), UsdGeom.Curves)}  # with widths
