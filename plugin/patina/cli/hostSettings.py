# SPDX-License-Identifier: Apache-2.0
"""The render settings that programs with an OpenUSD inside show in panels of their own."""
import re

from patina.cli import settingFlags

_TYPES = {"bool": "bool", "int": "int", "uint32_t": "int", "float": "float", "double": "float", "std::string": "string"}
_DEFAULTS = {"bool": lambda text: text == "true", "int": int, "float": lambda text: float(text.rstrip("f")),
             "string": lambda text: text.strip('"')}
# What decides how a host draws, and no setting of the renderer.
_OWN = [
    {"key": "viewportBackend", "type": "string", "label": "Viewport", "choices": ["interactive", "raster", "embree"],
     "default": "interactive", "min": None, "max": None,
     "help": "rasterizer first, then path tracer; the rasterizer alone; the path tracer alone"},
    {"key": "denoise", "type": "bool", "label": "Denoise", "choices": [], "default": False, "min": None, "max": None,
     "help": "by Open Image Denoise, where it is found"},
    {"key": "albedoPass", "type": "bool", "label": "Albedo", "choices": [], "default": False, "min": None, "max": None,
     "help": "the pass Albedo: the colour of the surfaces"},
]


def shown():
    """:returns: list of dicts: what hosts show, of settings.def and of their own"""
    found = []
    for name, row in settingFlags.table().items():
        if "label" not in row.words or name == "interactive":
            continue
        kind = _TYPES[row.values[0]]
        default = _DEFAULTS[kind](row.values[2])
        low, high = row.words.get("range", [None, None])
        if "also" in row.words and low is not None:
            low = min(low, row.words["also"][0])
        most = 2**31 - 1 if kind == "int" else 1e30
        help_text = row.words.get("flag", ["", ""])[1]
        found.append({"key": name, "type": kind, "label": row.words["label"][0], "default": default,
                      "choices": row.words["choices"][0].split() if "choices" in row.words else [],
                      "min": low, "max": min(high, most) if high is not None else None,
                      "help": re.sub(r"\s*\(default:.*$", "", help_text, flags=re.DOTALL)})
    return found + _OWN
