# SPDX-License-Identifier: Apache-2.0
"""NURBS patches and curves, Hermite curves, meshes of tetrahedra."""
import numpy as np

from .context import array, array_of, finite, get, sampled
from .primvars import text

_DIRECTION = {"VertexCount": "vertex_count", "Order": "order"}
_TRIM = {"counts": (1, np.int32), "orders": (1, np.int32), "vertexCounts": (1, np.int32), "knots": (1, np.float64),
         "ranges": (2, np.float64), "points": (3, np.float64)}


def emit_patch(context, found, common, points):
    """UsdGeomNurbsPatch."""
    prim, time = found.prim, context.time
    fields = {}
    for side in "uv":
        for name, key in _DIRECTION.items():
            fields[f"{side}_{key}"] = _integer(context, prim, side + name)
        fields[f"{side}_knots"] = _doubles(context, prim, f"{side}Knots")
        fields[f"{side}_range"] = _range(context, prim, f"{side}Range")
    if get(prim, "trimCurve:counts", time):
        for name, (components, kind) in _TRIM.items():
            fields["trim_" + name.replace("Counts", "_counts")] = array_of(
                context, prim, f"trimCurve:{name}", components, kind).ravel()
        sense = text(context, prim, found.state.primvars, "ri:attributes:trimcurve:sense")
        fields["trim_keep_inside"] = sense == "outside"
    context.edit.set_nurbs_patch(found.path, points=points, weights=_doubles(context, prim, "pointWeights"),
                                 refine_level=context.options.refine_level, **fields, **common)


def emit_tets(context, found, common, points):
    """UsdGeomTetMesh: its surface."""
    prim = found.prim
    tets = array_of(context, prim, "tetVertexIndices", 4, np.int32)
    surface = array_of(context, prim, "surfaceFaceVertexIndices", 3, np.int32)
    if not len(tets) and not len(surface):
        context.warn(prim.GetPath(), "tetVertexIndices", "noTetrahedra")
        return
    context.edit.set_tet_mesh(found.path, points=points, tets=tets.ravel(), surface=surface.ravel(), **common)


def emit_hermite(context, found, common, points):
    """UsdGeomHermiteCurves; tangents are read when points are."""
    prim = found.prim
    tangents = prim.GetAttribute("tangents")
    times = points[0] if isinstance(points, tuple) else [0.0]
    samples = [array(context, prim, "tangents", tangents.Get(context.time_at(t)) if tangents else None, 3)
               for t in times]
    context.edit.set_hermite_curves(
        found.path, points=points, tangents=sampled(times, samples), curve_vertex_counts=_counts(context, prim), **common)


def emit_nurbs_curves(context, found, common, points):
    """UsdGeomNurbsCurves."""
    prim = found.prim
    context.edit.set_nurbs_curves(
        found.path, points=points, curve_vertex_counts=_counts(context, prim),
        orders=array_of(context, prim, "order", 1, np.int32), knots=_doubles(context, prim, "knots"),
        ranges=array_of(context, prim, "ranges", 2, np.float64).ravel(), weights=_doubles(context, prim, "pointWeights"),
        **common)


def _counts(context, prim):
    return array_of(context, prim, "curveVertexCounts", 1, np.int32)


def _doubles(context, prim, name):
    return array_of(context, prim, name, 1, np.float64)


def _integer(context, prim, name):
    value = get(prim, name, context.time)
    return value if isinstance(value, int) and abs(value) < 2 ** 31 else 0  # 0 is told of where it is used


def _range(context, prim, name):
    """:returns: the ends of what is drawn; None, after a warning where something is authored, for all that knots span"""
    value = get(prim, name, context.time)
    found = finite(value, 2)
    if found and found[0] < found[1]:
        return np.array(found)
    if value is not None:
        context.warn(prim.GetPath(), name, "knotRangeUnusable")
    return None
