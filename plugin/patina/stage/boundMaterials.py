# SPDX-License-Identifier: Apache-2.0
"""Which material is bound to each of many prims: pxr's answer, and the same for prims below a binding that it raises at."""
from pxr import Tf, UsdShade

_Api = UsdShade.MaterialBindingAPI
_ALL, _STRONGER = UsdShade.Tokens.allPurpose, UsdShade.Tokens.strongerThanDescendants


class BoundMaterials:
    """Asks pxr for all prims at once, and one by one where it raises, which it does where a binding names a property that is
    no collection: in C++ that binding counts for nothing, and the others hold."""

    def __init__(self, collections, warn):
        """:param collections: CollectionBindings, warn: see Context.warn"""
        self._collections, self._warn = collections, warn
        self._told = set()  # bindings

    def of(self, prims, purpose):
        """:returns: list of (Material, relationship that binds it) for a purpose, then the general one"""
        purpose = purpose or _ALL
        try:
            return _asked(prims, purpose)
        except Tf.ErrorException:
            return [self._alone(prim, purpose) for prim in prims]

    def _alone(self, prim, purpose):
        try:
            return _asked([prim], purpose)[0]
        except Tf.ErrorException:
            return self._nearest(prim, purpose) or self._nearest(prim, _ALL) or (UsdShade.Material(), None)

    def _nearest(self, prim, purpose):
        """:returns: what is bound for one purpose, by UsdShade's rules of strength, be it no material; None for no binding"""
        found, path = None, prim.GetPath()
        while not prim.IsPseudoRoot():
            below = found
            direct = _Api(prim).GetDirectBindingRel(purpose)
            if direct and (not below or _is_stronger(direct)):
                found = _Api.DirectBinding(direct).GetMaterial(), direct
            open_ = found is not below or not below  # collections stand above what the same prim binds by itself
            found = next((own for own in self._collected(prim, path, purpose) if open_ or _is_stronger(own[1])), found)
            prim = prim.GetParent()
        return found

    def _collected(self, prim, path, purpose):
        """:returns: list of what is bound to a path by those collections of a prim that hold it"""
        found = []
        for rel in _Api(prim).GetCollectionBindingRels(purpose):
            binding = _Api.CollectionBinding(rel)
            collection = binding.GetCollectionPath()
            query = self._collections.members_of(collection).query
            if query is None and rel.GetPath() not in self._told:
                self._told.add(rel.GetPath())
                self._warn(prim.GetPath(), rel.GetName(), "bindingLeftOut", collection, "is no collection")
            if query and query.IsPathIncluded(path):
                found.append((binding.GetMaterial(), rel))
        return found


def _is_stronger(rel):
    return _Api.GetMaterialBindingStrength(rel) == _STRONGER


def _asked(prims, purpose):
    return list(zip(*_Api.ComputeBoundMaterials(prims, purpose)))
