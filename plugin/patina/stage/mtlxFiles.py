# SPDX-License-Identifier: Apache-2.0
"""References to MaterialX documents, which pxr without its MaterialX plugin cannot open.

Before such a stage is read, an anonymous layer stands in for each document: a Material prim for each
material, where the plugin would put it, with the document as metadata. The networks themselves come
from `_patina.read_mtlx`.
"""
import os

import _patina
from pxr import Sdf, Usd

from patina import inputs

from .context import Guard

_KEY = "patinaDocument"
_networks = {}  # mark of a material -> Network


def network_of(material):
    """:returns: the Network of a material that stands for one of a document, else None"""
    mark = material.GetPrim().GetCustomDataByKey(_KEY)
    return _networks.get(mark) if isinstance(mark, str) else None  # a file may hold any value there


def supply(context, stage, errors):
    """Adds what pxr could not reference.

    :param errors: of compat.composition_errors()
    :returns: the errors that are left"""
    left, wanted = [], set()
    for path, text in errors:
        if ".mtlx" in text and path != "/":  # a sublayer has no prim to reference it from
            wanted.add(path)
        else:
            left.append((path, text))
    if not wanted:
        return left
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        for path in sorted(wanted):
            prim = stage.GetPrimAtPath(path)
            if prim:
                with Guard(context, prim):
                    _supply_prim(context, prim)
    return left


def _supply_prim(context, prim):
    done = set()
    for spec, _ in prim.GetPrimStackWithLayerOffsets():
        for items in (spec.referenceList, spec.payloadList):
            for item in items.GetAddedOrExplicitItems():
                if not item.assetPath.endswith(".mtlx"):
                    continue
                file = Sdf.ComputeAssetPathRelativeToLayer(spec.layer, item.assetPath)
                if (file, item.primPath) in done:
                    continue
                done.add((file, item.primPath))
                layer = _layer_of(context, prim, file)
                if layer:
                    target = item.primPath or Sdf.Path("/MaterialX")
                    if layer.GetPrimAtPath(target):
                        prim.GetReferences().AddReference(layer.identifier, target)
                        _KEEP.append(layer)
                    else:
                        context.warn(prim.GetPath(), "references", "referenceWithout", file, target)


_KEEP = []  # anonymous layers live as long as someone holds them
_layers = {}


def _layer_of(context, prim, file):
    if not os.path.exists(file):
        context.warn(prim.GetPath(), "references", "fileMissing", file)
        return None
    inputs.check_regular(file)
    inputs.note_document(file)
    stamp = (file, os.path.getmtime(file), context.meters_per_unit)
    if stamp in _layers:
        return _layers[stamp]
    warnings = []
    networks = _patina.read_mtlx(file, warnings, context.meters_per_unit)
    context.repeat(warnings)
    layer = Sdf.Layer.CreateAnonymous(os.path.basename(file) + ".usda")
    for network in networks:
        name = network.path[len(file) + 1:]  # may hold colons, of namespaces
        mark = f"{file}\n{name}\n{context.meters_per_unit}"
        _networks[mark] = network
        spec = Sdf.CreatePrimInLayer(layer, Sdf.Path("/MaterialX/Materials").AppendChild(_valid(name)))
        spec.specifier, spec.typeName = Sdf.SpecifierDef, "Material"
        spec.customData[_KEY] = mark
    for path in ("/MaterialX", "/MaterialX/Materials"):
        spec = Sdf.CreatePrimInLayer(layer, path)
        spec.specifier = Sdf.SpecifierDef
    _layers[stamp] = layer
    return layer


def _valid(name):
    clean = "".join(c if c.isalnum() or c == "_" else "_" for c in name)
    return clean if Sdf.Path.IsValidIdentifier(clean) else "_" + clean
