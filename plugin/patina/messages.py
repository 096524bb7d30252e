# SPDX-License-Identifier: Apache-2.0
"""What there is to warn of: the rows of base/messages.def, and warnings made from them."""
import functools
from dataclasses import dataclass

from patina.cli import rows

SEVERITIES = ("missing", "changed")

_TABLE = "base/messages.def"


@dataclass(frozen=True)
class Row:
    area: str
    fields: tuple  # names
    severity: str
    advice: str  # Markdown
    text: str  # with fields in braces


@functools.lru_cache(maxsize=None)
def _advice():
    return {row.values[0]: row.text(1) for row in rows.read(_TABLE, "ADVICE")}


@functools.lru_cache(maxsize=None)
def table():
    """:returns: dict of id -> Row"""
    found, area = {}, ""
    for row in rows.read(_TABLE, "(?:AREA|MESSAGE)"):
        if len(row.values) == 1:
            area = row.text(0)
            continue
        name, fields, severity, advised = row.values[:4]
        found[name] = Row(area, tuple(fields.strip("()").replace(",", " ").split()), severity, _advice()[advised], row.text(4))
    return found


def advice(warning):
    """:returns: what to do, in Markdown: where a reason names a limit, that is what to raise"""
    if any("(--limit " in text for text in warning["fields"].values()):
        return _advice()["raiseLimit"]
    return table()[warning["id"]].advice


def place(warning):
    """:returns: what a warning is about: prim and input"""
    return warning["prim"] + ("." + warning["input"] if warning["input"] else "")


def warning(prim, input_, id_, *fields):
    """:param fields: in the order of the message's row
    :returns: a warning as those of a scene are"""
    row = table()[id_]
    if len(fields) != len(row.fields):
        raise ValueError(f"the message {id_} has other fields: {row.fields}")
    named = dict(zip(row.fields, map(str, fields)))
    return {"prim": str(prim), "input": str(input_), "id": id_, "message": row.text.format(**named), "fields": named,
            "count": 1}
