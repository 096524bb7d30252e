# SPDX-License-Identifier: Apache-2.0
"""The colour space of an attribute: its own, else that of the nearest prim above with a ColorSpaceAPI."""
import numpy as np
from pxr import Sdf

_COLORS = ("color3f", "color3h", "color3d", "color4f", "color4h", "color4d")
# Of ColorSpaceDefinitionAPI, with its fallbacks.
_DEFINITION = (("redChroma", (1.0, 0.0)), ("greenChroma", (0.0, 1.0)), ("blueChroma", (0.0, 0.0)),
               ("whitePoint", (1.0 / 3.0, 1.0 / 3.0)), ("gamma", (1.0,)), ("linearBias", (0.0,)))
_DEFINED = "ColorSpaceDefinitionAPI:"


class ColorSpaces:
    """Remembers what the prims that it has met say."""

    def __init__(self, edit):
        """:param edit: that is warned; not the context, which would hold itself and with that the stage"""
        self._edit = edit
        self._met = {}  # path -> (name that holds here or '', {name: what the stage defines it as})

    def space_of(self, attribute, reads_colors=False, is_color=False):
        """:param reads_colors: whether an asset is an image of colours, which has the inherited space
        :param is_color: whether it holds colours, whatever its type
        :returns: name for `_patina`, '' where none is said; a space that the stage defines itself is written out"""
        name, defined = self._prim(attribute.GetPrim())
        if attribute.HasColorSpace():
            name = attribute.GetColorSpace()
        else:
            type_ = attribute.GetTypeName()
            if not is_color and str(type_.scalarType) not in _COLORS and not (
                    reads_colors and type_ == Sdf.ValueTypeNames.Asset):
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
                said = self._read(prim, *said)
            self._met[prim.GetPath()] = said
        return said

    def _read(self, prim, name, defined):
        # As authored too: releases before 25.02 do not know the schemas of colour spaces.
        schemas = list(prim.GetAppliedSchemas()) + prim.GetMetadata("apiSchemas").GetAddedOrExplicitItems()
        if "ColorSpaceAPI" in schemas:
            name = self._name(prim, "colorSpace:name", "") or name
        own = {}
        for schema in schemas:
            if schema.startswith(_DEFINED):
                prefix = f"colorSpaceDefinition:{schema[len(_DEFINED):]}:"
                fields = [self._numbers(prim, prefix + field, fallback) for field, fallback in _DEFINITION]
                text = " ".join(f"{x:.7g}" for numbers in fields for x in numbers)
                own[self._name(prim, prefix + "name", "custom")] = f"chromaticities({text})"
        return name, ({**defined, **own} if own else defined)

    def _name(self, prim, input_, fallback):
        value = _value(prim, input_)
        if value is None or isinstance(value, str):
            return fallback if value is None else value
        self._edit.warn(str(prim.GetPath()), input_, "noColorSpaceName")
        return fallback

    def _numbers(self, prim, input_, fallback):
        """:returns: a tuple of as many finite numbers as the fallback, which stands in for anything else after a warning"""
        value = _value(prim, input_)
        if value is None:
            return fallback
        numbers = None if isinstance(value, str) else finite(np.reshape(value, -1), len(fallback))
        if numbers is None:
            self._edit.warn(str(prim.GetPath()), input_, "colorSpaceNumbers", fallback)
        return fallback if numbers is None else numbers


def finite(value, count, dtype=np.float64):
    """:returns: a tuple of so many finite numbers; None where the value is anything else"""
    try:
        numbers = np.array(value, dtype=dtype)
    except (TypeError, ValueError):
        return None
    return tuple(map(float, numbers)) if numbers.shape == (count,) and np.isfinite(numbers).all() else None


def _value(prim, name):
    attribute = prim.GetAttribute(name)
    return attribute.Get() if attribute else None
