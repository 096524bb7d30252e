# SPDX-License-Identifier: Apache-2.0
"""Values of every type that USD's schemas have, as .usda writes them: ordinary ones, and the extremes."""
NUMBERS = (0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 1e-7, -1e-7, 1e-30, 1e-45, 1e6, 1e15, 1e30, 3.4028235e38, -3.4028235e38,
           float("inf"), float("-inf"), float("nan"), 16777217.0)
INTEGERS = (0, 1, 2, 3, 4, -1, 7, 255, 65536, 2**31 - 1, -2**31)
# Values that a stage may name: nothing, things that are no files, and files of the folder that damage has met.
ASSETS = ("", "missing.png", "/dev/zero", "/dev/stdin", "pipe", "folder", "damaged.png", "damaged.exr", "damaged.vdb",
          "damaged.ies",
          "damaged.mtlx", "zeros.png", "huge.png", "loop.usda", "../" * 40 + "etc/passwd", "x" * 300, "a<UDIM>.png",
          "small.png", "%s%n.png", "damaged.usdz[0/a.png]")
WORDS = ("", "st", "displayColor", "vertex", "faceVarying", "uniform", "constant", "none", "catmullClark",
         "</script><img src=x>", "PWND); discard; //", "ÿ𝛑", "a:b:c", "x" * 5000, "../..", "$(touch owned)", "%n%s")
SHAPES = {"2": 2, "3": 3, "4": 4}
TUPLES = {"point3": 3, "normal3": 3, "vector3": 3, "color3": 3, "color4": 4, "texCoord2": 2, "texCoord3": 3}
LENGTHS = (0, 1, 2, 3, 4, 5, 8, 13, 64)


def _number(random, small):
    if random.random() < (0.8 if small else 0.4):
        return random.choice((random.uniform(-2, 2), random.uniform(0, 1), float(random.randint(0, 4))))
    return random.choice(NUMBERS)


def _text(value):
    text = repr(float(value))
    return {"nan": "nan", "inf": "inf", "-inf": "-inf"}.get(text, text)


def _half(value):
    return value if abs(value) < 65504 or value != value else (65504.0 if value > 0 else -65504.0)


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def scalar(random, kind, allowed=(), small=False):
    """:param kind: the name of an Sdf type that is no array
    :param allowed: words of a token, which are taken nine times out of ten
    :param small: few extremes
    :returns: its text, or None for a type that is not known"""
    if kind == "bool":
        return random.choice(("true", "false"))
    if kind in ("int", "int64"):
        return str(random.choice(INTEGERS) if random.random() < 0.3 else random.randint(0, 6))
    if kind in ("uint", "uint64", "uchar"):
        return str(random.randint(0, 255))
    if kind in ("half", "float", "double", "timecode"):
        value = _number(random, small)
        return _text(_half(value) if kind == "half" else value)
    if kind in ("token", "string"):
        return quoted(random.choice(allowed) if allowed and random.random() < 0.9 else random.choice(WORDS))
    if kind == "asset":
        return "@" + random.choice(ASSETS) + "@"
    if kind == "frame4d" or kind.startswith("matrix"):
        size = 4 if kind == "frame4d" else int(kind[6])
        plain = random.random() < 0.7
        rows = [[float(i == k) if plain else _number(random, True) for k in range(size)] for i in range(size)]
        return "(" + ", ".join("(" + ", ".join(map(_text, row)) + ")" for row in rows) + ")"
    if kind.startswith("quat"):
        return "(" + ", ".join(_text(_half(_number(random, True))) for _ in range(4)) + ")"
    base = kind.rstrip("fdhi")
    count = TUPLES.get(base) or (SHAPES.get(base[-1:]) if base[:-1] in ("float", "double", "half", "int") else None)
    if not count:
        return None
    whole = base.startswith("int")
    half = kind.endswith("h") or base.startswith("half")
    parts = [scalar(random, "int" if whole else "half" if half else "float", small=small) for _ in range(count)]
    return "(" + ", ".join(parts) + ")"


def value(random, kind, allowed=(), small=False):
    """:returns: the text of a value, or None for a type that is not known"""
    if not kind.endswith("[]"):
        return scalar(random, kind, allowed, small)
    parts = [scalar(random, kind[:-2], allowed, small) for _ in range(random.choice(LENGTHS))]
    return None if None in parts else "[" + ", ".join(parts) + "]"
