# SPDX-License-Identifier: Apache-2.0
"""Files that a stage names: resolved paths, UDIM patterns, and files inside of packages."""
import atexit
import hashlib
import os
import re
import shutil
import tempfile

from pxr import Ar, Sdf

from patina import inputs

from . import compat

_UDIM = "<UDIM>"
_folder = None  # where files of packages are put; removed at exit
_extracted = {}  # path in a package -> copy


def resolve(context, attribute):
    """The file that an asset attribute names, as a path that any program can open.

    :returns: a path; what the stage says, when there is no such file; empty when nothing is said"""
    file = _file_of(context, attribute)
    inputs.note(file)
    return file


def existing(context, prim, name, id_):
    """:param id_: of the message that tells of a file which is not there
    :returns: the file that an authored asset names, or ''"""
    attribute = prim.GetAttribute(name)
    file = resolve(context, attribute) if attribute and attribute.HasAuthoredValue() else ""
    if file and not os.path.exists(file):
        context.warn(prim.GetPath(), name, id_, file)
        return ""
    return file


def _file_of(context, attribute):
    value = attribute.Get(context.time)
    path = getattr(value, "path", value)
    if not path:
        return ""
    if not isinstance(path, str):
        context.warn(attribute.GetPrim().GetPath(), attribute.GetName(), "namesNoFile")
        return ""
    resolved = getattr(value, "resolvedPath", "")
    if _UDIM in path:
        return _resolve_tiles(attribute, context, path)
    if not resolved:
        return str(_anchored(attribute, context, path))
    if Ar.IsPackageRelativePath(resolved):
        return extract(resolved) or resolved
    return resolved


def _layers(attribute, context):
    """Yields the layers that may say what an attribute's value is, the strongest first."""
    for spec in attribute.GetPropertyStack(context.time):
        if spec.HasInfo("default") or spec.HasInfo("timeSamples"):
            yield spec.layer


def _anchored(attribute, context, path):
    """:returns: a path relative to the layer that says it, as an absolute one"""
    for layer in _layers(attribute, context):
        anchored = Sdf.ComputeAssetPathRelativeToLayer(layer, path) or path
        if anchored == path and not os.path.isabs(path) and ":" not in path:
            # Looked up along the resolver's search path, where patterns are never found.
            anchored = Sdf.ComputeAssetPathRelativeToLayer(layer, "./" + path) or path
        return anchored
    return path


def _resolve_tiles(attribute, context, path):
    layer = next(_layers(attribute, context), None)
    anchored = compat.resolve_tiles(context.stage, path, layer) or _anchored(attribute, context, path)
    if not Ar.IsPackageRelativePath(anchored):
        return anchored
    found = ""
    for tile in range(1001, 1101):
        inside = anchored.replace(_UDIM, str(tile))
        file = extract(inside)
        if file:
            found = re.sub(r"%d(?=[^/]*$)" % tile, _UDIM, file)
    return found or anchored


def extract(path):
    """Copies a file of a package (usdz) into a temporary folder.

    :param path: package-relative, "a.usdz[b.png]"
    :returns: path of the copy, None when it cannot be read"""
    global _folder
    if path in _extracted:
        return _extracted[path]
    data = None if "\0" in path else compat.read_asset(path)
    if data is None:
        return None
    if _folder is None:
        _folder = tempfile.mkdtemp(prefix="patina-")
        atexit.register(shutil.rmtree, _folder, ignore_errors=True)
    package, inner = Ar.SplitPackageRelativePathInner(path)
    # One folder per folder of a package: tiles stay together, equal names of others apart. File systems take 255 bytes.
    name = os.path.basename(inner)[-60:]
    key = hashlib.sha1((package + "\0" + inner[:len(inner) - len(name)]).encode(errors="surrogateescape")).hexdigest()[:16]
    file = os.path.join(_folder, key, "file" if name in ("", ".", "..") else name)
    os.makedirs(os.path.dirname(file), exist_ok=True)
    with open(file, "wb") as out:
        out.write(data)
    _extracted[path] = file
    return file
