# SPDX-License-Identifier: Apache-2.0
"""Point instancers and native instances."""
import numpy as np
from pxr import Usd, UsdGeom

from .context import array_of, get, merged, sampled
from .primvars import in_rendering_space, numbers
from .transforms import is_finite, matrix_at, sample_times
from .turns import rate_of_velocities, turns_of_orientations


def emit_instancer(context, found, names, linking):
    """A point instancer. Instances that it hides or that are broken are left out."""
    prim, group = found.prim, found.state.group
    path = prim.GetPath()
    indices = array_of(context, prim, "protoIndices", 1, np.int32)
    if not len(indices):
        return
    schema, _stage = _usable(context, UsdGeom.PointInstancer(prim), len(indices))
    offsets, samples = _matrices(context, schema, prim, len(indices))
    if samples is None:
        context.warn(path, "positions", "instancerArraysDiffer")
        return
    with np.errstate(invalid="ignore", over="ignore"):  # told below
        samples = [local @ np.array(matrix_at(context, prim, group.anchor, t)) for t, local in zip(offsets, samples)]
    keep = _mask(UsdGeom.PointInstancer(prim), context.time, len(indices))
    keep = keep & ((indices >= 0) & (indices < len(names)))
    broken = int(np.count_nonzero((indices < 0) | (indices >= len(names))))
    if broken:
        context.warn(path, "protoIndices", "prototypesMissing", broken)
    finite = np.all([is_finite(s) for s in samples], axis=0)
    if not finite.all():
        context.warn(path, "positions", "instancesNotFinite", int((~finite).sum()))
    keep = keep & finite
    ids = get(prim, "ids", context.time)
    ids = np.asarray(ids) if ids is not None and len(ids) == len(indices) else np.arange(len(indices))
    transforms = [np.ascontiguousarray(s[keep]) for s in samples]
    categories = [[] if linking.is_divided(name) else linking.categories(found) for name in names]
    context.edit.set_instancer(
        found.path, group=group.name, prototypes=names, prototype_indices=indices[keep],
        transforms=sampled(offsets, transforms),
        ids=ids[keep].astype(np.int64).astype(np.int32), primvars=_primvars(context, prim, keep),
        categories=[categories[index] for index in indices[keep]] if any(categories) else None,
        asset_name=found.state.asset or None)
    context.count("pointInstancers")
    context.count("instances", int(keep.sum()))


_ARRAYS = ("positions", "orientations", "orientationsf", "scales", "velocities", "accelerations", "angularVelocities",
           "protoIndices")
_UNIT = 0.01  # how far a quaternion's length is from 1 where it was not meant to be: halves round by less


def _usable(context, schema, count):
    """:returns: (the instancer, None), or one with its arrays and the stage that keeps it: where they are longer than
        protoIndices, which renderers cut, or hold quaternions that are no rotations, which renderers normalise. pxr refuses
        the former and scales by the latter"""
    prim, time = schema.GetPrim(), context.time
    values = {name: get(prim, name, time) for name in _ARRAYS}
    long = [name for name, value in values.items() if value is not None and hasattr(value, "__len__") and len(value) > count]
    turns = [name for name in ("orientations", "orientationsf") if _far_from_unit(values[name])]
    if not long and not turns:
        return schema, None
    if long:
        context.warn(prim.GetPath(), long[0], "instanceValuesMany", len(values[long[0]]), count)
    if turns:
        context.warn(prim.GetPath(), turns[0], "quaternionsNotUnit")
    stage = Usd.Stage.CreateInMemory()
    stage.SetTimeCodesPerSecond(context.time_codes_per_second)
    own = UsdGeom.PointInstancer.Define(stage, "/own")
    for name in _ARRAYS:
        attribute = prim.GetAttribute(name)
        times = attribute.GetTimeSamples() if attribute else []
        for at in times or [Usd.TimeCode.Default()]:
            value = attribute.Get(at) if attribute else None
            if value is not None and hasattr(value, "__len__"):
                if len(value) > count:
                    value = value[:count] if count else type(value)()  # of nothing, a slice is None
                if name in turns:
                    value = type(value)([q.GetNormalized() for q in value])
                own.GetPrim().GetAttribute(name).Set(value, at)
    own.GetPrototypesRel().AddTarget("/own/prototype")
    return own, stage


def _far_from_unit(quaternions):
    if not type(quaternions).__name__.startswith("Quat") or not len(quaternions):
        return False
    return bool((abs(np.linalg.norm(np.asarray(quaternions, dtype=np.float64), axis=-1) - 1.0) > _UNIT).any())


