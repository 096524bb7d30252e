# SPDX-License-Identifier: Apache-2.0
"""The sliders of a page: one entry per live input, as JSON that a user may replace.

  {"controls": [{"input": "NODE.NAME", "label": TEXT, "folder": TEXT, "kind": "color" | "number" | "switch",
                 "min": N, "max": N, "step": N, "default": [N...], "unit": TEXT},
                {"input": "NODE.NAME", "label": TEXT, "folder": TEXT, "kind": "choice", "options": [TEXT...],
                 "default": TEXT}],
   "presets": [{"name": TEXT, "values": {"NODE.NAME": [N...] | TEXT}}],
   "sentences": {MATERIAL: TEXT}, "title": TEXT}
"""
import json
import math

from patina import inputs
from patina.cli.errors import CommandError

# Beginnings and ends of names, with the range that a slider has at least, and a unit.
_RANGES = (
    (("thin_film_thickness", "thinfilm_thickness"), (0.0, 1500.0), "nm"),
    (("film_thickness",), (0.0, 1500.0), "nm"),
    (("ior", "IOR", "thin_film_ior"), (1.0, 3.0), ""),
    (("exponent",), (1.0, 500.0), ""),
    (("anisotropy",), (-1.0, 1.0), ""),
    (("temperature",), (1000.0, 10000.0), "K"),
    (("rotation", "rotate"), (0.0, 1.0), ""),
    (("extinction",), (0.0, 8.0), ""),
    (("octaves",), (1.0, 8.0), ""),
    (("luminance", "intensity"), (0.0, 10.0), ""),
)
_NO_COLORS = ("ior", "extinction", "radius", "scale", "depth", "exponent")
_LARGEST_NUMBER = 1e300  # whole numbers of JSON have no end, those of a page do
_COUNTS = {"color": 3, "switch": 1}  # of the numbers that such a control moves
MAX_PRESETS = 1000  # each is a button


def _check(right, path, words):
    """:raises CommandError: where a file is not as it should be"""
    if not right:
        raise CommandError(f"--controls: {path}{words}")


def _range(name, values):
    low, high, unit = 0.0, 1.0, ""
    for names, (minimum, maximum), its_unit in _RANGES:
        if any(name.endswith(word) for word in names):
            low, high, unit = minimum, maximum, its_unit
            break
    for value in values:
        if value < low:
            low = 2.0 * value if value < 0.0 else 0.0
        if value > high:
            high = 10.0 ** math.ceil(math.log10(2.0 * value))
    return low, high, unit


def _folder(node):
    return node.rstrip("/").rpartition("/")[2].rpartition(":")[2]


def key(item):
    """:returns: what a page calls a live.LiveInput, a choices.Choice or a choices.Fixed"""
    return f"{item.node}.{item.name}"


def _entry(live):
    """:param live: a live.LiveInput"""
    values = [v if math.isfinite(v) else 0.0 for v in live.value]
    is_color = (live.kind.startswith("color") and min(values) >= 0.0 and max(values) <= 1.0
                and not any(word in live.name.lower() for word in _NO_COLORS))
    low, high, unit = _range(live.name, values)
    kind = "color" if is_color and len(values) == 3 else "switch" if live.kind == "boolean" else "number"
    return {"input": key(live), "label": live.name.replace("_", " "), "folder": _folder(live.node),
            "kind": kind, "min": low, "max": high, "step": 1.0 if live.kind == "integer" else 0.0, "default": values,
            "unit": unit}


def entries(inputs, choices, fixed):
    """The controls of a material's live inputs, its choices and what is fixed, node by node.

    :param choices: list of choices.Choice; fixed: of choices.Fixed
    """
    found = [(i.node, _entry(i)) for i in inputs]
    for c in choices:
        options = [text for text, _ in c.options]
        found.append((c.node, {"input": key(c), "label": c.name.replace("_", " "), "folder": _folder(c.node),
                               "kind": "choice", "options": options, "default": options[c.at]}))
    for f in fixed:
        found.append((f.node, {"input": key(f), "label": f.name.replace("_", " "),
                               "folder": _folder(f.node), "kind": "fixed", "default": f.text, "reason": f.reason}))
    order = {node: k for k, node in reversed(list(enumerate(node for node, _ in found)))}
    return [made for _, made in sorted(found, key=lambda pair: order[pair[0]])]


