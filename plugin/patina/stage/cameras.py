# SPDX-License-Identifier: Apache-2.0
"""Cameras: those of the stage, and the one that frames a stage without any."""
import itertools
import math
from dataclasses import dataclass

import _patina
import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdRender, UsdUtils

from . import assets, compat, kinds, marks
from .context import array_of, get, number, shown
from .errors import StageError, one_line
from .state import Found, State, Walked
from .transforms import matrix_at, transform_of

FRAMING = "/patinaFramingCamera"
_APERTURE, _FOCAL = (20.955, 15.2908), 50.0  # of that camera
_MARGIN = 1.05
_INPUTS = _patina.camera_inputs()  # (attribute, key of the scene, fallback) each, of hdDelegate/scene/cameraTypes.inc
# Attribute -> name of hdDelegate/scene/cameraInputs.def; a name of its own is stronger than a primvar.
_INPUT_NAMES = {prefix + name: name for prefix in ("primvars:", "") for name in _patina.camera_input_names()}


def choose(context, walked):
    """:param walked: gets the camera where it is inside of a native instance
    :returns: the Found camera to render from, None when the stage has none and is to be framed
    :raises StageError: when the one that was asked for is not there"""
    chosen, named = _choice(context, walked)
    if chosen and not named and len(walked.cameras) > 1:
        context.notes.append(f"no camera was named; {chosen.path} of {len(walked.cameras)} is used")
    if chosen and not any(found is chosen for found in walked.cameras):
        walked.cameras.append(chosen)
    return chosen


def _choice(context, walked):
    """:returns: (Found or None, whether the user or the stage names it)"""
    wanted, founds = context.options.camera, walked.cameras
    by_path = {found.path: found for found in founds}
    if wanted:
        wanted = str(wanted)
        found = by_path.get(wanted) or _inside(context, wanted)
        if found:
            return found, True
        named = [found for found in founds if found.prim.GetName() == wanted] or _inner(context, walked, {wanted})
        if named:
            return named[0], True
        there = ", ".join(list(by_path)[:12]) or "none"
        raise StageError(f"there is no camera {wanted} (there are: {there}{', ...' if len(by_path) > 12 else ''})")
    settings = UsdRender.Settings.GetStageRenderSettings(context.stage)
    if settings:
        for target in settings.GetCameraRel().GetForwardedTargets():
            found = by_path.get(str(target)) or _inside(context, str(target))
            if found:
                return found, True
    primary = [found for found in founds if found.prim.GetName() == UsdUtils.GetPrimaryCameraName()]
    return (primary or founds or _inner(context, walked, walked.inner_cameras) or [None])[0], False


def chosen_before(context):
    """:returns: the camera of the picture, before a walk has found it: a Found, or None"""
    walked, stage = Walked(None), context.stage
    prims = iter(Usd.PrimRange(stage.GetPseudoRoot()))
    for prim in prims:
        schemas = kinds.schemas_of(prim)
        if "Camera" in schemas:
            walked.cameras.append(Found(prim, State(), str(prim.GetPath())))
        elif "PointInstancer" in schemas:
            prims.PruneChildren()
    walked.inner_cameras = {prim.GetName() for prototype in stage.GetPrototypes() for prim in Usd.PrimRange(prototype)
                            if "Camera" in kinds.schemas_of(prim)}
    try:
        return _choice(context, walked)[0]
    except StageError:
        return None  # choose() ends the command


def view_of(context):
    """:returns: Gf.Frustum of the camera of the picture, before the walk has found it"""
    chosen = chosen_before(context)
    if chosen:
        return UsdGeom.Camera(chosen.prim).GetCamera(context.time).frustum
    framing = _framing(context, ())
    return Gf.Camera(framing.matrix, horizontalAperture=_APERTURE[0], verticalAperture=_APERTURE[1], focalLength=_FOCAL,
                     clippingRange=Gf.Range1f(framing.reach * 1e-4, framing.reach * 100.0)).frustum


def _inside(context, path):
    """:returns: the camera at a path inside of a native instance, None where there is none"""
    prim = context.stage.GetPrimAtPath(path) if Sdf.Path.IsValidPathString(path) else None
    return Found(prim, State(), path) if prim and prim.IsInstanceProxy() and "Camera" in kinds.schemas_of(prim) else None


