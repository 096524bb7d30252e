"""Frame specs and image names, as usdrecord understands them."""
import math
import re

from patina.cli.errors import CommandError, UsageError

FRAMESPEC_HELP = (
    "time codes to render: a number, START:END or START:ENDxSTRIDE, several of them separated by commas, as in "
    "1,5:8,10:20x2,1:2x0.5; STARTTIME and ENDTIME stand for the stage's own (STARTTIME:ENDTIME). The image's name "
    "then holds the frame's place as #: image.####.png or image.###.##.png")
MAX_FRAMES = 1000000
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_PLACE = re.compile(r"#+(\.#+)?")


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
        raise UsageError(f"patina record: --frames {spec}: '{text}' is no frame")
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
            raise UsageError(f"patina record: --frames {spec}: a stride of {step} leads nowhere")
        stride = math.copysign(stride, b - a)
        steps = (b - a) / stride  # infinite where the stride is tiny
        count = int(math.floor(steps + 1e-6)) + 1 if steps < MAX_FRAMES else MAX_FRAMES + 1
        if len(frames) + count > MAX_FRAMES:
            raise UsageError(f"patina record: --frames {spec} means more than {MAX_FRAMES} frames")
        frames += [a + i * stride for i in range(count)]
        decimals = max([decimals] + [_decimals(text) for text in (first, last if colon else "", step)])
    return frames, decimals


def image_name(pattern, frame, decimals):
    """:returns: the pattern with the frame in the place of its hashes"""
    match = _PLACE.search(pattern)
    place = match.group(0)
    precision = len(place.partition(".")[2])
    if precision < decimals:
        raise UsageError(f"patina record: the frames have {decimals} decimals, but {pattern} has room for {precision} "
                         "(write ###.##)")
    text = f"{frame:0{len(place)}.{precision}f}"
    return pattern[:match.start()] + text + pattern[match.end():]


def has_place(pattern):
    """:returns: whether an image's name has exactly one place for a frame"""
    return len(_PLACE.findall(pattern)) == 1


def plan(arguments, stage):
    """:returns: list of (time code or None for the default time, image path)"""
    pattern = arguments.image
    if not arguments.frames:
        if has_place(pattern):
            raise UsageError(f"patina record: {pattern} has a place for frames, but there is no --frames")
        return [(None if arguments.defaultTime else stage.GetStartTimeCode(), pattern)]
    frames, decimals = expand(arguments.frames, stage.GetStartTimeCode(), stage.GetEndTimeCode())
    if len(frames) == 1 and not has_place(pattern):
        return [(frames[0], pattern)]
    if not has_place(pattern):
        raise UsageError(f"patina record: several frames need one place in the image's name: image.###.png "
                         f"instead of {pattern}")
    named = [(frame, image_name(pattern, frame, decimals)) for frame in frames]
    if len({image for _, image in named}) != len(named):
        raise CommandError(f"two frames of {arguments.frames} would be written to the same image")
    return named
