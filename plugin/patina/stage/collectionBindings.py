# SPDX-License-Identifier: Apache-2.0
"""Collections that bind materials to some of the prims in native instances: what is bound there is a matter of paths on the
stage, which a prototype has not."""
from bisect import bisect_left

from pxr import Sdf, Usd, UsdShade

_EXPLICIT, _EXCLUDE = Usd.Tokens.explicitOnly, Usd.Tokens.exclude
_Api = UsdShade.MaterialBindingAPI


def in_prototype(prim):
    """:returns: path of the prim that stands for this one in all instances that share it"""
    return str((prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim).GetPath())


class Members:
    """Which prims a collection holds."""

    def __init__(self, stage, path):
        """:param path: of the collection; one that is not there holds nothing"""
        owner = stage.GetPrimAtPath(path.GetPrimPath())
        collection = Usd.CollectionAPI.Get(stage, path) if owner else None
        self.query = collection.ComputeMembershipQuery() if collection else None
        self.rules = self.query.GetAsPathExpansionRuleMap() if self.query else {}
        expression = getattr(collection, "GetMembershipExpressionAttr", None)  # of OpenUSD 23.11 and later
        self.by_pattern = not self.rules and expression is not None and expression().HasAuthoredValue()
        self._paths = sorted(map(str, self.rules))

    def signature(self, path):
        """:returns: what says which prims below a path it holds, the same for paths where that is alike; None for no prims"""
        if self.by_pattern:
            return str(path)
        rules = (self.rules.get(above) for above in (*path.GetAncestorsRange(), Sdf.Path.absoluteRootPath))
        nearest = next((rule for rule in rules if rule not in (None, _EXPLICIT)), _EXCLUDE)
        below = tuple((name[len(str(path)):], self.rules[Sdf.Path(name)]) for name in _below(self._paths, path))
        return (nearest, below) if below or nearest != _EXCLUDE else None


class Binder:
    """A prim that binds by collections, which may be thousands: what they name between them."""

    def __init__(self, collections):
        """:param collections: list of Members"""
        self._by_pattern = any(members.by_pattern for members in collections)
        self._paths = sorted({str(path) for members in collections for path in members.rules})
        self._alone = {path for members in collections for path, rule in members.rules.items() if rule == _EXPLICIT}

    def divides(self, path):
        """:returns: whether a collection may hold some prims below a path and others not, or these not alike"""
        return self._by_pattern or path in self._alone or bool(_below(self._paths, path))


class CollectionBindings:
    """Tells of native instances that collections divide."""

    def __init__(self, stage):
        self._stage = stage
        self._above = {}  # path of a prim -> tuple of the Binders that it and those above it are
        self._members = {}  # path of a collection -> Members

    def signature(self, instance, names=()):
        """:param instance: native instance, by its place on the stage
        :param names: of its authored properties, where they are known
        :returns: None where one material is bound to all in it that binds none; else what two instances of one prototype have
            to have in common to be bound alike"""
        path, signature = instance.GetPath(), []
        if not any(binder.divides(path) for binder in self._binders(instance.GetParent()) + self._own(instance, names)):
            return None
        while not instance.IsPseudoRoot():
            signature += [self._binding(rel, path) for rel in _bindings(instance)]
            signature.append(None)  # the strength decides between what is nearer and what is above
            instance = instance.GetParent()
        return tuple(signature)

    def _binding(self, rel, path):
        """:returns: what a binding says of prims below a path, None for nothing"""
        members = None
        if _Api.CollectionBinding.IsCollectionBindingRel(rel):
            binding = _Api.CollectionBinding(rel)
            members = self._of(binding.GetCollectionPath()).signature(path)
            if members is None:
                return None
        else:
            binding = _Api.DirectBinding(rel)
        material = binding.GetMaterial()
        shown = in_prototype(material.GetPrim()) if material else ""
        return rel.GetName(), shown, _Api.GetMaterialBindingStrength(rel), members

    def _binders(self, prim):
        chain = []
        while not prim.IsPseudoRoot() and prim.GetPath() not in self._above:
            chain.append(prim)
            prim = prim.GetParent()
        found = self._above.get(prim.GetPath(), ())
        for prim in reversed(chain):
            found = self._above[prim.GetPath()] = found + self._own(prim)
        return found

    def _own(self, prim, names=()):
        collections = [self._of(_Api.CollectionBinding(rel).GetCollectionPath()) for rel in _bindings(prim, names)
                       if _Api.CollectionBinding.IsCollectionBindingRel(rel)]
        return (Binder(collections),) if collections else ()

    def _of(self, collection):
        if collection not in self._members:
            self._members[collection] = Members(self._stage, collection)
        return self._members[collection]


def _bindings(prim, names=()):
    return [prim.GetRelationship(name) for name in names or prim.GetAuthoredPropertyNames()
            if name.startswith("material:binding") and prim.HasRelationship(name)]


def _below(paths, path):
    """:param paths: sorted
    :returns: those below a path: they stand together"""
    first = bisect_left(paths, f"{path}/")
    return paths[first:bisect_left(paths, f"{path}0", first)]  # 0 follows on / in ASCII