def _matrices(context, schema, prim, count):
    """:param schema: of the instancer, maybe as _usable() gives it
    :returns: (times, list of arrays of matrices without the prototypes' own transforms)"""
    exclude, ignore = UsdGeom.PointInstancer.ExcludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
    offsets = sample_times(context, prim, None)
    if context.moving:
        attributes = [schema.GetPositionsAttr(), schema.GetOrientationsAttr(), schema.GetScalesAttr(),
                      schema.GetPrim().GetAttribute("orientationsf")]
        samples = {s for a in attributes if a and a.ValueMightBeTimeVarying()
                   for s in a.GetTimeSamplesInInterval(context.shutter_interval())}
        moves = any(a and a.ValueMightBeTimeVarying() for a in attributes)
        own = context.motion_offsets(samples, turns_of_orientations(context, schema)) if moves else []
        bent = (schema.GetAccelerationsAttr(), schema.GetAngularVelocitiesAttr())
        if any(a.HasAuthoredValue() for a in (schema.GetVelocitiesAttr(), *bent)):
            own += context.velocity_offsets(prim, bent, rate_of_velocities(context, schema))
        if own:
            offsets = merged([*own, *(offsets if len(offsets) > 1 else [])])
    arrays = []
    for offset in offsets:
        value = schema.ComputeInstanceTransformsAtTime(context.time_at(offset), context.time, exclude, ignore)
        array = np.asarray(value, dtype=np.float64)
        if array.size != 16 * count:
            return offsets, None
        arrays.append(array.reshape(count, 4, 4))
    return offsets, arrays


def _mask(schema, time, count):
    mask = schema.ComputeMaskAtTime(time)
    return np.asarray(mask, dtype=bool) if mask and len(mask) == count else np.ones(count, dtype=bool)


def _primvars(context, prim, keep):
    """:returns: primvars with a value per instance"""
    found = []
    for primvar in UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithValues():
        if primvar.GetInterpolation() == "constant":
            continue  # the prototypes inherit it
        values = numbers(primvar.ComputeFlattened(context.time))
        if values is None:
            continue
        if len(values) != len(keep):
            context.warn(prim.GetPath(), primvar.GetName(), "instanceValuesLeftOut", len(values), len(keep))
            continue
        values = in_rendering_space(context, prim, primvar.GetAttr(), values)
        found.append((primvar.GetPrimvarName(), "vertex", values[keep], None))
    return found


def _names(context, founds):
    """:returns: what mattes call each of several native instances, where mattes are asked for: a path takes more memory
        than an instance"""
    if not context.options.matte_names:
        return {}
    return {"names": [found.path for found in founds], "assets": [found.state.asset for found in founds]}


def emit_instances(context, outer, prototype, founds, linking, values):
    """All native instances of one prototype in one group, as one instancer.

    :param outer: name of the group that they appear in
    :param prototype: name of the prototype's group
    :param values: InstanceValues"""
    moving = {}  # number of instance -> (times, matrices)
    matrices = np.empty((len(founds), 4, 4))
    for i, found in enumerate(founds):
        anchor = found.state.group.anchor
        times = sample_times(context, found.prim, anchor)
        matrices[i] = np.array(matrix_at(context, found.prim, anchor, times[0]))
        if len(times) > 1:
            moving[i] = times
    times, samples = [0.0], [matrices]
    if moving:
        times = merged({t for own in moving.values() for t in own})
        samples = [matrices.copy() for _ in times]
        for i in moving:
            for sample, t in zip(samples, times):
                sample[i] = np.array(matrix_at(context, founds[i].prim, founds[i].state.group.anchor, t))
    finite = np.all([is_finite(sample) for sample in samples], axis=0)
    if not finite.all():
        context.warn(founds[0].prim.GetPath(), "xformOpOrder", "instanceTransformNotFinite")
        for sample in samples:
            sample[~finite] = np.eye(4)
    categories = [] if linking.is_divided(prototype) else [linking.categories(found) for found in founds]
    context.edit.set_instancer(
        founds[0].path, group=outer, prototypes=[prototype],
        prototype_indices=np.zeros(len(founds), dtype=np.int32),
        transforms=sampled(times, samples), categories=categories if any(categories) else None, primvars=values.of(founds),
        **_names(context, founds))
    context.count("instances", len(founds))
