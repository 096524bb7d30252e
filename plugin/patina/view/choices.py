# SPDX-License-Identifier: Apache-2.0
"""Inputs that no slider can move: each value that they may have is a program of its own, made
beforehand while there are few; what is left is shown as fixed, with the reason."""
import collections
import itertools
import os

from patina.cli.compiled import _patina
from patina.view import live

MAX_PROGRAMS = 24  # of a material
OFF_ON = (("off", 0), ("on", 1))
_WRAPS = ("constant", "clamp", "periodic", "mirror")
_USD_WRAPS = ("useMetadata", "black", "clamp", "repeat", "mirror")
# Values that MaterialX and UsdPreviewSurface let an input have, where the node itself has no list.
_TEXTS = {"space": ("object", "world"),
          "uaddressmode": _WRAPS, "vaddressmode": _WRAPS, "filtertype": ("closest", "linear", "cubic"),
          "wrapS": _USD_WRAPS, "wrapT": _USD_WRAPS, "sourceColorSpace": ("auto", "raw", "sRGB")}
_NUMBERS = {"opacityMode": (("transparent", 0), ("presence", 1)), "useSpecularWorkflow": OFF_ON,
            "style": (("distance", 0), ("solid", 1))}
_REASONS = {"filename": "the page holds the image of this file alone",
            "string": "what it may say is not known",
            "integer": "it shapes the program, and its range is not known",
            "matrix33": "matrices have no sliders", "matrix44": "matrices have no sliders"}


# An input with a list of values; `at` is the place of the authored one. An input that stays, and why.
Choice = collections.namedtuple("Choice", "node node_id name kind options at authored")
Fixed = collections.namedtuple("Fixed", "node name text reason")


def _options(name, kind, words):
    if kind == "boolean":
        return OFF_ON
    if kind == "integer":
        return _NUMBERS.get(name, ())
    return tuple((text, text) for text in words.get(name) or _TEXTS.get(name, ()))


def _plain(kind, value):
    """An authored value as options have it."""
    if kind in ("boolean", "integer"):
        try:
            return int(value[0] if isinstance(value, (list, tuple)) else value)
        except (IndexError, OverflowError, TypeError, ValueError):  # a word, or not finite
            return str(value)
    return value if isinstance(value, str) else str(value)


def find(network, live_inputs):
    """:returns: the Choices and the Fixed inputs of the nodes below the surface, without the live ones"""
    moved = {(i.node, i.name) for i in live_inputs}
    choices, fixed = [], []
    for node in live.reachable(network):
        defaults, words = _patina.node_defaults(node["id"]), _patina.node_words(node["id"])
        for name, kind in _patina.node_inputs(node["id"]).items():
            if kind not in ("boolean", *_REASONS) or name in node["connections"] or (node["path"], name) in moved:
                continue
            authored = node["inputs"].get(name)
            if authored is None and name not in defaults:
                continue
            value = _plain(kind, authored["value"] if authored else defaults[name]) if "matrix" not in kind else ""
            options = _options(name, kind, words)
            if options:
                if value not in [v for _, v in options]:
                    options = ((str(value) or "(empty)", value), *options)
                at = [v for _, v in options].index(value)
                choices.append(Choice(node["path"], node["id"], name, kind, options, at, authored is not None))
            elif authored is not None:
                text = os.path.basename(value) if kind == "filename" else str(value)
                fixed.append(Fixed(node["path"], name, text, _REASONS[kind]))
    return choices, fixed


def with_choices(network, choices, picked):
    """A copy of the network with choices[i] at its option picked[i]."""
    copy = live.with_live(network, [], [])
    for choice, at in zip(choices, picked):
        if at != choice.at:
            copy.set_input(choice.node, choice.name, choice.kind, choice.options[at][1])
    return copy


def combinations(choices):
    """The states made beforehand: the authored one first, then each change alone, then changes together.

    :returns: lists of one place per choice, and the choices for which there was no room
    """
    start = tuple(choice.at for choice in choices)
    made, left = [start], []
    ranked = sorted(range(len(choices)), key=lambda i: (not choices[i].authored, i))
    for i in ranked:
        more = [start[:i] + (k,) + start[i + 1:] for k in range(len(choices[i].options)) if k != choices[i].at]
        if len(made) + len(more) > MAX_PROGRAMS:
            left.append(i)
        else:
            made += more
    open_ones = [i for i in range(len(choices)) if i not in left]
    every = itertools.product(*[range(len(c.options)) if i in open_ones else (c.at,) for i, c in enumerate(choices)])
    for picked in itertools.islice(every, 4 * MAX_PROGRAMS):
        if len(made) < MAX_PROGRAMS and picked not in made:
            made.append(picked)
    return made, left