def _number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= _LARGEST_NUMBER


def _numbers(value, count):
    return isinstance(value, list) and len(value) == count and all(_number(v) for v in value)


# What a file may say of a control, and whether it is right.
_FIELDS = {**dict.fromkeys(("label", "folder", "unit"), lambda v: isinstance(v, str)),
           "kind": lambda v: v in ("color", "number", "switch"), **dict.fromkeys(("min", "max", "step"), _number)}


def read(path):
    """:returns: the JSON of a --controls file, not yet matched with a material"""
    try:
        inputs.note(path)
        found = json.loads(inputs.read(path).decode())
    except (OSError, UnicodeDecodeError) as error:
        raise CommandError(f"--controls: {path} cannot be read ({error})") from error
    except (ValueError, RecursionError) as error:
        raise CommandError(f"--controls: {path} is no JSON ({error})") from error
    _check(isinstance(found, dict) and all(isinstance(found.get(key, []), list) for key in ("controls", "presets")), path,
           " needs lists `controls` and `presets`")
    _check(len(found.get("presets", [])) <= MAX_PRESETS, path,
           f": `presets` holds more than the {MAX_PRESETS} that a page shows")
    texts = found.get("sentences", {})
    _check(isinstance(texts, dict) and all(isinstance(t, str) for t in [*texts.values(), found.get("title", "")]), path,
           ": `sentences` holds texts by material, `title` is a text")
    return found


def merged(entries, wanted, path):
    """The entries that a file names, in its order and with what it says; all of them where it has no list.

    :param wanted: what read() gave
    :returns: the entries, and inputs of the file that the materials at hand do not have
    """
    if "controls" not in wanted:
        return entries, []
    known = {entry["input"]: entry for entry in entries}
    result, unknown, seen = [], [], set()
    for item in wanted["controls"]:
        _check(isinstance(item, dict) and isinstance(item.get("input"), str), path, ": each control needs a text `input`")
        _check(item["input"] not in seen, path, f": `controls` has {item['input']} twice")
        seen.add(item["input"])
        if item["input"] not in known:
            unknown.append(item["input"])
            continue
        made = dict(known[item["input"]])
        if made["kind"] in ("choice", "fixed"):
            made.update({key: item[key] for key in ("label", "folder") if isinstance(item.get(key), str)})
            result.append(made)
            continue
        for key, test in _FIELDS.items():
            if key in item:
                _check(test(item[key]), path, f": `{key}` of {item['input']} is not what it should be")
                made[key] = item[key]
        count = len(made["default"])
        _check(_COUNTS.get(made["kind"], count) == count, path, f": `kind` of {item['input']} does not fit: a color has 3 "
               f"numbers, a switch has 1, this input has {count}")
        _check(made["min"] < made["max"], path, f": `min` of {item['input']} is not below `max`")
        result.append(made)
    return result, unknown


def presets(wanted, material, path):
    """The named sets of values of a file that fit a material."""
    sizes = {i["input"]: len(i["value"]) for i in material["inputs"]}
    options = {c["input"]: c["options"] for c in material["controls"] if c["kind"] == "choice"}
    found = []
    for item in wanted.get("presets", []):
        _check(isinstance(item, dict) and isinstance(item.get("name"), str) and isinstance(item.get("values"), dict), path,
               ": each preset needs a text `name` and an object `values`")
        values = {key: value for key, value in item["values"].items() if key in sizes or key in options}
        for key, value in values.items():
            about = f": preset {item['name']}: {key}"
            if key in options:
                _check(value in options[key], path, f"{about} is one of {', '.join(options[key])}")
            else:
                _check(_numbers(value, sizes[key]), path, f"{about} needs a list of {sizes[key]} numbers")
        if values:
            found.append({"name": item["name"], "values": values})
    return found
