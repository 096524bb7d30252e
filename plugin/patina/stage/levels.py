# SPDX-License-Identifier: Apache-2.0
"""Levels of detail, of the UsdLod of OpenUSD 26.08: which children of a prim with the LODRootAPI are drawn.

An override comes first, then the first heuristic for imaging, then `lod:default:index`. A value between two levels is rounded.
Each native instance has levels of its own. All instances of a point instancer have those of the one nearest to the camera.
"""
import math

import numpy as np
from pxr import Gf, Usd, UsdGeom

from . import cameras
from .context import Context, get, number
from .transforms import matrix_at

try:
    from pxr import UsdLod
except ImportError:  # an older OpenUSD
    UsdLod = None

_DOMAIN = "imaging"
_MOST_ROOTS = 512  # in one native prototype, with those nested in it; beyond them its instances share their levels
_ANY = Usd.PrimIsActive & Usd.PrimIsLoaded  # prototypes of point instancers may be overs and classes


def is_root(prim):
    return "LODRootAPI" in prim.GetAppliedSchemas()


def roots(stage, edit, options):
    """The roots that are in view and whose level heuristics or the default index choose, except those in other roots and in
    point instancers.

    :param edit: gets the warnings
    :returns: (path of the camera, dict of path of a root -> (names of its levels, index of the one that is drawn, its bounds
        in the frustum as from -1 to 1, None where it reaches behind the camera)); no roots where the stage has no camera"""
    context, found = Context(stage, edit, options), {}
    camera, chooses = cameras.chosen_before(context), Levels(context)
    if not camera:
        return None, found
    view = cameras.view_of(context)
    bounds = UsdGeom.BBoxCache(context.time, list(context.purposes))
    prims = iter(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))
    for prim in () if context.cyclic else prims:  # bounds of cycles have no end
        if not is_root(prim):
            if prim.IsA(UsdGeom.PointInstancer):
                prims.PruneChildren()
            continue
        prims.PruneChildren()
        names = [child.GetName() for child in prim.GetFilteredChildren(Usd.TraverseInstanceProxies())]
        shown = chooses.drawn(prim, matrix_at(context, prim, None, 0.0))
        if (len(names) > 1 and len(shown) == 1 and not (UsdLod and _overridden(prim, context.time))
                and view.Intersects(bounds.ComputeWorldBound(prim))):
            found[str(prim.GetPath())] = names, names.index(shown[0]), _on_screen(bounds.ComputeWorldBound(prim), view)
    return camera.path, found


def _on_screen(box, view):
    """:returns: least x, least y, largest x, largest y"""
    corners = np.array([(*box.GetBox().GetCorner(i), 1.0) for i in range(8)]) @ np.array(box.GetMatrix())
    corners = corners @ np.array(view.ComputeViewMatrix()) @ np.array(view.ComputeProjectionMatrix())
    if not (corners[:, 3] > 0.0).all():
        return None
    screen = corners[:, :2] / corners[:, 3:]
    return (*screen.min(0).tolist(), *screen.max(0).tolist())


def _overridden(root, time):
    return UsdLod.OverrideAPI(root).ComputeLODOverride(time)[0] in ("noLOD", "allLOD", "indexedLOD")


