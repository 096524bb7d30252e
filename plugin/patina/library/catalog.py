# SPDX-License-Identifier: Apache-2.0
"""The documents of the library, one material each. A document tells of itself in its `surfacematerial`: title (`uiname`),
group (`uifolder`), and the sources of its numbers (`doc`)."""
import difflib
import functools
import os
import xml.etree.ElementTree
from dataclasses import dataclass

from patina.cli import rows
from patina.cli.errors import CommandError

PREFIX = "library:"
FOLDER = os.path.join(rows.ROOT, "materialNetwork", "library")
GROUPS = ("Metals", "Worked metals", "Glass and stones", "Plastics and ceramics", "Paints and lacquers", "Organic", "Cloth",
          "Hair")
STRANDS = ("Hair",)  # groups that are shown as hair; all others on a ball


@dataclass(frozen=True)
class Entry:
    name: str  # of the material, and of its document without extension
    title: str
    group: str
    source: str
    path: str


@functools.lru_cache(maxsize=None)
def entries():
    """:returns: tuple of Entry, by group and then by title; the groups stand as GROUPS has them"""
    found = [_entry(os.path.join(FOLDER, name)) for name in os.listdir(FOLDER) if name.endswith(".mtlx")]
    return tuple(sorted(found, key=lambda e: (GROUPS.index(e.group), e.title)))


def _entry(path):
    material = xml.etree.ElementTree.parse(path).getroot().find("surfacematerial")
    return Entry(material.get("name"), material.get("uiname"), material.get("uifolder"),
                 " ".join(material.get("doc").split()), path)


def path_of(name):
    """:returns: the document of a material of the library
    :raises CommandError: where there is none of this name"""
    for entry in entries():
        if entry.name == name:
            return entry.path
    names = [entry.name for entry in entries()]
    near = difflib.get_close_matches(name, names, 3, 0.4)
    raise CommandError(f"the library has no material {name}"
                       + (f" (did you mean {' or '.join(near)}?)" if near else f" (there are: {', '.join(names)})"))
