# SPDX-License-Identifier: Apache-2.0
"""Primvars as arrays."""
import _patina
import numpy as np
from pxr import UsdGeom

from .context import get

_IGNORED = "skel:"  # not for shading: they drive skinning
# What a mesh has as many of as values.
_COUNTED = {"uniform": "faceVertexCounts", "varying": "points", "vertex": "points", "faceVarying": "faceVertexIndices"}
INTERPOLATIONS = ("constant", "uniform", "varying", "vertex", "faceVarying")


def read_primvars(context, prim, inherited):
    """:param inherited: inheritable primvars of the prim's ancestors
    :returns: list of (name, interpolation, values, indices) of all numeric primvars"""
    found = []
    api = UsdGeom.PrimvarsAPI(prim)
    for primvar in api.FindPrimvarsWithInheritance(inherited):
        item = read_primvar(context, primvar, prim)
        if item:
            found.append(item)
    return found


def read_primvar(context, primvar, prim):
    name = primvar.GetPrimvarName()
    if name.startswith(_IGNORED):
        return None
    values = numbers(primvar.Get(context.time))
    if values is None:
        return None
    values = in_rendering_space(context, prim, primvar.GetAttr(), values)
    indices = primvar.GetIndices(context.time) if primvar.IsIndexed() else None
    indices = np.asarray(indices, dtype=np.int32) if indices is not None and len(indices) else None
    interpolation = primvar.GetInterpolation()
    size = primvar.GetElementSize()
    if size > 1 and not _fits_only_singly(context, prim, values, size, indices, interpolation):
        if len(values) % size:
            context.warn(prim.GetPath(), "primvars:" + name, "elementSizeUnfit", len(values), size)
            return None
        values = values.reshape(len(values) // size, -1)
    if values[0:1].size > 16:
        return None
    if interpolation not in INTERPOLATIONS:
        context.warn(prim.GetPath(), "primvars:" + name, "interpolationUnknown", interpolation)
        return None
    return (name, interpolation, values, indices)


def _fits_only_singly(context, prim, values, size, indices, interpolation):
    """Old exporters write the size of their own tuples as elementSize.

    :param size: the elementSize, above 1
    :param indices: None for a primvar without
    :returns: whether indices or values are as many as the prim needs only where each value is an element"""
    if indices is not None:
        return len(values) // size <= indices.max() < len(values)
    counted = _COUNTED.get(interpolation) if prim.IsA(UsdGeom.Mesh) else None
    return counted is not None and len(values) == len(get(prim, counted, context.time, ()))


def text(context, prim, inherited, name):
    """:param inherited: as of read_primvars()
    :returns: the text of a constant primvar, the prim's own or inherited; "" where there is none"""
    primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(name, inherited)
    value = primvar.Get(context.time) if primvar else None
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    if _is_array(value) and len(value) == 1 and isinstance(value[0], str):
        return value[0]
    context.warn(prim.GetPath(), "primvars:" + name, "notString")
    return ""


def in_rendering_space(context, prim, attribute, values):
    """:returns: the values: colours, and what says its colour space, are of the rendering space"""
    if values.ndim != 2 or values.shape[1] not in (3, 4) or values.dtype.kind != "f":
        return values
    space, rendering = context.color_spaces.space_of(attribute), context.options.rendering_color_space
    if not space and not (rendering and attribute.GetRoleName() == "Color"):
        return values
    converted = _patina.colors_to_rendering(values, space, rendering)
    if converted is None:
        context.warn(prim.GetPath(), attribute.GetName(), "valuesSpaceUnknown", space)
        return values
    return converted


def numbers(value):
    """:returns: an array of at least one dimension without a copy where pxr has an array, or None
    for what is not numeric or is empty"""
    if value is None or isinstance(value, str):
        return None
    if hasattr(value, "GetImaginary"):  # a quaternion
        value = [value.GetReal(), *value.GetImaginary()]
        return np.array([value], dtype=np.float32)
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):
        return None
    if array.dtype.kind not in "fiub":
        return None
    if array.dtype.kind == "b":
        array = array.astype(np.float32)
    if not _is_array(value):
        array = array.reshape((1, -1)) if array.ndim else array.reshape(1)
    return array if array.size else None


def _is_array(value):
    return type(value).__module__ == "pxr.Vt"


def add_builtin(context, prim, name, interpolation, into):
    """Adds a plain attribute (normals, widths) as a primvar unless there is a primvar of this name,
    which stands above it.

    :param into: list of primvars"""
    if any(item[0] == name for item in into):
        return
    values = numbers(get(prim, name, context.time))
    if values is not None and interpolation not in INTERPOLATIONS:
        context.warn(prim.GetPath(), name, "interpolationUnknown", interpolation)
    elif values is not None:
        into.append((name, interpolation, values, None))
