# SPDX-License-Identifier: Apache-2.0
"""Meshes."""
import numpy as np

from .context import array, shown

_INTS = {
    "faceVertexCounts": "face_vertex_counts", "faceVertexIndices": "face_vertex_indices",
    "holeIndices": "hole_indices", "creaseIndices": "crease_indices", "creaseLengths": "crease_lengths",
    "cornerIndices": "corner_indices",
}
_FLOATS = {"creaseSharpnesses": "crease_sharpnesses", "cornerSharpnesses": "corner_sharpnesses"}
_TOKENS = {
    "subdivisionScheme": ("scheme", "catmullClark", ("none", "catmullClark", "loop", "bilinear")),
    "interpolateBoundary": ("interpolate_boundary", "edgeAndCorner", ("none", "edgeOnly", "edgeAndCorner")),
    "faceVaryingLinearInterpolation": (
        "face_varying_linear_interpolation", "cornersPlus1",
        ("none", "cornersOnly", "cornersPlus1", "cornersPlus2", "boundaries", "all")),
    "triangleSubdivisionRule": ("triangle_subdivision_rule", "catmullClark", ("catmullClark", "smooth")),
}


def emit(context, found, common, points):
    prim, time = found.prim, context.time
    fields = {}
    for name, key in _INTS.items():
        fields[key] = array(context, prim, name, found.authored(name, time), 1, np.int32)
    for name, key in _FLOATS.items():
        fields[key] = array(context, prim, name, found.authored(name, time), 1)
    for name, (key, fallback, allowed) in _TOKENS.items():
        value = found.authored(name, time)
        if value is None:
            value = fallback
        elif value not in allowed:
            context.warn(prim.GetPath(), name, "tokenUnknown", shown(value), fallback)
            value = fallback
        fields[key] = value
    context.edit.set_mesh(found.path, points=points, refine_level=context.options.refine_level, **fields, **common)
