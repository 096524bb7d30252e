# SPDX-License-Identifier: Apache-2.0
"""Light and shadow linking through UsdLux's collections.

Everything is asked for by its path on the stage, where instance proxies stand for what is inside of native instances. Where a
collection divides a native prototype, or one of a point instancer, its prims have categories, else its instances have them.
"""
from pxr import Sdf, Usd, UsdLux

from .collectionBindings import included

_KEPT = ("", "")
_ROOT = Sdf.Path.absoluteRootPath
_EXPLICIT, _ALL = Usd.Tokens.explicitOnly, (Usd.Tokens.expandPrims, Usd.Tokens.expandPrimsAndProperties)


class Linking:
    """Which categories a prim is in. A category is a collection of a light that does not hold everything, by its path; those
    that hold the same are one. Most hold either what they name or all but that: prims differ from others by what names them."""

    def __init__(self, context):
        self.context = context
        self._links = {}  # path of a light in the scene -> see links_of()
        self._known, self._alike = {}, {}  # path of a collection, its rules -> name of its category, empty for none
        self._names, self._queries = [], []  # of categories
        self._ruled = {}  # path that a collection names -> numbers of those categories
        self._wide = set()  # numbers of those that hold what they do not name
        self._patterns = set()  # numbers of those that hold what fits a pattern
        self._divided = set()  # paths of which a collection may hold the prim or some below, and others not
        self._below = {}  # path that collections name -> see _apart() of prims below that none names
        self._lights = {}  # path of a native prototype -> see lights_below()
        self._within = {}  # path of a native prototype -> whether such a light is linked to parts of its own prototype
        self.split = set()  # names of groups of native prototypes that signature() divides
        self.roots = {}  # name of the group of a point instancer's prototype -> its path on the stage, those it draws elsewhere

    def add(self, found):
        """:param found: light; those of the world are added before the first instance or prototype is asked about"""
        group = found.state.group
        light = self.context.stage.GetPrimAtPath(group.on_stage(found.prim)) if group.native[0] else found.prim
        links = tuple(self._category(light, collection) for collection in _collections(light))
        if links != _KEPT:
            self._links[found.path] = links

    def foresee(self, instances, roots):
        """Adds the links of lights in prototypes, which are found after the first groups are chosen.

        :param instances: prims of the world that are native instances, roots: prototypes of its point instancers"""
        seen = set()
        for prim in instances:
            prototype = prim.GetPrototype()
            if prototype.GetPath() not in seen or self._links_within(prototype):
                if any(is_selective(link) for light in self.lights_below(prototype).values() for link in _collections(light)):
                    roots.append(prim)
            seen.add(prototype.GetPath())
        for root in roots:
            for prim in Usd.PrimRange(root, Usd.TraverseInstanceProxies(Usd.PrimIsActive & Usd.PrimIsLoaded)):
                if prim.HasAPI(UsdLux.LightAPI):
                    for collection in _collections(prim):
                        self._category(prim, collection)

    def links_of(self, found):
        """:returns: (light link, shadow link) of a light; empty ones mean everything"""
        return self._links.get(found.path, _KEPT)

    def _category(self, light, collection):
        """:returns: name of a collection's category, empty where it holds everything"""
        if not is_selective(collection):
            return ""
        name = str(collection.GetCollectionPath())
        if name not in self._known:
            try:
                query = collection.ComputeMembershipQuery()
            except Exception as error:  # pxr raises many types for cyclic collections
                self.context.warn(light.GetPath(), "collection:" + collection.GetName(), "linksUnusable",
                                  " ".join(str(error).split())[:200])
                self._known[name] = ""
                return ""
            rules = query.GetAsPathExpansionRuleMap()
            self._known[name] = self._alike.setdefault(frozenset(rules.items()), name) if rules else name
            if self._known[name] == name:
                self._add_category(name, query, rules)
        return self._known[name]

    def _add_category(self, name, query, rules):
        number = len(self._names)
        self._names.append(name)
        self._queries.append(query)
        self._below.clear()
        if not rules:
            self._patterns.add(number)
        elif rules.get(_ROOT) in _ALL:
            self._wide.add(number)
        for path, rule in rules.items():
            if path == _ROOT:
                continue
            self._ruled.setdefault(path, set()).add(number)
            self._divided.update(path.GetPrefixes() if rule == _EXPLICIT else path.GetPrefixes()[:-1])

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

    def _links_within(self, prototype):
        path = prototype.GetPath()
        if path not in self._within:
            self._within[path] = any(map(_is_linked_within, self.lights_below(prototype).values()))
        return self._within[path]

    def signature(self, found, apart):
        """:param found: native instance, apart: paths of prims elsewhere on the stage that it draws
        :returns: what two instances of one prototype have to have in common to be lit alike, None where all below each is"""
        path = Sdf.Path(found.state.group.on_stage(found.prim))
        parts = path if path in self._divided or self._links_within(found.prim.GetPrototype()) else self._pattern(path)
        if parts is None and not any(map(self._is_named, apart)):
            return None
        return parts, frozenset(self._apart_of(found))

    def _pattern(self, path):
        """:returns: which prims at a path and below each pattern has, None where it has all or none"""
        rows = included(self.context.stage, path, [self._queries[number] for number in self._patterns])
        return rows if any(len(set(row)) > 1 for row in rows) else None

    def signature_of_root(self, instancer, paths):
        """:param instancer: Found of a point instancer, paths: see roots
        :returns: what another instancer has to have in common with it to share the prototype"""
        return instancer.path if any(map(self._is_named, paths)) else ""

    def is_divided(self, name):
        """:returns: whether the prims of a group have categories of their own"""
        return not name or name in self.split or any(map(self._is_named, self.roots.get(name, ())))

    def _is_named(self, root):
        """:returns: whether a collection names a prototype of a point instancer or prims below, or may do so by a pattern"""
        return root in self._ruled or root in self._divided or bool(self._patterns)

    def has_links(self):
        """:returns: whether a light leaves something out"""
        return bool(self._queries)

    def categories(self, found):
        """:returns: names of the categories that hold a found prim; none where its instances have them"""
        if not self._queries or not self.is_divided(found.state.group.name):
            return []
        return [self._names[number] for number in sorted(self._wide ^ self._apart_of(found))]

    def _apart_of(self, found):
        """:returns: set of the numbers of the categories that hold a prim though they are not wide, or do not though they are.
            In a point instancer's prototype those that name it or prims between it and this one are asked about this one,
            others about the instancer"""
        group = found.state.group
        path, (instancer, root) = Sdf.Path(group.on_stage(found.prim)), group.instancer
        own = self._apart(path)
        if not instancer:
            return own
        inside = self._naming(path, root)
        return own & (inside | self._patterns) | self._apart_of(instancer) - inside

    def _apart(self, path):
        """:returns: see _apart_of(), by a path alone"""
        nearest = next((above for above in path.GetAncestorsRange() if above in self._ruled), _ROOT)
        found = self._below.get(nearest) if nearest != path else None
        if found is None:
            found = {number for number in self._naming(nearest)
                     if self._queries[number].IsPathIncluded(path) != (number in self._wide)}
            if nearest != path:
                self._below[nearest] = found
        if self._patterns:
            found = found | {number for number in self._patterns if self._queries[number].IsPathIncluded(path)}
        return found

    def _naming(self, path, root=_ROOT):
        """:returns: set of the numbers of the categories that name a prim or those above it up to a root"""
        return set().union(*(self._ruled.get(above, ()) for above in path.GetAncestorsRange() if above.HasPrefix(root)))


def _collections(light):
    api = UsdLux.LightAPI(light)
    return api.GetLightLinkCollectionAPI(), api.GetShadowLinkCollectionAPI()


def _is_linked_within(light):
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
