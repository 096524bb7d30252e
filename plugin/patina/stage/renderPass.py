# SPDX-License-Identifier: Apache-2.0
"""A UsdRenderPass: what of the stage is drawn, what the camera sees of it, and what is a matte, by its four collections."""
from pxr import Sdf, Usd

from .collectionBindings import Members, included, within
from .errors import StageError

_COLLECTIONS = {"renderVisibility": True, "prune": False, "cameraVisibility": True, "matte": False}  # what none of them means


class RenderPass:
    """The collections of a pass."""

    def __init__(self, stage, path):
        """:raises StageError: where there is no such pass"""
        prim = stage.GetPrimAtPath(path) if Sdf.Path.IsValidPathString(str(path)) else None
        if not prim or prim.GetTypeName() != "RenderPass":
            raise StageError(f"{path} is no UsdRenderPass prim")
        members = {name: Members(stage, Sdf.Path(f"{path}.collection:{name}")) for name in _COLLECTIONS
                   if prim.HasAPI(Usd.CollectionAPI, name)}
        self._stage = stage
        self._queries = {name: of.query for name, of in members.items()}
        self._rules = sorted({str(rule) for of in members.values() for rule in of.rules})
        self._patterns = [of.query for of in members.values() if of.by_pattern]

    def _has(self, name, path):
        query = self._queries.get(name)
        return query.IsPathIncluded(path) if query else _COLLECTIONS[name]

    def state_of(self, path, state):
        """:param path: of a prim in the scene, which is that of an instance proxy inside of a native instance
        :returns: the prim's state in this pass, None where it is not drawn"""
        path = Sdf.Path(path)
        if not self._has("renderVisibility", path) or self._has("prune", path):
            return None
        marks = dict(state.marks)
        if not self._has("cameraVisibility", path):
            marks["patina:visibility:camera"] = 0.0
        if self._has("matte", path):
            marks["patina:matte"] = 1.0
        return state if marks == state.marks else state.with_(marks=marks)

    def signature(self, path, apart):
        """:param path: of a native instance
        :param apart: whether it draws prims that lie elsewhere on the stage
        :returns: what two instances of one prototype have to have in common to be drawn alike"""
        path = Sdf.Path(path)
        unknown = self._patterns and (apart or not self._stage.GetPrimAtPath(path))
        if unknown or within(self._rules, path):
            return str(path)
        held = tuple(self._has(name, path.AppendChild("any")) for name in _COLLECTIONS)
        return held, included(self._stage, path, self._patterns)
