# SPDX-License-Identifier: Apache-2.0
"""Light filters: prims of RenderMan's types that a light names by `light:filters`."""
import functools

import numpy as np
from pxr import UsdGeom

from . import assets
from .context import number, vector
from .transforms import transform_of

_PREFIXES = ("inputs:ri:lightFilter:", "inputs:", "ri:lightFilter:", "")
# What is read to say that it is not done, with the values at which it does nothing.
_UNUSED = {"combineMode": ("", "mult", "multiply", 0), "diffuse": (1.0,), "specular": (1.0,), "saturation": (1.0,),
           "preBarn": ("", "None", "noEffect", 0), "preBarnEffect": ("", "None", "noEffect", 0)}


@functools.lru_cache(maxsize=None)
def _types():
    import _patina

    return {schema: word for schemas, word in _patina.light_filter_types().items() for schema in schemas.split()}


@functools.lru_cache(maxsize=None)
def _inputs():
    import _patina

    return [(names.split(), key, type_) for names, key, type_ in _patina.light_filter_inputs()]


def of(context, light, group):
    """:returns: what set_light() takes as `filters`; one that cannot be used is left out with a warning"""
    if not light.HasRelationship("light:filters"):
        return []
    filters = []
    for path in light.GetRelationship("light:filters").GetForwardedTargets():
        prim = context.stage.GetPrimAtPath(path)
        if not prim:
            context.warn(light.GetPath(), "light:filters", f"{path} does not exist; the filter is left out")
            continue
        name = _type_name(prim)
        if name not in _types():
            known = ", ".join(sorted(_types()))
            context.warn(light.GetPath(), "light:filters",
                         f"{path} is a light filter of unknown type '{name}' (known: {known}); it is left out")
            continue
        filters.append({"path": str(path), "type": _types()[name], "transform": _transform(context, prim, group),
                        **_read(context, prim, name)})
    return filters


def _type_name(prim):
    """Of a prim of the general type LightFilter its shader's."""
    shader = prim.GetAttribute("lightFilter:shaderId")
    return str(shader.Get()) if shader and shader.Get() else str(prim.GetTypeName())


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
    for names, key, type_ in _inputs():
        attribute = _attribute(prim, names)
        value = attribute.Get(context.time) if attribute else None
        if value is None:
            continue
        read = _value(context, prim, attribute, type_, value)
        if read is not None:
            fields[key] = read
    if _types()[name] == "rod":
        fields.setdefault("intensity", 0.0)  # rods are there to block
    for unused, idle in _UNUSED.items():
        attribute = _attribute(prim, [unused])
        value = attribute.Get(context.time) if attribute else None
        if value is not None and value not in idle:
            context.warn(prim.GetPath(), attribute.GetName(), f"is {value}, which is not evaluated")
    return fields


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
        return assets.resolve(context, attribute) if hasattr(value, "path") else str(value)
    try:
        values = np.asarray(value, dtype=np.float32)
    except (TypeError, ValueError):
        values = None
    shape = 1 if type_ == "floats" else 2
    if values is None or values.ndim != shape or not np.isfinite(values).all() or shape == 2 and values.shape[1] != 3:
        context.warn(prim.GetPath(), name, "is no array of finite numbers; the fallback is used")
        return None
    return values