class Levels:
    """Chooses levels, from the camera of the picture."""

    def __init__(self, context):
        self.context = context
        self._view = None  # Gf.Frustum, once it is asked for
        self._below = {}  # path of a native prototype -> see _roots_below()
        self._told = set()  # paths of prims that were warned of

    def shown(self, prim, group):
        """:param prim: with the LODRootAPI
        :param group: that it is in
        :returns: names of the children that are drawn"""
        place = self.context.stage.GetPrimAtPath(group.path(prim)) if group.place is None else None
        if place:
            return self.drawn(place, matrix_at(self.context, place, None, 0.0))
        return self.drawn(prim, self.place_inside(prim, group) or matrix_at(self.context, prim, group.anchor, 0.0))

    def place_inside(self, prim, group):
        """:returns: matrix of a prim of a point instancer's prototype where its nearest instance is; None elsewhere"""
        return None if group.place is None else matrix_at(self.context, prim, group.anchor, 0.0) * group.place

    def signature(self, instance, group):
        """:param instance: native instance
        :returns: what two instances of one prototype have to have in common to be drawn alike"""
        if group.place is not None:
            return ()
        paths = self._roots_below(instance.GetPrototype())
        if is_root(instance):
            paths = (".", *paths)
        place = self.context.stage.GetPrimAtPath(group.path(instance)) if paths else None
        if not place:
            return ()
        roots = (place.GetPrimAtPath(path) if path != "." else place for path in paths)
        return tuple(self.drawn(root, matrix_at(self.context, root, None, 0.0)) for root in roots)

    def _roots_below(self, prototype):
        """:returns: paths of all prims with the LODRootAPI in a native prototype and in those of its instances"""
        path = prototype.GetPath()
        if path not in self._below:
            found = []
            for prim in Usd.PrimRange(prototype):
                if prim == prototype:
                    continue
                own = str(prim.GetPath().MakeRelativePath(path))
                if is_root(prim):
                    found.append(own)
                if prim.IsInstance():
                    found.extend(f"{own}/{below}" for below in self._roots_below(prim.GetPrototype()))
                if len(found) >= _MOST_ROOTS:
                    break
            self._below[path] = tuple(found[:_MOST_ROOTS])
        return self._below[path]

    def nearest_place(self, instancer, group, root):
        """:param root: of a prototype of a point instancer
        :returns: the matrix of its instance nearest to the camera, None where no level depends on it"""
        if not any(is_root(prim) or prim.IsInstance() and self._roots_below(prim.GetPrototype())
                   for prim in Usd.PrimRange(root, _ANY)):
            return None
        api, time = UsdGeom.PointInstancer(instancer), self.context.time
        targets = list(map(str, api.GetPrototypesRel().GetForwardedTargets()))
        own = targets.index(str(root.GetPath())) if str(root.GetPath()) in targets else None
        indices = np.array(api.GetProtoIndicesAttr().Get(time) or (), np.int64)
        matrices = api.ComputeInstanceTransformsAtTime(time, time, UsdGeom.PointInstancer.ExcludeProtoXform,
                                                       UsdGeom.PointInstancer.IgnoreMask)
        world = self.place_inside(instancer, group) or matrix_at(self.context, instancer, group.anchor, 0.0)
        matrices = np.array(matrices, np.float64).reshape(-1, 4, 4)[:len(indices)]
        if own is not None:
            matrices = matrices[indices[:len(matrices)] == own]
        if not len(matrices):
            return world
        away = (matrices[:, 3] @ np.array(world))[:, :3] - np.array(self._frustum().GetPosition())
        return Gf.Matrix4d(matrices[np.argmin((away * away).sum(axis=1))].tolist()) * world

    def drawn(self, root, matrix):
        """:returns: names of the children of a root that are drawn where the matrix puts it"""
        names = [child.GetName() for child in root.GetFilteredChildren(Usd.TraverseInstanceProxies())]
        if not names:
            return ()
        index = self._index(root, matrix)
        if index is None:
            return tuple(names)
        return () if index < 0 else (names[min(index, len(names) - 1)],)

    def _index(self, root, matrix):
        """:returns: of the child that is drawn; -1: none is; None: all are"""
        default = max(int(number(self.context, root, "lod:default:index", 0.0)), 0)
        default = self.context.options.levels.get(str(root.GetPath()), default)
        if UsdLod is None:
            self._tell(root, "", "levelsNeedNewer")
            return default
        mode, index = UsdLod.OverrideAPI(root).ComputeLODOverride(self.context.time)
        if mode in ("noLOD", "allLOD"):
            return -1 if mode == "noLOD" else None
        if mode != "indexedLOD":
            index = None if str(root.GetPath()) in self.context.options.levels else self._by_heuristic(root, matrix)
        return default if index is None or not math.isfinite(index) else max(math.floor(index + 0.5), 0)

    def _by_heuristic(self, root, matrix):
        """:returns: a level, None where no heuristic gives one"""
        for path in UsdLod.RootAPI(root).GetLodHeuristicsRel().GetForwardedTargets():
            prim = self.context.stage.GetPrimAtPath(path)
            if not prim or not prim.IsA(UsdLod.Heuristic):
                self._tell(root, "lod:heuristics", "levelUnchosen", path)
            elif get(prim, "lod:domain", self.context.time) == _DOMAIN:
                for type_, view in ((UsdLod.DistanceHeuristic, lambda: self._frustum().GetPosition()),
                                    (UsdLod.ScreenSizeHeuristic, self._frustum)):
                    if prim.IsA(type_):
                        return type_(prim).ComputeLOD(view(), matrix, self.context.time)
                self._tell(root, "lod:heuristics", "levelTypeUnknown", path, prim.GetTypeName())
        return None

    def _tell(self, root, name, id_, *fields):
        if root.GetPath() not in self._told:
            self._told.add(root.GetPath())
            self.context.warn(root.GetPath(), name, id_, *fields)

    def _frustum(self):
        if self._view is None:
            self.context.uses_camera = True
            self._view = cameras.view_of(self.context)
        return self._view
