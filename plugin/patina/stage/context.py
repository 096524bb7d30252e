# SPDX-License-Identifier: Apache-2.0
"""The context that every part of the reader needs: the stage, the time, the edit, and caches."""
import numpy as np
from pxr import Gf, Usd, UsdGeom

from . import cycles
from .colorSpaces import ColorSpaces, finite
from .errors import StageError, one_line

MAX_MOTION_SAMPLES = 16
_MOST_STEPS = 8  # uniform times of a shutter that the renderer has, whatever samples it is given
# Over a turn of t, the middle of a chord is nearer to the axis than its arc by 1 - cos(t / 2) of the radius: a hundredth here.
_LARGEST_TURN = 2.0 * np.arccos(1.0 - 0.01)
LONGEST_FIELD = 500  # characters; values of a stage may be of any length
_MOST_SHOWN = 16  # elements of a value: those of a matrix


class Context:
    """One reading of a stage."""

    def __init__(self, stage, edit, options):
        self.stage, self.edit, self.options = stage, edit, options
        self.time = Usd.TimeCode.Default() if options.frame is None else Usd.TimeCode(options.frame)
        self.shutter = (0.0, 0.0)
        self.purposes = set(options.purposes) - {"default"} | ({"default"} if options.default_purpose else set())
        meters = UsdGeom.GetStageMetersPerUnit(stage)
        self.meters_per_unit = meters if 0.0 < meters < np.inf else UsdGeom.LinearUnits.centimeters
        self.time_codes_per_second = stage.GetTimeCodesPerSecond() or 24.0
        self.counts = {}
        self.notes = []
        self.uses_camera = False  # another one would see other things
        self.reported = set()  # texts of composition errors, which pxr also prints
        self.skinned = []  # (prim whose space it is, points) of what UsdGeom.BBoxCache does not know
        self._cyclic = None  # not known yet
        self.color_spaces = ColorSpaces(edit)
        self.light_fallbacks = Fallbacks()
        self.portals = None  # paths of the portals that domes name, once they are asked for
        self._xforms = {}

    def warn(self, prim, input_, id_, *fields):
        """:param id_: of a message, fields: see patina.messages.warning"""
        texts = [text if len(text) <= LONGEST_FIELD else text[:LONGEST_FIELD] + "..." for text in map(str, fields)]
        self.edit.warn(str(prim), input_, id_, *texts)

    def repeat(self, warnings):
        """Warns again of what a reader of C++ gathered."""
        for warning in warnings:
            self.warn(warning["prim"], warning["input"], warning["id"], *warning["fields"].values())

    def count(self, kind, number=1):
        self.counts[kind] = self.counts.get(kind, 0) + number

    @property
    def moving(self):
        """Whether things are read at more than one time: they move while the shutter is open, or AOVs tell their motion."""
        return not self.time.IsDefault() and (self.shutter[1] > self.shutter[0] or self.options.motion)

    def with_moments(self, offsets):
        """:returns: the times, and those that AOVs of motion ask for"""
        return distinct(sorted({*offsets, -1.0, 1.0})) if self.options.motion else offsets

    def xform_cache(self, offset=0.0):
        """:param offset: time codes from the frame"""
        if offset not in self._xforms:
            self._xforms[offset] = UsdGeom.XformCache(self.time_at(offset))
        return self._xforms[offset]

    def time_at(self, offset):
        return self.time if offset == 0.0 else Usd.TimeCode(self.time.GetValue() + offset)

    def shutter_interval(self):
        frame = self.time.GetValue()
        return Gf.Interval(frame + self.shutter[0], frame + self.shutter[1])

    @property
    def cyclic(self):
        """Whether there are instancers that hold themselves, drawn or not: UsdGeom.BBoxCache never ends there."""
        if self._cyclic is None:
            self._cyclic = cycles.are_in(self.stage)
        return self._cyclic

    def motion_offsets(self, samples, turns=()):
        """When to evaluate what has these time samples: the ends of the shutter, what is between, and the moments.

        :param samples: authored time codes inside the shutter
        :param turns: functions of two times that bound by how many radians it turns between them; their sum does
        :returns: ascending times relative to the frame"""
        offsets = self._shutter_offsets(samples)
        angles = [sum(turn(*span) for turn in turns) for span in zip(offsets, offsets[1:])] if turns else []
        if any(angle > _LARGEST_TURN for angle in angles):
            rate = np.max(np.array(angles) / np.diff(offsets))
            offsets = merged([*offsets, *self.turn_offsets(rate)], self._most_samples)
        return self.with_moments(offsets)

    def turn_offsets(self, rate):
        """:param rate: radians per time code
        :returns: the times in the shutter that such a turn needs: none where its ends will do"""
        start, end = self.shutter
        turn = rate * (end - start)
        if not turn > _LARGEST_TURN:
            return []
        return np.linspace(start, end, 1 + int(np.ceil(min(turn / _LARGEST_TURN, _MOST_STEPS - 1)))).tolist()

    def _shutter_offsets(self, samples):
        frame, (start, end) = self.time.GetValue(), self.shutter
        if not end > start:  # all is as at the frame's time
            return [0.0]
        inside = sorted({float(s) - frame for s in samples if start < float(s) - frame < end})
        if len(inside) > self._most_samples - 2:
            step = (end - start) / (self._most_samples - 1)
            inside = [start + step * i for i in range(1, self._most_samples - 1)]
        return distinct([start, *inside, end])

    @property
    def _most_samples(self):
        return MAX_MOTION_SAMPLES - (2 if self.options.motion else 0)

    def velocity_offsets(self, prim, bent, rate=0.0):
        """When to evaluate what velocities move in the shutter: the ends, and where accelerations or angular velocities bend
        the way, as many times as UsdGeomMotionAPI asks for, 3 at least, as in Hydra.

        :param bent: attributes that bend it, where they are authored
        :param rate: radians per time code that it turns by
        :returns: ascending times relative to the frame"""
        count = max(2, len(self.turn_offsets(rate)))
        if any(attribute.HasAuthoredValue() for attribute in bent):
            count = max(count, 3, UsdGeom.MotionAPI(prim).ComputeNonlinearSampleCount(self.time))
        if not self.shutter[1] > self.shutter[0]:
            return self.with_moments([0.0])
        return self.with_moments(distinct(np.linspace(*self.shutter, min(count, self._most_samples)).tolist()))

    def attribute_offsets(self, attribute):
        """:returns: motion_offsets() of an attribute, or [0] when it does not move in the shutter. Like Hydra it
            takes the authored samples before and after instead of the ends of the shutter, where there are any"""
        if not self.moving or not attribute or not attribute.ValueMightBeTimeVarying():
            return [0.0]
        interval, frame = self.shutter_interval(), self.time.GetValue()
        offsets = self._shutter_offsets(attribute.GetTimeSamplesInInterval(interval))
        if len(offsets) > 1:
            before, after = (attribute.GetBracketingTimeSamples(t) for t in (interval.min, interval.max))
            if before and before[0] <= interval.min:
                offsets[0] = before[0] - frame
            if after and after[1] >= interval.max:
                offsets[-1] = after[1] - frame
        return self.with_moments(distinct(offsets))


