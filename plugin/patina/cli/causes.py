# SPDX-License-Identifier: Apache-2.0
"""Warnings by their causes, worst first.

A cause is a message of base/messages.def and its culprit: the file, prim, node or type that its fields name, or where they name
none the input that it is about. How often comes with the first prim that it was met at. The order is:

  missing  something that was authored is missing from the result: a prim, a light, a texture, a material, a file; a fallback
           stands in its place
  changed  everything is there, but not all as authored: a default or an approximation is used

and within each what was met most often first. All of them are warnings: the command goes on. An error is what ends it.
"""
import re

from patina import messages

MAX_CAUSES = 20  # causes on the terminal; all of them are in --json

_LOOKED_AT = 2000  # characters of a message: names in it may have a million, and patterns try each place
_SHOWN = 2000      # characters of a line on the terminal; --json has all

# Fields of messages that name what is wrong; all others say how.
_CULPRITS = frozenset("aov file filter graph grid input light material method mode model name node output path portal prim "
                      "purpose shader source space target type unit value".split())
# Names in reasons that libraries give.
_QUOTED = re.compile(r"'[^']*'|\"[^\"]*\"|@[^@]+@|<[^>]+>")
_PATH = re.compile(r"(?<![\w'\"@<])[^\s'\",;()]*(?:/[^\s'\",;()]+|\.(?:[A-Za-z][A-Za-z0-9]{1,4}))(?![\w])")
_NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.]*\w)", re.IGNORECASE)


def cause(warning):
    """:returns: (kind, culprit) of a warning; those that differ in numbers alone are of one kind"""
    found = []

    def keep(match):
        text = match.group().strip("'\"@<>")
        if text and text not in found:
            found.append(text)
        return "..."

    kind = warning["id"]
    for name, text in warning["fields"].items():
        text = text[:_LOOKED_AT]
        if len(warning["prim"]) > 1:
            text = text.replace(warning["prim"], "it")
        if name in _CULPRITS:
            found += [text] if text != "it" else []
        else:
            kind += ": " + _NUMBER.sub("N", _PATH.sub(keep, _QUOTED.sub(keep, text)))
    return kind, ", ".join(dict.fromkeys(found)) or _leaf(warning["input"])


def _leaf(name):
    """:returns: an input without the names of nodes and namespaces before it"""
    return re.split(r"[.:/]", name)[-1]


class Causes:
    """Groups of warnings, which are dicts as Scene.warnings() and messages.warning() give them."""

    def __init__(self, warnings):
        groups = {}
        for warning in warnings:
            kind, culprit = cause(warning)
            group = groups.get((kind, culprit))
            if group is None:
                row = messages.table()[warning["id"]]
                group = groups[kind, culprit] = {
                    "severity": row.severity, "id": warning["id"], "message": warning["message"], "culprit": culprit,
                    "kind": kind, "advice": plain(messages.advice(warning)),
                    "prim": warning["prim"], "input": warning["input"], "count": 0, "prims": 0, "_prims": set()}
            group["count"] += warning["count"]
            group["_prims"].add(warning["prim"])
        for group in groups.values():
            group["prims"] = len(group.pop("_prims"))
        self.groups = sorted(groups.values(), key=lambda g: (messages.SEVERITIES.index(g["severity"]), -g["count"]))

    def __len__(self):
        return len(self.groups)

    def _shown(self):
        """:returns: the groups; where they are too many for a terminal, culprits of one kind count as one"""
        if len(self.groups) <= MAX_CAUSES:
            return self.groups
        kinds = {}
        for group in self.groups:
            kinds.setdefault((group["severity"], group["kind"]), []).append(group)
        merged = [dict(alike[0], count=sum(g["count"] for g in alike), prims=sum(g["prims"] for g in alike), alike=len(alike))
                  for alike in kinds.values()]
        return sorted(merged, key=lambda g: (messages.SEVERITIES.index(g["severity"]), -g["count"]))

    def lines(self, reported=None, last=True, json=True):
        """:param reported: dict that remembers what was shown before, which is not shown again ...
        :param last: ... unless this is the last call, and it was met more often since
        :param json: whether the command has a --json that holds them all
        :returns: lines of at most MAX_CAUSES causes for all calls with the same dict; the last call says how many more"""
        reported = {} if reported is None else reported
        out, hidden = [], 0
        for group in self._shown():
            key = group["severity"], group["message"], group["prim"], group["input"]
            if key not in reported and len(reported) >= MAX_CAUSES:
                hidden += 1
            elif key not in reported or (last and group["count"] > reported[key]):
                reported[key] = group["count"]
                out.append(line(group, json))
        if hidden and last:
            out.append(f"warning: {hidden} more causes" + (" are in --json" if json else ""))
        return out


def plain(markdown):
    """:returns: text without links and code marks"""
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", markdown).replace("`", "")


def printable(text):
    """:returns: text that stays in its line: names of a document may hold line breaks and a terminal's commands"""
    # A match begins where blanks begin: with each place inside a run looked at, its length would count squared.
    text = re.sub(r"(?<!\s)\s*[\r\n]+\s*", " ", text)
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)


def _cut(text):
    """:returns: text without the middle of a long one: its ends say where it is met and what follows"""
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN // 2]} ... {text[-_SHOWN // 2:]}"


def line(group, json=True):
    """:returns: a group as one line"""
    where = messages.place(group)
    text = printable(_cut("warning: " + (where + ": " if where else "") + group["message"]))
    if group.get("alike", 1) > 1:
        return f"{text} (and {group['alike'] - 1} causes like it: {group['count']} times{', all in --json' if json else ''})"
    if group["count"] == 1:
        return text
    others = f"at {group['prims']} prims, first this" if group["prims"] > 1 else "at this prim"
    return f"{text} ({group['count']} times {others})"
