# SPDX-License-Identifier: Apache-2.0
"""Rooms include only those that ARCHITECTURE.md says they may: its table and its diagram are read, and every C++ include."""
import os
import re

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
FOLDERS = ("base", "shaders", "materialNetwork", "hdDelegate", "plugin", "testenv")
# What shaders/gpuStruct.inc includes is named by a macro.
INCLUDE = re.compile(r'^\s*#\s*(?:include\s+["<]|define\s+PATINA_FIELDS\s+")([^">]+)[">]', re.MULTILINE)
PUBLIC = 16  # headers of a room that other rooms include, or two for each of its folders if these are more
USD = ("hdDelegate/hydra/", "plugin/hydra/", "testenv/hydra/")  # the only C++ that includes pxr/


def section():
    """:returns: the text of ARCHITECTURE.md about rooms"""
    with open(os.path.join(ROOT, "ARCHITECTURE.md"), encoding="utf-8") as file:
        return file.read().split("## Rooms", 1)[1].split("\n## ", 1)[0]


def rooms(text):
    """:returns: room -> rooms that it includes, from rows of a table: | `room` | what it holds | `room`, `room` |"""
    rows = re.findall(r"^\| `([\w/.]+)` \|[^|\n]*\|([^|\n]*)\|$", text, re.MULTILINE)
    return {name: set(re.findall(r"`([\w/.]+)`", includes)) for name, includes in rows}


def diagram(text):
    """:returns: room -> rooms that its arrows point to, from a Mermaid diagram: id["room"], id --> id & id"""
    body = text.split("```mermaid", 1)[1].split("```", 1)[0]
    names = dict(re.findall(r'(\w+)\["([\w/.]+)"\]', body))
    arrows = {name: set() for name in names.values()}
    for source, targets in re.findall(r"^\s*(\w+) --> ([\w &]+)$", body, re.MULTILINE):
        arrows[names[source]] |= {names[target.strip()] for target in targets.split("&")}
    return arrows


def includes():
    """:returns: (file, included) of all C++ but that of tests/ folders, which may look into other rooms; <pxr/...> too"""
    found = []
    for top in FOLDERS:
        for folder, folders, names in os.walk(os.path.join(ROOT, top)):
            folders[:] = [name for name in folders if name not in ("tests", "node_modules")]
            for name in names:
                if not name.endswith((".h", ".cpp")):
                    continue
                path = os.path.join(folder, name)
                with open(path, encoding="utf-8") as file:
                    for target in INCLUDE.findall(file.read()):
                        found.append((os.path.relpath(path, ROOT).replace(os.sep, "/"), target))
    return found


def room_of(path, known):
    """:returns: the room that a file is in, None for a file of another project or a path relative to its own folder"""
    held = [room for room in known if path == room or path.startswith(room + "/")]
    return max(held, key=len) if held else None


def reachable(arrows, start):
    found, left = set(), [start]
    while left:
        for room in arrows[left.pop()] - found:
            found.add(room)
            left.append(room)
    return found


def test_every_include_is_an_arrow_of_the_table_and_every_arrow_is_there():
    known = rooms(section())
    assert len(known) >= 12
    met = {name: set() for name in known}
    for path, target in includes():
        source, to = room_of(path, known), room_of(target, known)
        if path.startswith("testenv/fuzz/targets/"):  # as tests, they may look into any room
            continue
        if path.startswith("testenv/"):  # hosts of the plugin, which know it through OpenUSD alone, of any release
            assert to is None or target == "hdDelegate/hydra/compat.h", f"{path} includes {target}"
            continue
        assert source, f"{path} is in no room of ARCHITECTURE.md"
        if to is None or to == source:
            continue
        assert to in known[source], f"{path} includes {target}: ARCHITECTURE.md has no arrow from {source} to {to}"
        met[source].add(to)
    for name, allowed in known.items():
        assert allowed <= met[name], f"ARCHITECTURE.md has arrows that no include needs: {name} to {allowed - met[name]}"


def file_includes():
    """:returns: file -> files of the checkout that it includes, be they C++, GLSL or tables, named from the root or beside
    it"""
    found = {}
    for top in FOLDERS:
        for folder, folders, names in os.walk(os.path.join(ROOT, top)):
            folders[:] = [name for name in folders if name != "node_modules"]
            for name in names:
                if name.endswith((".h", ".cpp", ".inc", ".def", ".glsl")):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8") as file:
                        targets = INCLUDE.findall(file.read())
                    at = os.path.relpath(path, ROOT).replace(os.sep, "/")
                    found[at] = [t for name in targets for t in (name,
                                                                 os.path.normpath(os.path.join(os.path.dirname(at), name)))]
    return {path: {target for target in targets if target in found} for path, targets in found.items()}


def in_one_back_end(included):
    """:returns: files that both back ends include, directly or through others, and that lie in one of them"""
    rooms_of_both = ("hdDelegate/embree/", "hdDelegate/raster/")
    reached = []
    for room in rooms_of_both:
        own = {path for path in included if path.startswith(room)}
        reached.append(set().union(own, *(reachable(included, path) for path in own)))
    return sorted(path for path in reached[0] & reached[1] if path.startswith(rooms_of_both))


def test_what_both_back_ends_include_lies_in_neither():
    assert in_one_back_end(file_includes()) == []


def test_a_file_of_one_back_end_that_the_other_includes_is_found():
    """Through a room that both may include, and beside the file."""
    included = {"hdDelegate/embree/a.cpp": {"hdDelegate/compiled/b.h"}, "hdDelegate/raster/c.cpp": {"hdDelegate/raster/d.inc"},
                "hdDelegate/compiled/b.h": {"hdDelegate/raster/d.inc"}, "hdDelegate/raster/d.inc": set()}
    assert in_one_back_end(included) == ["hdDelegate/raster/d.inc"]
    included["hdDelegate/compiled/b.h"] = set()
    assert in_one_back_end(included) == []


def test_rooms_have_few_public_headers():
    """A header more that other rooms include is a decision, made here."""
    known = rooms(section())
    public = {name: set() for name in known}
    for path, target in includes():
        source, to = room_of(path, known), room_of(target, known)
        if source and to and to != source and target.endswith(".h"):
            public[to].add(target)
    for name, headers in public.items():
        folders = {os.path.dirname(path) for path, _ in includes() if room_of(path, known) == name}
        most = max(PUBLIC, 2 * len(folders))
        assert len(headers) <= most, f"{name} has {len(headers)} public headers, of {most}: {sorted(headers)}"


def test_arrows_run_one_way():
    known = rooms(section())
    for name in known:
        assert name not in reachable(known, name), name


def test_the_diagram_shows_the_table():
    known, drawn = rooms(section()), diagram(section())
    assert set(drawn) == set(known)
    for name in known:
        more = drawn[name] - known[name]
        assert not more, f"the diagram has arrows that the table has not: {name} to {more}"
        hidden = known[name] - reachable(drawn, name)
        assert not hidden, f"the diagram has no way from {name} to {hidden}"


def test_usd_stays_in_the_rooms_of_hosts():
    for path, target in includes():
        assert not target.startswith("pxr/") or path.startswith(USD), f"{path} includes {target}"