def _inner(context, walked, names):
    """:returns: list of the first camera inside of native instances that has one of these names, if there is one"""
    if not names & walked.inner_cameras:
        return []
    everything = Usd.PrimRange(context.stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())
    found = (_inside(context, str(prim.GetPath())) for prim in everything if prim.GetName() in names)
    return list(itertools.islice(filter(None, found), 1))


def shutter_of(context, found):
    """:returns: (open, close) in time codes relative to the frame"""
    if context.options.shutter is not None:
        return tuple(map(float, context.options.shutter))
    if not found:
        return (0.0, 0.0)
    opens, closes = (number(context, found.prim, "shutter:" + n, 0.0) for n in ("open", "close"))
    if closes < opens:
        context.warn(found.path, "shutter:close", "shutterCloses")
        return (0.0, 0.0)
    return (opens, closes)


def inputs_of(context, prim):
    """:returns: dict of what the camera has beyond UsdGeomCamera, by names of cameraInputs.def"""
    authored, found = set(prim.GetAuthoredPropertyNames()), {}
    for attribute_name, name in _INPUT_NAMES.items():
        attribute = prim.GetAttribute(attribute_name) if attribute_name in authored else None
        value = attribute.Get(context.time) if attribute else None
        if hasattr(value, "path"):
            value = assets.resolve(context, attribute)
        single = marks.single(value)
        if single is not None:
            found[name] = single
        elif value is not None:
            context.warn(prim.GetPath(), attribute_name, "noNumberOrText")
    return found


@dataclass
class Placed:
    """A camera in the scene."""
    path: str
    transform: object  # as set_camera() takes it
    orthographic: bool = False
    clip_near: float = 1.0
    clip_far: float = 1e6


def emit(context, found):
    """:returns: a Placed"""
    prim, time = found.prim, context.time
    fields = {key: number(context, prim, name, fallback) for name, key, fallback in _INPUTS}
    try:
        near, far = map(float, get(prim, "clippingRange", time, (1.0, 1e6)))
    except (TypeError, ValueError):
        context.warn(prim.GetPath(), "clippingRange", "clippingRangeUnusable")
        near, far = 1.0, 1e6
    planes = array_of(context, prim, "clippingPlanes", 4)
    opens, closes = context.shutter
    transform = transform_of(context, prim, None)
    matrices = transform[1] if isinstance(transform, tuple) else [transform]
    if any(abs(np.linalg.det(m[:3, :3].astype(np.float64))) < 1e-30 for m in matrices):
        context.warn(prim.GetPath(), "xformOpOrder", "cameraFlat")
        transform = np.eye(4)
    projection = get(prim, "projection", time, "perspective")
    if projection not in ("perspective", "orthographic"):
        context.warn(prim.GetPath(), "projection", "projectionUnknown", shown(projection))
    placed = Placed(found.path, transform, projection == "orthographic", near, far)
    context.edit.set_camera(
        found.path, transform=transform, orthographic=placed.orthographic,
        clip_near=near, clip_far=far, clipping_planes=planes,
        shutter_open=opens, shutter_close=closes,
        exposure_scale=compat.exposure_scale(UsdGeom.Camera(prim), time), inputs=inputs_of(context, prim), **fields)
    context.count("cameras")
    return placed


def _bounds(context, gprims):
    """:returns: range of the whole stage, skinned points included; authored extents that hold nothing
    are computed anew"""
    box = _authored_bounds(context, gprims)
    for prim, points in context.skinned:
        _unite(context, box, prim, lambda world, points=points: _range_of(points, np.array(world)))
    return box


def _range_of(points, world):
    placed = points @ world[:3, :3] + world[3, :3]
    return Gf.Range3d(Gf.Vec3d(*map(float, placed.min(axis=0))), Gf.Vec3d(*map(float, placed.max(axis=0))))


