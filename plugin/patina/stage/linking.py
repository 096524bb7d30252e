# SPDX-License-Identifier: Apache-2.0
"""Light and shadow linking through UsdLux's collections."""
from pxr import Usd, UsdLux


class Linking:
    """Which categories a prim is in. A category is a collection that does not hold everything, by
    its path; instances have categories of their own, prims inside of prototypes have none."""

    def __init__(self, context):
        self.context = context
        self._queries = {}  # name of category -> membership query

    def links_of(self, light):
        """:returns: (light link, shadow link) of a light; empty ones mean everything"""
        api = UsdLux.LightAPI(light)
        return (self._category(light, api.GetLightLinkCollectionAPI()),
                self._category(light, api.GetShadowLinkCollectionAPI()))

    def _category(self, light, collection):
        if not collection or not _is_selective(collection):
            return ""
        name = str(collection.GetCollectionPath())
        try:
            self._queries[name] = collection.ComputeMembershipQuery()
        except Exception as error:  # pxr raises many types for cyclic collections
            self.context.warn(light.GetPath(), "collection:" + collection.GetName(), "linksUnusable",
                              " ".join(str(error).split())[:200])
            return ""
        return name

    def categories(self, found):
        """:returns: names of the categories that hold a found prim; none inside of prototypes"""
        if not self._queries or found.state.group.name:
            return []
        path = found.prim.GetPath()
        return [name for name, query in self._queries.items() if query.IsPathIncluded(path)]


def _is_selective(collection):
    """Whether a collection can leave a prim out."""
    if collection.GetExcludesRel().HasAuthoredTargets():
        return True
    expression = getattr(collection, "GetMembershipExpressionAttr", None)
    if expression and expression() and expression().HasAuthoredValue():
        return True
    rule = collection.GetExpansionRuleAttr().Get() or Usd.Tokens.expandPrims
    return rule == Usd.Tokens.explicitOnly or not collection.GetIncludeRootAttr().Get()
