"""What every part of the reader needs: the stage, the time, the edit, and caches."""
from pxr import Gf, Usd, UsdGeom

MOST_MOTION_SAMPLES = 16


class Context:
    """One reading of a stage."""

    def __init__(self, stage, edit, options):
        self.stage, self.edit, self.options = stage, edit, options
        self.time = Usd.TimeCode.Default() if options.frame is None else Usd.TimeCode(options.frame)
        self.shutter = (0.0, 0.0)
        self.purposes = set(options.purposes) | {"default"}
        self.time_codes_per_second = stage.GetTimeCodesPerSecond() or 24.0
        self.counts = {}
        self.notes = []
        self._xforms = {}

    def warn(self, prim, input_, message):
        self.edit.warn(str(prim), input_, message)

    def count(self, kind, number=1):
        self.counts[kind] = self.counts.get(kind, 0) + number

    @property
    def moving(self):
        """Whether things move while the shutter is open."""
        return not self.time.IsDefault() and self.shutter[1] > self.shutter[0]

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

    def motion_offsets(self, samples):
        """When to evaluate what has these time samples: the ends of the shutter and what is between.

        :param samples: authored time codes inside the shutter
        :returns: ascending times relative to the frame"""
        frame, (start, end) = self.time.GetValue(), self.shutter
        inside = sorted({float(s) - frame for s in samples if start < float(s) - frame < end})
        if len(inside) > MOST_MOTION_SAMPLES - 2:
            step = (end - start) / (MOST_MOTION_SAMPLES - 1)
            inside = [start + step * i for i in range(1, MOST_MOTION_SAMPLES - 1)]
        return [start, *inside, end]

    def attribute_offsets(self, attribute):
        """:returns: motion_offsets() of an attribute, or [0] when it does not move in the shutter"""
        if not self.moving or not attribute or not attribute.ValueMightBeTimeVarying():
            return [0.0]
        return self.motion_offsets(attribute.GetTimeSamplesInInterval(self.shutter_interval()))


def get(prim, name, time, fallback=None):
    """:returns: an attribute's value; the fallback where it is absent, blocked or without value"""
    attribute = prim.GetAttribute(name)
    value = attribute.Get(time) if attribute else None
    return fallback if value is None else value
