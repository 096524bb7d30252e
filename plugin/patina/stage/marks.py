# SPDX-License-Identifier: Apache-2.0
"""Marks of prims: the primvars of hdDelegate/scene/primMarks.def, and the assets that prims belong to."""
import _patina
from pxr import Kind, Usd

_PREFIX = "primvars:"
NAMES = frozenset(_PREFIX + name for name in _patina.mark_names())  # of attributes


def authored(context, prim, properties, inherited):
    """:param properties: names of the prim's authored ones
    :param inherited: what this gave for its parent
    :returns: dict of marks and their values, by name without "primvars:" """
    own = NAMES.intersection(properties)
    if not own:
        return inherited
    found = dict(inherited)
    for name in own:
        value = single(prim.GetAttribute(name).Get(context.time))
        if value is not None:
            found[name[len(_PREFIX):]] = value
    return found


def single(value):
    """:returns: a number or a text; of an array, which primvars may have for one value, its only element; None for others"""
    if not isinstance(value, (str, bool, int, float)) and hasattr(value, "__len__"):
        value = value[0] if len(value) == 1 else None
    if isinstance(value, str):
        return value
    return float(value) if isinstance(value, (bool, int, float)) else None


def asset(prim, path, inherited):
    """:param path: of a model, in the scene
    :returns: the asset that it and what is below belong to"""
    kind = Usd.ModelAPI(prim).GetKind()
    is_asset = Kind.Registry.IsA(kind, Kind.Tokens.component) or Kind.Registry.IsA(kind, Kind.Tokens.assembly)
    return path if is_asset else inherited


def fields(found):
    """:returns: what `_patina` takes of a prim's marks and asset"""
    state, result = found.state, {}
    if state.asset:
        result["asset_name"] = state.asset
    if state.marks:
        result["marks"] = state.marks
    return result
