# SPDX-License-Identifier: Apache-2.0
"""Primvars that native instances inherit, as values of the instances: one prototype serves them all.

Primvars that give prims their shape, or that hold more than a value of an instance can, stay with the prims: their prototype is
read once for each.
"""
import numpy as np
from pxr import Usd, UsdShade

from . import kinds, marks, mtlxFiles
from .context import Guard
from .primvars import read_primvar

_MOST = 4  # components of a value
_FEW = 64  # elements or letters that are compared
_OF_SHAPES = {"widths", "normals", "st"}
_OF_SHAPING = ("displacement", "volume")  # terminals that are evaluated for a prototype, not for its instances
_COLORS = {"displayColor", "displayOpacity"}  # that nodes read without naming them


class Split:
    """The primvars of one state."""

    def __init__(self, copied, values, time):
        """:param copied: primvars that prims inherit themselves
        :param values: dict: name -> array of 1 to 4 floats"""
        self.copied, self.values = copied, values
        self.key = tuple(_key_of(primvar, time) for primvar in copied)  # equal ones can share a prototype
        self.signature = tuple(sorted((name, value.size) for name, value in values.items()))


class InstanceValues:
    """Decides it for the primvars of a stage."""

    def __init__(self, context):
        self.context = context
        self._splits = {}  # id of a tuple of primvars -> (that tuple, its Split)
        self._known = {}  # path of a primvar -> what _read_one() gave
        self._shaping = None  # names, once they are asked for

    def split(self, primvars):
        """:param primvars: tuple of inheritable ones
        :returns: a Split"""
        if id(primvars) not in self._splits:
            copied, values = [], {}
            for primvar in primvars:
                value = self._value(primvar)
                if value is None:
                    copied.append(primvar)
                elif value.size:
                    values[primvar.GetPrimvarName()] = value
            self._splits[id(primvars)] = primvars, Split(tuple(copied), values, self.context.time)
        return self._splits[id(primvars)][1]

    def of(self, founds):
        """:param founds: native instances whose values have one signature
        :returns: what set_instancer() takes as primvars"""
        splits = [self.split(found.state.primvars) for found in founds]
        primvars = []
        for name, _ in splits[0].signature:
            rows = [split.values[name] for split in splits]
            if all(row is rows[0] for row in rows):
                primvars.append((name, "constant", rows[0][None], None))
            else:
                primvars.append((name, "vertex", np.stack(rows), None))
        return primvars

    def _value(self, primvar):
        path = primvar.GetAttr().GetPath()
        if path not in self._known:
            self._known[path] = None
            with Guard(self.context, primvar.GetAttr().GetPrim()):
                self._known[path] = self._read_one(primvar)
        return self._known[path]

    def _read_one(self, primvar):
        """:returns: an array of floats, without elements where nothing reads the primvar; None where prims inherit it"""
        name = primvar.GetPrimvarName()
        if name == "lightGroup":
            return None
        item = None if "primvars:" + name in marks.NAMES else read_primvar(self.context, primvar, primvar.GetAttr().GetPrim())
        if item is None:
            return np.zeros(0, np.float32)
        _, _, values, indices = item
        if indices is not None and len(indices) == 1 and 0 <= indices[0] < len(values):
            values = values[indices]
        if len(values) != 1 or values.size > _MOST or name in self._names_of_shapes():
            return None
        return values.reshape(-1).astype(np.float32)

    def _names_of_shapes(self):
        if self._shaping is None:
            self._shaping, stage = set(_OF_SHAPES), self.context.stage
            for root in (stage.GetPseudoRoot(), *stage.GetPrototypes()):
                for prim in Usd.PrimRange(root):
                    if "Material" in kinds.schemas_of(prim):
                        self._shaping |= _shaping_names(UsdShade.Material(prim))
        return self._shaping


def _key_of(primvar, time):
    value = primvar.Get(time)
    few = not hasattr(value, "__len__") or len(value) <= _FEW
    return (primvar.GetPrimvarName(), repr(value) if few and not primvar.IsIndexed() else str(primvar.GetAttr().GetPath()))


def _shaping_names(material):
    """:returns: names of primvars that a material may read where it displaces or fills: all of its texts"""
    document = mtlxFiles.network_of(material)
    if document is not None:
        if not document.terminals().keys() & set(_OF_SHAPING):
            return set()
        return _COLORS | {value["value"] for node in document.nodes() for value in node["inputs"].values()
                          if isinstance(value["value"], str)}
    outputs = (output for output in material.GetOutputs() if output.GetBaseName().rpartition(":")[2] in _OF_SHAPING)
    if not any(output.GetAttr().HasAuthoredConnections() for output in outputs):
        return set()
    texts = (attribute.Get() for prim in Usd.PrimRange(material.GetPrim()) for attribute in prim.GetAuthoredAttributes()
             if attribute.GetName().startswith("inputs:"))
    return _COLORS | {text for text in texts if isinstance(text, str)}
