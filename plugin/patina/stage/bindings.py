# SPDX-License-Identifier: Apache-2.0
"""Which material each prim shows."""
from pxr import UsdGeom, UsdShade

from . import compat, kinds
from .context import shown
from .primvars import read_primvars


class Bindings:
    """Resolves material bindings in bulk and collects the materials that are shown."""

    def __init__(self, context):
        self.context = context
        self.materials = {}  # path in the scene -> UsdShade.Material
        self._primvars = {}  # path in the scene -> what primvars_of() gave
        self._checked = set()  # paths of prims whose own bindings were looked at

    def compute(self, prims):
        """:returns: list of (Material or None, whether it is stronger than bindings below)"""
        if not prims:
            return []
        stronger = UsdShade.Tokens.strongerThanDescendants
        return [(material if material else None,
                 bool(rel) and UsdShade.MaterialBindingAPI.GetMaterialBindingStrength(rel) == stronger)
                for material, rel in compat.bound_materials(prims, self.context.options.material_purpose)]

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
        prims = []
        for found, own in zip(founds, subsets):
            prims.append(found.prim)
            prims.extend(s.GetPrim() for s in own)
        bound = iter(self.compute(prims))
        resolved = []
        for prim in prims:
            self._check(prim)
        for found, own in zip(founds, subsets):
            path = self._show(next(bound), found.state.group)
            resolved.append((path, [(s, self._show(next(bound), found.state.group)) for s in own]))
        return resolved

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

    def _show(self, bound, group):
        material = bound[0]
        if group.material and (group.material_rules or material is None):
            return group.material
        return self.name(material, group) if material else ""

    def _subsets(self, prim):
        """:returns: list of UsdGeom.Subset of faces: other elements have no material in UsdShade"""
        if not any("GeomSubset" in kinds.schemas_of(child) for child in prim.GetAllChildren()):
            return []
        found = []
        for subset in UsdShade.MaterialBindingAPI(prim).GetMaterialBindSubsets():
            elements = subset.GetElementTypeAttr().Get()
            if elements != UsdGeom.Tokens.face:
                self.context.warn(subset.GetPath(), "elementType", "subsetOfOthers", shown(elements))
            elif subset.GetPrim().IsActive():
                found.append(subset)
        return found
