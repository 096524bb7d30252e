# SPDX-License-Identifier: Apache-2.0
"""Warnings by their causes, worst first.

A cause is the kind of a message and its culprit: the file, prim, node or type that the message names, or where it names none
the input that it is about. How often comes with the first prim that it was met at. The order is:

  missing  something that was authored is missing from the result: a prim, a light, a texture, a material, a file; a fallback
           stands in its place
  changed  everything is there, but not all as authored: a default or an approximation is used

and within each what was met most often first. All of them are warnings: the command goes on. An error is what ends it.
"""
import re

from patina.cli.advice import advice

MAX_CAUSES = 20  # causes on the terminal; all of them are in --json
SEVERITIES = ("missing", "changed")

_LOOKED_AT = 2000  # characters of a message: names in it may have a million, and patterns try each place
_SHOWN = 2000      # characters of a line on the terminal; --json has all

# Words of messages where something is missing.
_MISSING = re.compile(
    r"not drawn|nothing is drawn|not written|not read\b|not found|not readable|not shaped by|"
    r"is left out|are left out|left out$|left out with|cannot be|cannot read|could not|"
    r"does not exist|do not exist|there is no |there are none|is missing|holds no |"
    r"no file is given|gives no light|is off$|the light is off|"
    r"magenta,? is shown|black is shown|displayColor is shown|can be shown|emits the same everywhere|failed|Failed|"
    r"path tracer renders instead", re.IGNORECASE)
_QUOTED = re.compile(r"'[^']*'|\"[^\"]*\"|@[^@]+@|<[^>]+>")
_PATH = re.compile(r"(?<![\w'\"@<])[^\s'\",;()]*(?:/[^\s'\",;()]+|\.(?:[A-Za-z][A-Za-z0-9]{1,4}))(?![\w])")
_TYPE = re.compile(r"\bND_\w+|\btype \w+")
_NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.]*\w)", re.IGNORECASE)


def severity(warning):
    """:returns: `missing` or `changed`"""
    return SEVERITIES[0] if _MISSING.search(warning["message"][:_LOOKED_AT]) else SEVERITIES[1]


def cause(warning):
    """:returns: (kind, culprit) of a warning; messages that differ in numbers alone are of one kind"""
    message, found = warning["message"][:_LOOKED_AT], []
    if len(warning["prim"]) > 1:
        message = message.replace(warning["prim"], "it")

    def keep(match):
        text = match.group().strip("'\"@<>")
        if text and text not in found:
            found.append(text)
        return "..."

    kind = message
    for pattern in (_QUOTED, _PATH, _TYPE):
        kind = pattern.sub(keep, kind)
    kind = _NUMBER.sub("N", kind)
    return kind, ", ".join(found) or _leaf(warning["input"])


def _leaf(name):
    """:returns: an input without the names of nodes and namespaces before it"""
    return re.split(r"[.:/]", name)[-1]


class Causes:
    """Groups of warnings. Warnings are dicts of prim, input, message and count, as the scene gives them."""

    def __init__(self, warnings):
        groups = {}
        for warning in warnings:
            kind, culprit = cause(warning)
            group = groups.get((kind, culprit))
            if group is None:
                group = groups[kind, culprit] = {
                    "severity": severity(warning), "message": warning["message"], "culprit": culprit, "kind": kind,
                    "advice": plain(advice(warning["message"][:_LOOKED_AT])),
                    "prim": warning["prim"], "input": warning["input"], "count": 0, "prims": 0, "_prims": set()}
            group["count"] += warning["count"]
            group["_prims"].add(warning["prim"])
        for group in groups.values():
            group["prims"] = len(group.pop("_prims"))
        self.groups = sorted(groups.values(), key=lambda g: (SEVERITIES.index(g["severity"]), -g["count"]))

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
        return sorted(merged, key=lambda g: (SEVERITIES.index(g["severity"]), -g["count"]))

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
    where = group["prim"] + ("." + group["input"] if group["input"] else "")
    text = printable(_cut("warning: " + (where + ": " if where else "") + group["message"]))
    if group.get("alike", 1) > 1:
        return f"{text} (and {group['alike'] - 1} causes like it: {group['count']} times{', all in --json' if json else ''})"
    if group["count"] == 1:
        return text
    others = f"at {group['prims']} prims, first this" if group["prims"] > 1 else "at this prim"
    return f"{text} ({group['count']} times {others})"
