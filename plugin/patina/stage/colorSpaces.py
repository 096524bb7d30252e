# SPDX-License-Identifier: Apache-2.0
"""The colour space of an attribute: its own, else that of the nearest prim above with a ColorSpaceAPI."""
from pxr import Sdf

_COLORS = ("color3f", "color3h", "color3d", "color4f", "color4h", "color4d")
# Of ColorSpaceDefinitionAPI, with its fallbacks.
_DEFINITION = (("redChroma", (1.0, 0.0)), ("greenChroma", (0.0, 1.0)), ("blueChroma", (0.0, 0.0)),
               ("whitePoint", (1.0 / 3.0, 1.0 / 3.0)), ("gamma", 1.0), ("linearBias", 0.0))
_DEFINED = "ColorSpaceDefinitionAPI:"


class ColorSpaces:
    """Remembers what the prims that it has met say."""

    def __init__(self):
        self._met = {}  # path -> (name that holds here or '', {name: what the stage defines it as})

    def space_of(self, attribute, reads_colors=False):
        """:param reads_colors: whether an asset is an image of colours, which has the inherited space
        :returns: name for `_patina`, '' where none is said; a space that the stage defines itself is written out"""
        name, defined = self._prim(attribute.GetPrim())
        if attribute.HasColorSpace():
            name = attribute.GetColorSpace()
        else:
            type_ = attribute.GetTypeName()
            if str(type_.scalarType) not in _COLORS and not (reads_colors and type_ == Sdf.ValueTypeNames.Asset):
                return ""
        return defined.get(name, name)

    def _prim(self, prim):
        new = []
        while prim.GetPath() not in self._met and not prim.IsPseudoRoot():
            new.append(prim)
            prim = prim.GetParent()
        said = self._met.get(prim.GetPath(), ("", {}))
        for prim in reversed(new):
            if prim.HasAuthoredMetadata("apiSchemas"):
                said = _read(prim, *said)
            self._met[prim.GetPath()] = said
        return said


def _read(prim, name, defined):
    # As authored too: releases before 25.02 do not know the schemas of colour spaces.
    schemas = list(prim.GetAppliedSchemas()) + prim.GetMetadata("apiSchemas").GetAddedOrExplicitItems()
    if "ColorSpaceAPI" in schemas:
        name = str(_value(prim, "colorSpace:name", None) or name)
    own = {}
    for schema in schemas:
        if schema.startswith(_DEFINED):
            prefix = f"colorSpaceDefinition:{schema[len(_DEFINED):]}:"
            numbers = []
            for field, fallback in _DEFINITION:
                value = _value(prim, prefix + field, fallback)
                numbers.extend(value if hasattr(value, "__len__") else (value,))
            text = " ".join(f"{float(x):.7g}" for x in numbers)
            own[str(_value(prim, prefix + "name", "custom"))] = f"chromaticities({text})"
    return name, ({**defined, **own} if own else defined)


def _value(prim, name, fallback):
    attribute = prim.GetAttribute(name)
    value = attribute.Get() if attribute else None
    return fallback if value is None else value
