# SPDX-License-Identifier: Apache-2.0
"""Rooms, and folders of a room, include only those that ARCHITECTURE.md says they may: its tables and its diagram are read,
and every C++ include."""
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


def sources(endings, *leave_out):
    """:returns: (file, what it includes) of the checkout, but of folders that are left out"""
    for top in FOLDERS:
        for folder, folders, names in os.walk(os.path.join(ROOT, top)):
            folders[:] = [name for name in folders if name not in ("node_modules", *leave_out)]
            for name in names:
                if name.endswith(endings):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8") as file:
                        yield os.path.relpath(path, ROOT).replace(os.sep, "/"), INCLUDE.findall(file.read())


def includes():
    """:returns: (file, included) of all C++ but that of tests/ folders, which may look into other rooms; <pxr/...> too"""
    return [(path, target) for path, targets in sources((".h", ".cpp"), "tests") for target in targets]


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


def file_includes(*leave_out):
    """:returns: file -> files of the checkout that it includes, be they C++, GLSL or tables, named from the root or beside
    it"""
    found = dict(sources((".h", ".cpp", ".inc", ".def", ".glsl"), *leave_out))
    beside = {path: {os.path.normpath(os.path.join(os.path.dirname(path), name)) for name in names}
              for path, names in found.items()}
    return {path: {target for target in beside[path] | set(names) if target in found} for path, names in found.items()}


def orders(text):
    """:returns: room -> steps of folders, from what rows of the table say behind "in this order": `first/`, (`b/`, `c/`)"""
    rows = re.findall(r"^\| `([\w/.]+)` \|[^|\n]*in this order:([^|\n]*)\|", text, re.MULTILINE)
    return {room: [re.findall(r"`(\w+)/`", step) for step in re.findall(r"\([^)]*\)|`\w+/`", steps)] for room, steps in rows}


def folder_of(path, room):
    """:returns: the folder of a room that a file is in, "" for a file of the room itself, None for one of another room"""
    return (os.path.dirname(path)[len(room) + 1:] + "/").split("/")[0] if path.startswith(room + "/") else None


def into_other_folders(included, room):
    """:returns: (file, included file) from one folder of a room to another, also through files of the room itself"""
    own = {path: targets for path, targets in included.items() if folder_of(path, room)}
    through = {path: set() if path in own else targets for path, targets in included.items()}
    return [(path, target) for path in own for target in reachable({**through, path: included[path]}, path)
            if folder_of(target, room) not in (None, "", folder_of(path, room))]


def wrong_ways(included, room, steps):
    """:returns: those of into_other_folders() that lead to no earlier step, nor to a folder of the same"""
    place = {folder: i for i, step in enumerate(steps) for folder in step}
    return [(path, target) for path, target in into_other_folders(included, room)
            if place[folder_of(target, room)] > place[folder_of(path, room)]]


def test_folders_of_a_room_include_those_before_them():
    included, ordered = file_includes("tests"), orders(section())
    for room in rooms(section()):
        met = {folder_of(path, room) for arrow in into_other_folders(included, room) for path in arrow}
        steps = ordered.pop(room, [])
        assert met <= set(sum(steps, [])), f"ARCHITECTURE.md has no place for folders of {room}: {met - set(sum(steps, []))}"
        assert wrong_ways(included, room, steps) == []
        for folder in sum(steps, []):
            assert os.path.isdir(os.path.join(ROOT, room, folder)), f"ARCHITECTURE.md has {room}/{folder}, which is gone"
    assert not ordered


def test_an_include_of_a_later_folder_is_found():
    """Straight, and through a file of the room itself."""
    included = {"room/low/a.h": {"room/all.h"}, "room/all.h": {"room/high/b.h"}, "room/high/b.h": {"room/low/c.h"},
                "room/low/c.h": set()}
    assert wrong_ways(included, "room", [["low"], ["high"]]) == [("room/low/a.h", "room/high/b.h")]
    assert wrong_ways(included, "room", [["low", "high"]]) == []
    included["room/all.h"] = set()
    assert wrong_ways(included, "room", [["low"], ["high"]]) == []
    included["room/low/c.h"] = {"room/high/b.h"}
    assert wrong_ways(included, "room", [["low"], ["high"]]) == [("room/low/c.h", "room/high/b.h")]


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
