# SPDX-License-Identifier: Apache-2.0
"""Translates one frame of a stage into an edit of the scene."""
from pxr import UsdGeom

from . import backPlates, cameras, compat, drawModes, geometry, headlight, instancers, lights, mtlxFiles, networks
from .bindings import Bindings
from .context import Context, Guard
from .kinds import Kinds
from .linking import Linking
from .options import StageInfo, StageOptions
from .walk import Walk


def read_stage(stage, edit, options=None):
    """Sets every prim of a frame in an edit; what is wrong becomes warnings of the scene.

    :param stage: Usd.Stage; materials of MaterialX documents are added to its session layer
    :param edit: `_patina.SceneEdit`, not committed here
    :returns: StageInfo
    :raises StageError: when the camera that was asked for is not there, or the one that is used cannot be read"""
    context = Context(stage, edit, options or StageOptions())
    with compat.QuietDiagnostics() as quiet:
        try:
            info = _read(context)
        finally:
            context.xform_cache().Clear()
    for text in quiet.texts:
        if not any(known in text for known in context.reported):
            context.warn("/", "", "stageProblem", text)
    return info


def _read(context):
    stage, edit = context.stage, context.edit
    errors = compat.composition_errors(stage)
    context.reported = {text for _, text in errors}
    for path, text in mtlxFiles.supply(context, stage, errors):
        context.warn(path, "", "compositionError", text)
    edit.set_meters_per_unit(UsdGeom.GetStageMetersPerUnit(stage))
    edit.set_rendering_color_space(context.options.rendering_color_space)

    bindings = Bindings(context)
    linking = Linking(context)
    walked = Walk(context, bindings, linking).run()
    chosen = cameras.choose(context, walked)
    context.shutter = cameras.shutter_of(context, chosen)
    has_lights = _emit_lights(context, walked, linking)
    _emit_geometry(context, walked, bindings, linking)
    camera = None
    for found in walked.cameras:
        with Guard(context, found.prim, needed=found is chosen):
            placed = cameras.emit(context, found)
            camera = placed if found is chosen else camera
    backPlates.emit(context, walked.cameras, chosen)
    for path, material in bindings.materials.items():
        with Guard(context, material.GetPrim()):
            edit.set_material(path, networks.network_of(context, material, path))
            context.count("materials")
    info = _info(context, walked)
    if not camera:
        info.framed, camera = True, cameras.emit_framing(context, walked.gprims)
    info.camera = camera.path
    if not has_lights and context.options.headlight:
        info.headlight = True
        headlight.emit(context, camera)
    return info


def _emit_lights(context, walked, linking):
    """:returns: whether there are lights, or may be at another time or in another render pass"""
    founds = walked.lights + walked.mesh_lights
    for found in founds:
        with Guard(context, found.prim):
            lights.emit(context, found, linking)
    return bool(founds) or walked.dark


def _emit_geometry(context, walked, bindings, linking):
    kinds = Kinds()
    valued = {name for _, _, signature in walked.instances for name, _ in signature}  # stand above a material's
    for found, bound in zip(walked.gprims, bindings.resolve(walked.gprims)):
        with Guard(context, found.prim):
            fallbacks = [item for item in bindings.primvars_of(bound[0]) if item[0] not in valued or not found.state.group.name]
            geometry.emit(context, found, kinds.of(found.prim)[0], bound, linking.categories(found), fallbacks)
    for found, names in walked.instancers:
        with Guard(context, found.prim):
            instancers.emit_instancer(context, found, names, linking)
    for (outer, prototype, _), founds in walked.instances.items():
        with Guard(context, founds[0].prim):
            instancers.emit_instances(context, outer, prototype, founds, linking, walked.values)
    for found in walked.boxes:
        with Guard(context, found.prim):
            drawModes.emit(context, found)


def _info(context, walked):
    stage = context.stage
    return StageInfo(
        cameras=[found.path for found in walked.cameras], up_axis=str(UsdGeom.GetStageUpAxis(stage)),
        meters_per_unit=UsdGeom.GetStageMetersPerUnit(stage), start_time_code=stage.GetStartTimeCode(),
        end_time_code=stage.GetEndTimeCode(), time_codes_per_second=context.time_codes_per_second,
        shutter=context.shutter, counts=context.counts, notes=context.notes,
        uses_camera=context.uses_camera)
