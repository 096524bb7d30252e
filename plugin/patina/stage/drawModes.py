# SPDX-License-Identifier: Apache-2.0
"""Model draw modes: models that stand as a box, an origin or cards."""
import _patina
import numpy as np
from pxr import Kind, Usd, UsdGeom

from . import cards, marks
from .context import get, vector
from .transforms import transform_of

# Of a box whose corner i has the high x, y, z where bits 4, 2, 1 of i are set; in the order that UsdImaging has them.
_EDGES = [(0, 4), (4, 6), (6, 2), (2, 0), (1, 5), (5, 7), (7, 3), (3, 1), (0, 1), (4, 5), (6, 7), (2, 3)]


def of(prim, inherited):
    """:returns: (draw mode that children inherit, whether this prim stands for its subtree)"""
    mode = get(prim, "model:drawMode", 0.0, "inherited")
    if mode == "inherited":
        mode = inherited
    if mode == "default":
        return mode, False
    component = Kind.Registry.IsA(Usd.ModelAPI(prim).GetKind(), Kind.Tokens.component)
    return mode, bool(component or get(prim, "model:applyDrawMode", 0.0, False))


def emit(context, found):
    """Draws a model's extents as lines or as cards, or the unit axes of its origin."""
    prim, mode = found.prim, found.state.draw_mode
    if context.cyclic:
        return
    low, high = _extent(context, prim)
    if low is None and mode != "origin":
        return
    color = vector(context, prim, "model:drawModeColor", (0.18, 0.18, 0.18))
    common = {"group": found.state.group.name, "transform": transform_of(context, prim, found.state.group.anchor),
              **marks.fields(found)}
    context.count("drawModes")
    if mode == "cards":
        cards.emit(context, found, low, high, common, color)
        return
    if mode == "origin":
        points = [p for axis in np.eye(3) for p in ((0.0, 0.0, 0.0), axis)]
    else:
        corners = [[(low, high)[i >> (2 - a) & 1][a] for a in range(3)] for i in range(8)]
        points = [corners[i] for edge in _EDGES for i in edge]
    width = _patina.STAND_IN_WIDTH * float(np.linalg.norm(np.ptp(points, axis=0)))
    context.edit.set_curves(
        found.path, basis="linear", points=np.array(points, dtype=np.float32),
        curve_vertex_counts=np.full(len(points) // 2, 2, np.int32),
        primvars=[("widths", "constant", np.array([width], np.float32)),
                  ("displayColor", "constant", np.array([color], np.float32))], **common)


def _extent(context, prim):
    """:returns: the lowest and the highest corner of a model's box; None, None where it is empty"""
    box = UsdGeom.BBoxCache(context.time, sorted(context.purposes), useExtentsHint=True)
    extent = box.ComputeUntransformedBound(prim).ComputeAlignedRange()
    return (None, None) if extent.IsEmpty() else (np.array(extent.GetMin()), np.array(extent.GetMax()))