def _authored_bounds(context, gprims):
    if not context.cyclic:
        cache = UsdGeom.BBoxCache(context.time, sorted(context.purposes), useExtentsHint=True)
        try:
            box = cache.ComputeWorldBound(context.stage.GetPseudoRoot()).ComputeAlignedRange()
        except Tf.ErrorException:
            box = Gf.Range3d()  # one broken prim is enough for that; each is asked for its own
        if _is_usable(box):
            return box
    box = Gf.Range3d()
    for found in gprims:
        if not found.state.group.name:
            _unite(context, box, found.prim, lambda world, prim=found.prim: _extent_of(context, prim, world))
    return box


def _extent_of(context, prim, world):
    extent = UsdGeom.Boundable.ComputeExtentFromPlugins(UsdGeom.Boundable(prim), context.time)
    if not extent:
        return Gf.Range3d()
    return Gf.BBox3d(Gf.Range3d(Gf.Vec3d(extent[0]), Gf.Vec3d(extent[1])), world).ComputeAlignedRange()


def _unite(context, box, prim, range_in):
    """Adds the range of one prim to a box; a prim that has none is left out of it.

    :param range_in: a function of the prim's matrix that gives it"""
    try:
        own = range_in(matrix_at(context, prim, None, 0.0))
    except (Tf.ErrorException, TypeError, ValueError) as error:
        context.warn(prim.GetPath(), "extent", "extentUnreadable", one_line(error)[:300])
        return
    if _is_usable(own):
        box.UnionWith(own)


def _is_usable(box):
    return (not box.IsEmpty() and all(math.isfinite(x) for end in (box.GetMin(), box.GetMax()) for x in end)
            and box.GetSize().GetLength() > 0.0)


def _orientation(size, z_up):
    """:returns: rotation of the framing camera: from the front, a little from the right and above, so
    that boxes look like boxes and what lies flat is seen; flat pictures that stand are seen straight"""
    depth = size[1] if z_up else size[2]
    turn = Gf.Matrix4d(1.0)
    if depth > 0.02 * size.GetLength():
        turn.SetRotate(Gf.Rotation(Gf.Vec3d(1, 0, 0), -20.0) * Gf.Rotation(Gf.Vec3d(0, 1, 0), 25.0))
    if z_up:
        turn *= Gf.Matrix4d().SetRotate(Gf.Rotation(Gf.Vec3d(1, 0, 0), 90.0))
    return turn


@dataclass
class _Framing:
    """A camera that shows everything."""
    matrix: object
    distance: float  # to the middle of what it shows
    reach: float  # about as far as anything is


def _framing(context, gprims):
    """:param gprims: all that were found
    :returns: a _Framing"""
    box = _bounds(context, gprims)
    if not _is_usable(box):
        context.warn("/", "", "noExtents")
        box = Gf.Range3d(Gf.Vec3d(-1), Gf.Vec3d(1))
    matrix = _orientation(box.GetSize(), UsdGeom.GetStageUpAxis(context.stage) == UsdGeom.Tokens.z)
    centre, inverse = box.GetMidpoint(), matrix.GetInverse()
    corners = [inverse.TransformDir(Gf.Vec3d(box.GetCorner(i)) - centre) for i in range(8)]
    distance = max(c[2] + 2.0 * _FOCAL * _MARGIN * max(abs(c[0]) / _APERTURE[0], abs(c[1]) / _APERTURE[1]) for c in corners)
    matrix.SetTranslateOnly(centre + matrix.TransformDir(Gf.Vec3d(0, 0, distance)))
    return _Framing(matrix, distance, max(box.GetSize().GetLength(), distance))


def emit_framing(context, gprims):
    """Sets the camera of a stage that has none.

    :returns: a Placed"""
    framing = _framing(context, gprims)
    placed = Placed(FRAMING, np.array(framing.matrix), False, framing.reach * 1e-4, framing.reach * 100.0)
    context.edit.set_camera(FRAMING, transform=placed.transform, horizontal_aperture=_APERTURE[0],
                            vertical_aperture=_APERTURE[1], focal_length=_FOCAL, focus_distance=framing.distance,
                            clip_near=placed.clip_near, clip_far=placed.clip_far)
    context.notes.append("the stage has no camera; it is framed")
    return placed
