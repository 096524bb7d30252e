# SPDX-License-Identifier: Apache-2.0
"""Frame specs as usdrecord understands them, and image names with a place for the frame as usdrecord, husk and printf have
it."""
import math
import os
import re

from patina.cli.errors import CommandError, UsageError

FRAMESPEC_HELP = (
    "time codes to render: a number, START:END or START:ENDxSTRIDE, several of them separated by commas, as in "
    "1,5:8,10:20x2,1:2x0.5; STARTTIME and ENDTIME stand for the stage's own (STARTTIME:ENDTIME). The image's name "
    "then holds the frame's place: image.####.png, image.###.##.png, image.<F4>.png or image.%%04d.png")
MAX_FRAMES = 1000000
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
# ####, ###.##, <F4>, <F>, %04d, %4d, %d; not %20d: %20 is a space in names that come from addresses.
_PLACE = re.compile(r"#+(?:\.(?P<decimals>#+))?|<F(?P<digits>\d{0,2})>|%(?P<zeros>0\d{0,2}|\d?)d")


def _decimals(text):
    """:returns: how many decimals a number is written with"""
    return len(text.partition(".")[2]) if "." in text else 0


def _number(text, spec, start, end):
    names = {"STARTTIME": start, "ENDTIME": end, "START": start, "END": end}
    name = text.strip().lstrip("@")
    value = names.get(name)
    if value is None:
        value = float(name) if _NUMBER.fullmatch(name) else math.nan
    if not math.isfinite(value):
        raise UsageError(f"patina: --frames {spec}: '{text}' is no frame")
    return value


def expand(spec, start, end):
    """:param start, end: the stage's own time codes
    :returns: list of time codes, and how many decimals tell them apart"""
    frames, decimals = [], 0
    for part in spec.split(","):
        first, colon, rest = part.partition(":")
        # ENDTIME holds no lower-case x
        last, cross, step = rest.partition("x") if colon else (first, "", "")
        a, b = _number(first, spec, start, end), _number(last, spec, start, end)
        stride = _number(step, spec, start, end) if cross else 1.0
        if not stride or not math.isfinite(stride):
            raise UsageError(f"patina: --frames {spec}: a stride of {step} reaches no frame")
        stride = math.copysign(stride, b - a)
        steps = (b - a) / stride  # infinite where the stride is tiny
        count = int(math.floor(steps + 1e-6)) + 1 if steps < MAX_FRAMES else MAX_FRAMES + 1
        if len(frames) + count > MAX_FRAMES:
            raise UsageError(f"patina: --frames {spec} means more than {MAX_FRAMES} frames")
        frames += [a + i * stride for i in range(count)]
        decimals = max([decimals] + [_decimals(text) for text in (first, last if colon else "", step)])
    return frames, decimals


def _places(pattern):
    """:returns: matches of the places for a frame: those in the file's own name; where it has none, those in its folders,
        unless such a folder is there"""
    own = pattern.rfind("/") + 1
    found = list(_PLACE.finditer(pattern, own))
    if found or os.path.isdir(pattern[:own]):
        return found
    return list(_PLACE.finditer(pattern, 0, own))


def image_name(pattern, frame, decimals):
    """:returns: the pattern, which has a place, with the frame in it"""
    match = _places(pattern)[0]
    precision = len(match["decimals"] or "")
    if precision < decimals:
        raise UsageError(f"patina: the frames have {decimals} decimals, but {pattern} has room for {precision} "
                         "(write ###.##)")
    if match["zeros"] is not None:
        text = f"%{match['zeros']}d" % round(frame)
    elif match["digits"] is not None:
        text = f"{round(frame):0{int(match['digits'] or 1)}d}"
    else:
        text = f"{frame:0{len(match.group(0))}.{precision}f}"
    return pattern[:match.start()] + text + pattern[match.end():]


def has_place(pattern):
    """:returns: whether an image's name has exactly one place for a frame"""
    return len(_places(pattern)) == 1


def named(pattern, frame, decimals):
    """:returns: a name for a frame: the pattern itself where it has no place"""
    return image_name(pattern, frame, decimals) if frame is not None and has_place(pattern) else pattern


def spec_of(frames):
    """:returns: the shortest spec of steps that means these time codes, in their order"""
    def text(number):
        return f"{number:.6f}".rstrip("0").rstrip(".")

    parts, at = [], 0
    while at < len(frames):
        end, step = at + 1, frames[at + 1] - frames[at] if at + 1 < len(frames) else 1.0
        while end < len(frames) and abs(frames[end] - frames[end - 1] - step) < 1e-6:
            end += 1
        if end - at < 3:
            end = at + 1
        stride = "" if abs(step) == 1.0 else f"x{text(abs(step))}"
        parts.append(text(frames[at]) + (f":{text(frames[end - 1])}{stride}" if end - at > 1 else ""))
        at = end
    return ",".join(parts)


def times(arguments, stage):
    """:returns: list of time codes (None for the default time), and how many decimals tell them apart"""
    if not arguments.frames:
        return [None if arguments.defaultTime else stage.GetStartTimeCode()], 0
    return expand(arguments.frames, stage.GetStartTimeCode(), stage.GetEndTimeCode())


def plan(arguments, stage):
    """:returns: list of (time code or None for the default time, image path)"""
    pattern = arguments.image
    if not arguments.frames:
        if has_place(pattern):
            raise UsageError(f"patina record: {pattern} has a place for frames, but there is no --frames")
        return [(None if arguments.defaultTime else stage.GetStartTimeCode(), pattern)]
    frames, decimals = times(arguments, stage)
    if len(frames) == 1 and not has_place(pattern):
        return [(frames[0], pattern)]
    if not has_place(pattern):
        raise UsageError(f"patina record: several frames need one place in the image's name: image.###.png "
                         f"instead of {pattern}")
    made = [(frame, image_name(pattern, frame, decimals)) for frame in frames]
    if len({image for _, image in made}) != len(made):
        raise CommandError(f"two frames of {arguments.frames} would be written to the same image")
    return made