def distinct(times):
    """:param times: ascending
    :returns: those that are later than the one before as 32-bit floats too, which the renderer has"""
    kept = times[:1]
    kept += [time for before, time in zip(times, times[1:]) if np.float32(time) > np.float32(before)]
    return kept


def merged(times, most=MAX_MOTION_SAMPLES):
    """:param times: of several things, in any order
    :returns: ascending times that are distinct(), no more than the renderer takes"""
    times = distinct(sorted(times))
    return times if len(times) <= most else distinct(np.linspace(times[0], times[-1], most).tolist())


def shown(value):
    """:returns: what a message tells of a value: how long it is where that is more than a matrix holds"""
    if isinstance(value, str) or not hasattr(value, "__len__") or len(value) <= _MOST_SHOWN:
        return value
    return f"an array of {len(value)} values"


def get(prim, name, time, fallback=None):
    """:returns: an attribute's value; the fallback where it is absent, blocked or without value"""
    attribute = prim.GetAttribute(name)
    value = attribute.Get(time) if attribute else None
    return fallback if value is None else value


def targets(prim, name):
    """:returns: paths that a relationship leads to; none where the prim has no such relationship"""
    return prim.GetRelationship(name).GetForwardedTargets() if prim.HasRelationship(name) else []


def sampled(times, values):
    """:returns: what `_patina` takes of values at these times"""
    return values[0] if len(values) == 1 else (list(times), values)


