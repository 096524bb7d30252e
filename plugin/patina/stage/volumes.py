# SPDX-License-Identifier: Apache-2.0
"""UsdVolVolume: fields of OpenVDB files."""
from pxr import UsdVol

from . import kinds, lights
from .assets import resolve
from .context import get


def emit(context, found, common):
    volume = UsdVol.Volume(found.prim)
    if "VolumeLightAPI" in found.prim.GetAppliedSchemas():
        common["light"] = lights.glow_of(context, found.prim)
    names, files, grids = [], [], []
    for name, path in sorted(volume.GetFieldPaths().items()):
        prim = context.stage.GetPrimAtPath(path)
        if not prim:
            context.warn(found.prim.GetPath(), f"field:{name}", "fieldNotFound", path)
            continue
        if "OpenVDBAsset" not in kinds.schemas_of(prim):
            context.warn(path, "", "fieldTypeNotRead", prim.GetTypeName() or "none")
            continue
        world = context.xform_cache().GetLocalToWorldTransform
        if world(prim) != world(found.prim):
            context.warn(path, "xformOpOrder", "fieldTransformIgnored")
        names.append(name)
        files.append(resolve(context, prim.GetAttribute("filePath")))
        grids.append(get(prim, "fieldName", context.time) or name)
    context.edit.set_volume(found.path, field_names=names, field_files=files, field_grids=grids, **common)
