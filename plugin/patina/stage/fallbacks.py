# SPDX-License-Identifier: Apache-2.0
"""Values of inputs that nobody authored: those of the schemas."""


class Fallbacks:
    """They follow from a prim's type and its API schemas. Asking each light for each of them takes most of the time of reading
    many lights."""

    def __init__(self):
        self._prim, self._names, self._key, self._known = None, (), None, {}

    def is_authored(self, prim, name):
        """:returns: whether the prim, the last one or another, has an opinion about an input, by its name or its older name"""
        if self._prim != prim:
            self._prim, self._names = prim, frozenset(prim.GetAuthoredPropertyNames())
            self._key = (prim.GetTypeName(), tuple(prim.GetAppliedSchemas()))
        return "inputs:" + name in self._names or name in self._names

    def of(self, name, attribute_of):
        """Of the prim that is_authored() was asked about.

        :param attribute_of: gives the attribute, or None; called where the value is not known yet"""
        key = (self._key, name)
        if key not in self._known:
            attribute = attribute_of()
            self._known[key] = attribute.Get() if attribute else None
        return self._known[key]
