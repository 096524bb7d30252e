# SPDX-License-Identifier: Apache-2.0
"""Light filters: prims of RenderMan's types that a light names by `light:filters`."""
import _patina
import numpy as np
from pxr import UsdGeom, UsdLux

from . import assets
from .context import number, shown, targets, vector
from .linking import is_selective
from .transforms import transform_of

_PREFIXES = ("inputs:ri:lightFilter:", "inputs:", "ri:lightFilter:", "")
_TYPES = {schema: word for schemas, word in _patina.light_filter_types().items() for schema in schemas.split()}
_INPUTS = [(names.split(), key, type_) for names, key, type_ in _patina.light_filter_inputs()]
# Name of an input that is not evaluated -> values at which that changes nothing.
_IGNORED = {name: idle.split() for names, idle in _patina.ignored_light_filter_inputs().items() for name in names.split()}


def of(context, light, group):
    """:returns: what set_light() takes as `filters`; one that cannot be used is left out with a warning"""
    filters = []
    for path in targets(light, "light:filters"):
        prim = context.stage.GetPrimAtPath(path)
        if not prim:
            context.warn(light.GetPath(), "light:filters", "filterMissing", path)
            continue
        name = _type_name(prim)
        if name not in _TYPES:
            context.warn(light.GetPath(), "light:filters", "filterTypeUnknown", path, name, ", ".join(sorted(_TYPES)))
            continue
        filters.append({"path": str(path), "type": _TYPES[name], "transform": _transform(context, prim, group),
                        **_read(context, prim, name)})
    return filters


def _type_name(prim):
    """Of a prim of the general type LightFilter its shader's."""
    shader = prim.GetAttribute("lightFilter:shaderId")
    return str(shown(shader and shader.Get() or prim.GetTypeName()))


def _transform(context, prim, group):
    """RenderMan's types are known to pxr where their schemas are installed; else their own transform is read here."""
    if prim.IsA(UsdGeom.Xformable):
        return transform_of(context, prim, group.anchor)
    own = UsdGeom.Xformable(prim)
    return transform_of(context, prim, group.anchor, lambda offset: own.GetLocalTransformation(context.time_at(offset)))


def _attribute(prim, names):
    for name in names:
        for prefix in _PREFIXES:
            attribute = prim.GetAttribute(prefix + name)
            if attribute and attribute.HasAuthoredValue():
                return attribute
    return None


def _read(context, prim, name):
    fields = {}
    for names, key, type_ in _INPUTS:
        attribute = _attribute(prim, names)
        value = attribute.Get(context.time) if attribute else None
        if value is None:
            continue
        read = _value(context, prim, attribute, type_, value)
        if read is not None:
            fields[key] = read
    if _TYPES[name] == "rod":
        fields.setdefault("intensity", 0.0)  # rods are there to block
    _tell_of_others(context, prim)
    return fields


def _tell_of_others(context, prim):
    """Warns of inputs that are not evaluated."""
    if is_selective(UsdLux.LightFilter(prim).GetFilterLinkCollectionAPI()):
        context.warn(prim.GetPath(), "collection:filterLink", "inputIgnored", "a link to some prims")
    known = {name for names, _, _ in _INPUTS for name in names}
    for attribute in prim.GetAuthoredAttributes():
        prefix = next((p for p in _PREFIXES[:-1] if attribute.GetName().startswith(p)), None)
        name = attribute.GetName()[len(prefix or ""):]
        if prefix is None or name in known or not attribute.HasAuthoredValue():
            continue
        value = attribute.Get(context.time)
        if not _is_idle(value, _IGNORED.get(name, ())):
            context.warn(prim.GetPath(), attribute.GetName(), "inputIgnored", shown(value))


def _is_idle(value, words):
    if "*" in words:
        return True
    if isinstance(value, (bool, int, float)):
        return any(word.lstrip("-").replace(".", "", 1).isdigit() and float(word) == value for word in words)
    if hasattr(value, "__len__") and not isinstance(value, str):
        return False  # an array's text may be of any length
    return str(value) in words or str(value) == ""


def _value(context, prim, attribute, type_, value):
    """:returns: None where it is of no use, after a warning"""
    name = attribute.GetName()
    if type_ == "float":
        return number(context, prim, name, None, value)
    if type_ == "bool":
        return bool(value)
    if type_ == "vec3":
        return vector(context, prim, name, (0.0, 0.0, 0.0), value)
    if type_ == "text":
        return assets.resolve(context, attribute) if hasattr(value, "path") else str(shown(value))
    try:
        values = np.asarray(value, dtype=np.float32)
    except (TypeError, ValueError):
        values = None
    shape = 1 if type_ == "floats" else 2
    if values is None or values.ndim != shape or not np.isfinite(values).all() or shape == 2 and values.shape[1] != 3:
        context.warn(prim.GetPath(), name, "arrayNotFinite")
        return None
    return values
