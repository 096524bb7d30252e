# SPDX-License-Identifier: Apache-2.0
"""Light and shadow linking through UsdLux's collections.

Everything is asked for by its path on the stage, where instance proxies stand for what is inside of native instances. Where a
collection divides a native prototype, or one of a point instancer, its prims have categories, else its instances have them.
"""
from pxr import Sdf, Usd, UsdLux

_KEPT = ("", "")


class Linking:
    """Which categories a prim is in. A category is a collection of a light that does not hold everything, by its path."""

    def __init__(self, context):
        self.context = context
        self._links = {}  # path of a light in the scene -> see links_of()
        self._names, self._queries = [], []  # of categories
        self._ruled = {}  # path that a collection names -> numbers of those categories
        self._wide = []  # numbers of those that hold the root, or patterns
        self._patterns = []  # numbers of those
        self._divided = set()  # paths above those
        self._lights = {}  # path of a native prototype -> see lights_below()
        self._within = {}  # path of a native prototype -> whether such a light is linked to parts of its own prototype
        self.split = set()  # names of groups of native prototypes that signature() divides
        self.roots = {}  # name of the group of a point instancer's prototype -> its path on the stage

    def add(self, found):
        """:param found: light; those of the world are added before the first instance or prototype is asked about"""
        group = found.state.group
        light = self.context.stage.GetPrimAtPath(group.on_stage(found.prim)) if group.native[0] else found.prim
        links = tuple(self._category(light, collection) for collection in _collections(light))
        if links != _KEPT:
            self._links[found.path] = links

    def links_of(self, found):
        """:returns: (light link, shadow link) of a light; empty ones mean everything"""
        return self._links.get(found.path, _KEPT)

    def _category(self, light, collection):
        if not is_selective(collection):
            return ""
        name, number = str(collection.GetCollectionPath()), len(self._names)
        try:
            query = collection.ComputeMembershipQuery()
        except Exception as error:  # pxr raises many types for cyclic collections
            self.context.warn(light.GetPath(), "collection:" + collection.GetName(), "linksUnusable",
                              " ".join(str(error).split())[:200])
            return ""
        rules = query.GetAsPathExpansionRuleMap()
        self._names.append(name)
        self._queries.append(query)
        for rule in rules:
            self._ruled.setdefault(rule, []).append(number)
            self._divided.update(rule.GetPrefixes()[:-1])
        if not rules:
            self._patterns.append(number)
        if not rules or Sdf.Path.absoluteRootPath in rules:
            self._wide.append(number)
        return name

    def lights_below(self, prototype):
        """:returns: dict of path -> prim of the lights in a native prototype and in those of its instances"""
        path = prototype.GetPath()
        if path not in self._lights:
            found = self._lights[path] = {}
            for prim in Usd.PrimRange(prototype):
                if prim.IsInstance():
                    found.update(self.lights_below(prim.GetPrototype()))
                elif prim.HasAPI(UsdLux.LightAPI):
                    found[prim.GetPath()] = prim
        return self._lights[path]

    def signature(self, found):
        """:param found: native instance
        :returns: what two instances of one prototype have to have in common to be lit alike, None where all below each is"""
        path = Sdf.Path(found.state.group.on_stage(found.prim))
        prototype = found.prim.GetPrototype()
        if prototype.GetPath() not in self._within:
            self._within[prototype.GetPath()] = any(map(_links_within, self.lights_below(prototype).values()))
        if path in self._divided or self._within[prototype.GetPath()]:
            return path
        return self._pattern(path) if self._patterns else None

    def _pattern(self, path):
        """:returns: which prims below a path each pattern has, None where it has all or none"""
        below = Usd.PrimRange(self.context.stage.GetPrimAtPath(path), Usd.TraverseInstanceProxies())
        paths = [prim.GetPath() for prim in below]
        rows = tuple(bytes(map(self._queries[number].IsPathIncluded, paths)) for number in self._patterns)
        return rows if any(len(set(row)) > 1 for row in rows) else None

    def signature_of_root(self, instancer, path):
        """:param instancer: Found of a point instancer, path: of its prototype on the stage
        :returns: what another instancer has to have in common with it to share the prototype"""
        return instancer.path if self._is_named(path) else ""

    def is_divided(self, name):
        """:returns: whether the prims of a group have categories of their own"""
        return not name or name in self.split or name in self.roots and self._is_named(self.roots[name])

    def _is_named(self, root):
        """:returns: whether a collection names a prototype of a point instancer or prims below, or may do so by a pattern"""
        return root in self._ruled or root in self._divided or bool(self._patterns)

    def categories(self, found):
        """:returns: names of the categories that hold a found prim; none where its instances have them"""
        if not self._queries or not self.is_divided(found.state.group.name):
            return []
        return [self._names[number] for number in sorted(self._numbers(found))]

    def _numbers(self, found):
        """:returns: set of the numbers of the categories that hold a prim. In a point instancer's prototype those that name
            it or prims between it and this one are asked about this one, others about the instancer"""
        group = found.state.group
        path, (instancer, root) = Sdf.Path(group.on_stage(found.prim)), group.instancer
        named = self._named(path)
        own = {number for number in named.union(self._wide) if self._queries[number].IsPathIncluded(path)}
        if not instancer:
            return own
        inside = self._named(path, root)
        return own & inside.union(self._patterns) | self._numbers(instancer) - inside

    def _named(self, path, root=Sdf.Path.absoluteRootPath):
        """:returns: set of the numbers of the categories that name a prim or those above it up to a root"""
        return set().union(*(self._ruled.get(above, ()) for above in path.GetPrefixes() if above.HasPrefix(root)))


def _collections(light):
    api = UsdLux.LightAPI(light)
    return api.GetLightLinkCollectionAPI(), api.GetShadowLinkCollectionAPI()


def _links_within(light):
    """:param light: in a native prototype
    :returns: whether its collections name something in that, or may do so by a pattern"""
    root = light.GetPath().GetPrefixes()[0]
    for collection in filter(is_selective, _collections(light)):
        rules = collection.ComputeMembershipQuery().GetAsPathExpansionRuleMap()
        if not rules or any(rule.HasPrefix(root) for rule in rules):
            return True
    return False


def is_selective(collection):
    """Whether a collection can leave a prim out."""
    if not collection:
        return False
    if collection.GetExcludesRel().HasAuthoredTargets():
        return True
    expression = getattr(collection, "GetMembershipExpressionAttr", None)
    if expression and expression() and expression().HasAuthoredValue():
        return True
    rule = collection.GetExpansionRuleAttr().Get() or Usd.Tokens.expandPrims
    return rule == Usd.Tokens.explicitOnly or not collection.GetIncludeRootAttr().Get()
