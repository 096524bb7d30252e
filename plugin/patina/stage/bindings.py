# SPDX-License-Identifier: Apache-2.0
"""Which material each prim shows."""
from pxr import Usd, UsdGeom, UsdShade

from . import kinds
from .boundMaterials import BoundMaterials
from .collectionBindings import CollectionBindings, in_prototype
from .context import shown
from .primvars import read_primvars
from .state import Bound

# As UsdGeomSubset looks for them, and below instances as well.
_CHILDREN = Usd.TraverseInstanceProxies(
    Usd.PrimIsActive & Usd.PrimIsLoaded & Usd.PrimHasDefiningSpecifier & ~Usd.PrimIsAbstract)


class Bindings:
    """Resolves material bindings in bulk and collects the materials that are shown."""

    def __init__(self, context):
        self.context = context
        self.materials = {}  # path in the scene -> UsdShade.Material
        self._primvars = {}  # path in the scene -> what primvars_of() gave
        self._checked = set()  # paths of prims whose own bindings were looked at
        self._collections = CollectionBindings(context.stage)
        self._bound_materials = BoundMaterials(self._collections, context.warn)

    def compute(self, prims, groups):
        """:param groups: that each prim is in
        :returns: list of Bound, with what is bound outside of the groups"""
        if not prims:
            return []
        prims = [self._on_stage(prim, group) if group.divided else prim for prim, group in zip(prims, groups)]
        found = self._bound_materials.of(prims, self.context.options.material_purpose)
        return [self._bound(material, rel, group) for (material, rel), group in zip(found, groups)]

    def _on_stage(self, prim, group):
        return group.native[0] and self.context.stage.GetPrimAtPath(group.on_stage(prim)) or prim

    def _bound(self, material, rel, group):
        above = Bound() if group.divided else group.bound
        if not material:
            return above
        rules = UsdShade.MaterialBindingAPI.GetMaterialBindingStrength(rel) == UsdShade.Tokens.strongerThanDescendants
        purposed = len(rel.SplitName()) in (3, 5)  # material:binding:PURPOSE, material:binding:collection:PURPOSE:NAME
        if above.material and (above.purposed > purposed or above.rules and above.purposed == purposed):
            return above
        return Bound(self.name(material, group), rules, purposed)

    def keys_of(self, found, bound):
        """:param found: native instance, bound: to it
        :returns: (what two instances of one prototype have to have in common to be bound alike, the same of collections
            that divide it or None)"""
        material = in_prototype(self.materials[bound.material].GetPrim()) if bound.material else ""
        parts = self._collections.signature(self._on_stage(found.prim, found.state.group), found.names)
        return bound._replace(material=material), parts

    def name(self, material, group):
        """:returns: the path of a material in the scene"""
        path = str(material.GetPath())
        if group.source and (path == group.source or path.startswith(group.source + "/")):
            path = group.path(material.GetPrim())
        self.materials.setdefault(path, material)
        return path

    def primvars_of(self, path):
        """:returns: what the prims that show a material get where they have no primvar of that name, as in RenderMan"""
        if path not in self._primvars:
            prim = self.materials[path].GetPrim() if path in self.materials else None
            self._primvars[path] = read_primvars(self.context, prim, ()) if prim else []
        return self._primvars[path]

    def resolve(self, founds):
        """:returns: for each found prim (material path, [(subset prim, material path)])"""
        subsets = [self._subsets(found.prim) for found in founds]
        prims, groups = [], []
        for found, own in zip(founds, subsets):
            prims += [found.prim, *(s.GetPrim() for s in own)]
            groups += [found.state.group] * (1 + len(own))
        for prim in prims:
            self._check(prim)
        paths = iter([bound.material for bound in self.compute(prims, groups)])
        return [(next(paths), [(s, next(paths)) for s in own]) for own in subsets]

    def _check(self, prim):
        """Tells of bindings to what is no material, on a prim and those above it: pxr passes over them without a word."""
        while prim and not prim.IsPseudoRoot() and prim.GetPath() not in self._checked:
            self._checked.add(prim.GetPath())
            for name in ("material:binding", "material:binding:" + self.context.options.material_purpose):
                targets = prim.GetRelationship(name).GetTargets() if prim.HasRelationship(name) else []
                for target in targets:
                    if not target.IsPrimPath():
                        continue
                    material = prim.GetStage().GetPrimAtPath(target)
                    if not material or not material.IsA(UsdShade.Material):
                        problem = "is no material" if material else "does not exist"
                        self.context.warn(prim.GetPath(), name, "bindingLeftOut", target, problem)
            prim = prim.GetParent()

    def _subsets(self, prim):
        """:returns: list of UsdGeom.Subset of faces: other elements have no material in UsdShade"""
        found = []
        for child in prim.GetFilteredChildren(_CHILDREN):
            subset = UsdGeom.Subset(child) if "GeomSubset" in kinds.schemas_of(child) else None
            if not subset or subset.GetFamilyNameAttr().Get() != UsdShade.Tokens.materialBind:
                continue
            elements = subset.GetElementTypeAttr().Get()
            if elements == UsdGeom.Tokens.face:
                found.append(subset)
            else:
                self.context.warn(subset.GetPath(), "elementType", "subsetOfOthers", shown(elements))
        return found