def number(context, prim, name, fallback, value=None):
    """:param value: where it was read already
    :returns: a finite float; the fallback, after a warning where something else is authored"""
    if value is None:
        value = get(prim, name, context.time)
    if value is None:
        return fallback
    if not isinstance(value, (int, float)) or not np.isfinite(value):
        context.warn(prim.GetPath(), name, "numberNotFinite", "the default" if fallback is None else fallback)
        return fallback
    return float(value)


def vector(context, prim, name, fallback, value=None):
    """The same for as many numbers as the fallback has, three without one; :returns: a tuple"""
    if value is None:
        value = get(prim, name, context.time)
    if value is None:
        return fallback
    count = 3 if fallback is None else len(fallback)
    numbers = finite(value, count, np.float32)
    if numbers is not None:
        return numbers
    used = "the default" if fallback is None else fallback
    if count == 3:
        context.warn(prim.GetPath(), name, "noThreeNumbers", used)
    else:
        context.warn(prim.GetPath(), name, "numbersUnfit", count, used)
    return fallback


def array_of(context, prim, name, components, dtype=np.float32):
    """:returns: an attribute's value as array() gives it"""
    return array(context, prim, name, get(prim, name, context.time), components, dtype)


def array(context, prim, name, value, components, dtype=np.float32):
    """:param value: of an attribute; its authored type may be any, whatever the schema says
    :returns: an array of elements x components (of elements alone for 1), without a copy where the
    type is the wanted one; empty, after a warning, when the value is none"""
    shape = (0, components) if components > 1 else (0,)
    if value is None:
        return np.zeros(shape, dtype)
    try:
        found = np.asarray(value)
        fits = found.dtype.kind in "fiu" and (found.ndim == 2 and found.shape[1] == components > 1 or
                                              found.ndim == 1 == components)
    except (TypeError, ValueError):
        found, fits = None, False
    if fits and dtype == np.int32 and found.dtype.kind == "f":
        fits = bool(np.isfinite(found).all())
    if not fits:
        if found is None or found.size:
            kind = "integers" if dtype == np.int32 else "numbers"
            context.warn(prim.GetPath(), name, "arrayUnusable", components, kind)
        return np.zeros(shape, dtype)
    return found.astype(dtype, copy=False)


class Fallbacks:
    """Values of inputs that nobody authored: those of the schemas. They follow from a prim's type and its API schemas. Asking
    each light for each of them takes most of the time of reading many lights."""

    def __init__(self):
        self._prim, self._names, self._key, self._known = None, (), None, {}

    def is_authored(self, prim, name):
        """:returns: whether the prim, the last one or another, has an opinion about an input, by its name or its older name"""
        if self._prim != prim:
            self._prim, self._names = prim, frozenset(prim.GetAuthoredPropertyNames())
            self._key = (prim.GetTypeName(), tuple(prim.GetAppliedSchemas()))
        return "inputs:" + name in self._names or name in self._names

    def of(self, name, attribute_of):
        """Of the prim that is_authored() was asked about.

        :param attribute_of: gives the attribute, or None; called where the value is not known yet"""
        key = (self._key, name)
        if key not in self._known:
            attribute = attribute_of()
            self._known[key] = attribute.Get() if attribute else None
        return self._known[key]


class Guard:
    """Turns an error while one prim is read into a warning: one broken prim is not drawn, the rest is. Without a prim that is
    needed there is nothing to render: then it becomes a StageError."""

    def __init__(self, context, prim, needed=False):
        self.context, self.prim, self.needed = context, prim, needed

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        if kind is None or not issubclass(kind, Exception):
            return False
        text = "there is not enough memory for it" if issubclass(kind, MemoryError) else one_line(error)[:300]
        if self.needed:
            raise StageError(f"{self.prim.GetPath()} cannot be read: {text}") from error
        self.context.warn(self.prim.GetPath(), "", "primUnreadable", text)
        return True
