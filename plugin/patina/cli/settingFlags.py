# SPDX-License-Identifier: Apache-2.0
"""Flags of render settings, made from the rows of hdDelegate/scene/settings.def."""
import math
import re

from patina.cli import rows

TABLE = "hdDelegate/scene/settings.def"
FLAG_WORDS = ("flag", "flagOn", "flagOff")
_WHOLE = {"int": 2**31 - 1, "uint32_t": 2**32 - 1}  # types of whole numbers, with the largest


def table():
    """:returns: dict of name -> rows.Row"""
    return {row.values[1]: row for row in rows.read(TABLE, "SETTING")}


def names():
    """:returns: of the settings that have a flag; the parsed arguments have them as attributes"""
    return [name for name, row in table().items() if any(word in row.words for word in FLAG_WORDS)]


def of_resumed_renders():
    """:returns: names of settings that may differ between the halves of a render"""
    return [name for name, row in table().items() if "resumes" in row.words]


def add(group, title, texts, after=None):
    """Adds all flags of a group.

    :param texts: dict of what {NAMES} in helps stand for
    :param after: dict of setting -> function(group) that adds flags which are no settings behind it
    """
    for name in names():
        row = table()[name]
        if row.words.get("group", ["the render"])[0] == title:
            add_one(group, name, texts)
            (after or {}).get(name, lambda group: None)(group)


def add_one(group, name, texts=None):
    row = table()[name]
    if "flag" not in row.words:
        _add_switch(group, name, row)
        return
    metavar, text = row.words["flag"]
    text = text.format(**texts) if texts else text
    keywords = {"choices": row.words["choices"][0].split()} if "choices" in row.words else {
        "type": _size_parser(row) if "flagSize" in row.words else _parser(row)}
    group.add_argument("--" + name, metavar=metavar, default=_default(row), help=text, **keywords)


def _add_switch(group, name, row):
    if "flagOn" in row.words and "flagOff" in row.words:
        group = group.add_mutually_exclusive_group()
    for word, action in (("flagOn", "store_true"), ("flagOff", "store_false")):
        if word in row.words:
            flag, text = row.words[word]
            group.add_argument(flag, dest=name, action=action, default=_default(row), help=text)


def _default(row):
    if "flagDefault" in row.words:
        return row.words["flagDefault"][0]
    kind, _, text = row.values
    if kind == "bool":
        return text == "true"
    if kind == "std::string":
        return text.strip('"')
    return int(text) if kind in _WHOLE else float(text.rstrip("f"))


def value_of(row, value):
    """:param value: of any type that holds it, such as an attribute's
    :returns: the value as a render setting
    :raises ValueError, TypeError: where the setting does not take it"""
    kind = row.values[0]
    if kind == "std::string":
        text = str(value)
        if "choices" in row.words and text not in row.words["choices"][0].split():
            raise ValueError(text)
        return text
    if kind == "bool":
        return bool(float(value))
    number = float(value)
    least, most = row.words.get("range", [0 if kind == "uint32_t" else -math.inf, math.inf])
    allowed = least <= number <= most or number in row.words.get("also", [])
    if not math.isfinite(number) or not allowed or (kind in _WHOLE and not (number == int(number) and number <= _WHOLE[kind])):
        raise ValueError(value)
    return int(number) if kind in _WHOLE else number


_UNITS = {"": 1.0, "MIB": 1.0, "GIB": 1024.0, "TIB": 1024.0**2, "MB": 1e6 / 2**20, "GB": 1e9 / 2**20, "TB": 1e12 / 2**20}


def _size_parser(row):
    """:returns: function of a text such as 4GiB, which gives MiB; as _parser else"""
    least = row.words["flagRange"][0]

    def parse(text):
        match = re.fullmatch(r"([0-9]*\.?[0-9]+)\s*([A-Za-z]*)", text.strip())
        value = float(match[1]) * _UNITS[match[2].upper()] if match and match[2].upper() in _UNITS else -1.0
        if not least <= value < math.inf:
            raise ValueError
        return value

    parse.__name__ = f"size ({least} MiB or more, such as 500MiB or 4GiB)"
    return parse


def _parser(row):
    """:returns: function of a text, named as argparse's message about a bad value shall call it"""
    if row.values[0] == "std::string":
        return str
    whole = _WHOLE.get(row.values[0])
    above = row.words.get("flagAbove", [None])[0]
    least, most = row.words.get("flagRange", row.words.get("range", [-math.inf, math.inf]))

    def parse(text):
        value = int(text) if whole else float(text)
        if not math.isfinite(value) or not least <= value <= (min(most, whole) if whole else most):
            raise ValueError
        if above is not None and not value > above:
            raise ValueError
        return value

    kind = "count" if whole and least == 1 else "whole number" if whole else "number"
    bounds = (f"above {above}" if above is not None else f"{least} or more" if most == math.inf else f"{least} to {most}")
    parse.__name__ = f"{kind} ({bounds})"
    return parse
