# SPDX-License-Identifier: Apache-2.0
"""Portals that domes name: rectangles that guide their samples."""
from pxr import Usd

from . import kinds
from .context import number, targets
from .transforms import transform_of


def of(context, dome, group):
    """:returns: what set_light() takes as `portals`"""
    portals = []
    for path in targets(dome, "portals"):
        prim = context.stage.GetPrimAtPath(path)
        if not prim or "PortalLight" not in kinds.schemas_of(prim):
            context.warn(dome.GetPath(), "portals", "noPortalLight", path)
            continue
        portal = {"path": str(path), "transform": transform_of(context, prim, group.anchor)}
        for name in ("width", "height"):
            portal[name] = number(context, prim, "inputs:" + name, 1.0)
        portals.append(portal)
    return portals


def is_used(context, prim):
    """:returns: whether a dome of the stage names this portal"""
    if "PortalLight" not in kinds.schemas_of(prim):
        return False
    if context.portals is None:
        roots = (context.stage.GetPseudoRoot(), *context.stage.GetPrototypes())
        context.portals = {path for root in roots for prim in Usd.PrimRange(root) for path in targets(prim, "portals")}
    return prim.GetPath() in context.portals
