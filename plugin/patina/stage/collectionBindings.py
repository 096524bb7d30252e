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
        """:param path: of the collection; one that is not there, or is none, holds nothing"""
        owner = stage.GetPrimAtPath(path.GetPrimPath()) if Usd.CollectionAPI.IsCollectionAPIPath(path) else None
        collection = Usd.CollectionAPI.Get(stage, path) if owner else None
        self.query = collection.ComputeMembershipQuery() if collection else None
        self.rules = self.query.GetAsPathExpansionRuleMap() if self.query else {}
        expression = getattr(collection, "GetMembershipExpressionAttr", None)  # of OpenUSD 23.11 and later
        self.by_pattern = not self.rules and expression is not None and expression().HasAuthoredValue()


class Binder:
    """The bindings of one prim, of which thousands may be by collections: a path leads to those that name it."""

    def __init__(self, rels, members):
        """:param members: Members of each binding, None of one that is by no collection"""
        self._rels = rels
        self._named = {}  # path -> list of (number of a binding whose collection names it, rule)
        self._always = {}  # number -> None, of direct bindings
        patterns = {}  # number -> query
        for number, of in enumerate(members):
            if of is None:
                self._always[number] = None
            elif of.by_pattern:
                patterns[number] = of.query
            for path, rule in of.rules.items() if of else ():
                self._named.setdefault(path, []).append((number, rule))
        self._patterns, self._queries = list(patterns), list(patterns.values())
        self._paths = sorted(map(str, self._named))
        # Of what binds a material of its own another binding may count than of what binds none.
        self._mixed = bool(self._named or patterns) and len(set(map(_Api.GetMaterialBindingStrength, rels))) > 1
        self._nearest, self._keys = {}, {}  # path -> see _nearest_at(), key()

    def parts(self, path, stage):
        """:returns: (dict of number -> what a binding holds at and below the path of a native instance, where what it says of
            the prim above does not tell; whether what counts may differ from prim to prim there)"""
        if not self._named and not self._patterns:
            return {}, False
        above, own, below, found = self._nearest_at(path.GetParentPath()), dict(self._named.get(path, ())), {}, {}
        for name in within(self._paths, path):
            for number, rule in self._named[Sdf.Path(name)]:
                below.setdefault(number, []).append((name[len(str(path)):], rule))
        for number in sorted({*own, *below}):
            outside = above.get(number, _EXCLUDE)
            rule = own.get(number, _EXPLICIT)
            nearest = outside if rule == _EXPLICIT else rule
            if number in below or nearest != outside:
                found[number] = nearest, tuple(below.get(number, ()))
        divided = self._mixed or bool(below) or _EXPLICIT in own.values()
        for number, row in zip(self._patterns, included(stage, path, self._queries)):
            divided = divided or len(set(row)) > 1
            if any(row):
                found[number] = None if all(row) else row
        return found, divided

    def key(self, path, known):
        """:param known: dict of what such keys stand for -> key, which this adds to
        :returns: stands for what the bindings say of a prim below a path, unless they name it or prims below it"""
        if path not in self._keys:
            texts = tuple(map(_text, self._rels)), tuple({**self._nearest_at(path), **self._always}.items())
            self._keys[path] = known.setdefault(texts, len(known))
        return self._keys[path]

    def _nearest_at(self, path):
        """:returns: dict of number -> the rule that holds for what is below a path, of those bindings that include it"""
        chain = []
        while path not in self._nearest:
            chain.append(path)
            if path.IsAbsoluteRootPath():
                break
            path = path.GetParentPath()
        found = self._nearest.get(path, {})
        for path in reversed(chain):
            own = {number: rule for number, rule in self._named.get(path, ()) if rule != _EXPLICIT}
            if own:
                found = {number: rule for number, rule in {**found, **own}.items() if rule != _EXCLUDE}
            self._nearest[path] = found
        return found


class CollectionBindings:
    """Tells of native instances that collections divide."""

    def __init__(self, stage):
        self._stage = stage
        self._above = {}  # path of a prim -> tuple of the Binders that it and those above it are, the nearest first
        self._members = {}  # path of a collection -> Members
        self._keys = {}  # see Binder.key()

    def signature(self, instance, names=()):
        """:param instance: native instance, by its place on the stage
        :param names: of its authored properties, where they are known
        :returns: None where one material is bound to all in it that binds none; else what two instances of one prototype have
            to have in common to be bound alike"""
        path, binders = instance.GetPath(), self._own(instance, names) + self._binders(instance.GetParent())
        parts = [binder.parts(path, self._stage) for binder in binders]
        if not any(divided for _, divided in parts):
            return None
        above = path.GetParentPath()
        return tuple((binder.key(above, self._keys), tuple(found.items())) for binder, (found, _) in zip(binders, parts))

    def members_of(self, collection):
        """:param collection: path
        :returns: Members"""
        if collection not in self._members:
            self._members[collection] = Members(self._stage, collection)
        return self._members[collection]

    def _binders(self, prim):
        chain = []
        while not prim.IsPseudoRoot() and prim.GetPath() not in self._above:
            chain.append(prim)
            prim = prim.GetParent()
        found = self._above.get(prim.GetPath(), ())
        for prim in reversed(chain):
            found = self._above[prim.GetPath()] = self._own(prim) + found
        return found

    def _own(self, prim, names=()):
        rels = [prim.GetRelationship(name) for name in names or prim.GetAuthoredPropertyNames()
                if name.startswith("material:binding") and prim.HasRelationship(name)]
        members = [self.members_of(_Api.CollectionBinding(rel).GetCollectionPath())
                   if _Api.CollectionBinding.IsCollectionBindingRel(rel) else None for rel in rels]
        return (Binder(rels, members),) if rels else ()


def _text(rel):
    """:returns: what a binding binds, whichever instance it lies in"""
    by_collection = _Api.CollectionBinding.IsCollectionBindingRel(rel)
    material = (_Api.CollectionBinding if by_collection else _Api.DirectBinding)(rel).GetMaterial()
    return rel.GetName(), in_prototype(material.GetPrim()) if material else "", _Api.GetMaterialBindingStrength(rel)


def within(paths, path):
    """:param paths: sorted
    :returns: those below a path: they stand together"""
    first = bisect_left(paths, f"{path}/")
    return paths[first:bisect_left(paths, f"{path}0", first)]  # 0 follows on / in ASCII


def included(stage, path, queries):
    """:returns: for each query of a collection, for the prims at a path and below, bytes that are 1 where it holds them"""
    if not queries:
        return ()
    below = Usd.PrimRange(stage.GetPrimAtPath(path), Usd.TraverseInstanceProxies())
    paths = [prim.GetPath() for prim in below]
    return tuple(bytes(map(query.IsPathIncluded, paths)) for query in queries)
