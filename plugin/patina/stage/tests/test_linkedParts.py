# SPDX-License-Identifier: Apache-2.0
"""Links that name parts of instances, and lights in instances that are linked to parts of their own: they light the same shapes
where a stage is instanced and where it is not."""
import random
import re

import pytest
from pxr import Usd


def linked(reading, numbers):
    """:returns: dict of (shape's name, x of its place) -> names of the categories that hold it"""
    prims, instances = {}, {}
    for text in ("\n" + reading.text).replace("\n ", "\r").split("\n"):
        head, *lines = text.split("\r")
        kind, _, path = head.partition(" ")
        prims[path] = {"kind": kind, **dict(line.strip().split(" = ", 1) for line in lines)}
    for prim in prims.values():
        if prim["kind"] == "Instancer":
            instances.setdefault(prim.get("group", '""'), []).append(prim)

    def x_of(prim, name="transform"):
        return numbers(prim[name])[12] if name in prim else 0.0

    def expand(group, x, around):
        for path, prim in prims.items():
            if prim["kind"] == "Implicit" and prim.get("group", '""') == group:
                own = prim.get("categories", "").split()
                yield (path.split("/")[-1], x + x_of(prim)), sorted({*own, *around})
        for prim in instances.get(group, ()):
            names = prim["prototypes"].split()
            held = any(key.startswith("categories ") for key in prim)
            for i, index in enumerate(prim["prototypeIndices"].replace(",", " ").split()):
                own = prim.get(f"categories {i}", "").split() if held else around  # the innermost that has some counts
                yield from expand(f'"{names[int(index)]}"', x + x_of(prim, f"transform {i}"), own)

    found = list(expand('""', 0.0, ()))
    assert len(dict(found)) == len(found)
    return dict(found)


def at(x):
    return f'double3 xformOp:translate = ({x}, 0, 0)  uniform token[] xformOpOrder = ["xformOp:translate"]'


INSTANCES = """
class "inner" {
    def Sphere "s" { }
    def Sphere "t" { AT1 }
    INNER
}
class "outer" {
    def Xform "in" (inherits = </inner>  instanceable = HOW) { AT2 }
    def Sphere "u" { }
    OUTER
}
def Xform "a" (inherits = </outer>  instanceable = HOW) { AT10 }
def Xform "b" (inherits = </outer>  instanceable = HOW) { AT20 }
def Xform "c" (inherits = </inner>  instanceable = HOW) { AT30 }
def SphereLight "world" { WORLD }
"""
NOT_ALL = "uniform bool collection:lightLink:includeRoot = 0  "
PATTERN = NOT_ALL + 'uniform pathExpression collection:lightLink:membershipExpression = '


def light(link):
    return f'def SphereLight "lamp" {{ {link} }}'


@pytest.mark.parametrize("places", [
    {"WORLD": NOT_ALL + "rel collection:lightLink:includes = [</a/in/t>, </b>]"},
    {"WORLD": NOT_ALL + "rel collection:lightLink:includes = </a>"},
    {"WORLD": "rel collection:lightLink:excludes = [</a/u>, </b/in>]  "
              "rel collection:shadowLink:excludes = [</c/s>, </b/in/s>]"},
    {"WORLD": NOT_ALL + "rel collection:lightLink:includes = </a>  rel collection:lightLink:excludes = </a/in/s>"},
    {"WORLD": PATTERN + '"//t"'}, {"WORLD": PATTERN + '"/a//"'}, {"WORLD": PATTERN + '"//in //u"'},
    {"OUTER": light(NOT_ALL + "rel collection:lightLink:includes = [</outer/u>, </outer/in/s>]")},
    {"OUTER": light("rel collection:shadowLink:excludes = </outer/in>")},
    {"INNER": light(NOT_ALL + "rel collection:lightLink:includes = </inner/t>")},
    {"INNER": light(NOT_ALL + "rel collection:lightLink:includes = </inner>"),
     "OUTER": light("rel collection:lightLink:excludes = </outer/in/t>"),
     "WORLD": "rel collection:lightLink:excludes = </b/in/s>"}], ids=range(11))
def test_instances_are_linked_as_what_they_stand_for(read, numbers, places):
    readings = []
    for how in ("false", "true"):
        text = INSTANCES.replace("HOW", how)
        for word in ("INNER", "OUTER", "WORLD"):
            text = text.replace(word, places.get(word, ""))
        for x in (1, 2, 10, 20, 30):
            text = text.replace(f"AT{x} ", at(x) + " ")
        readings.append(linked(read(text), numbers))
    flat, instanced = readings
    assert instanced == flat and len(flat) == 8
    assert len(set(map(tuple, flat.values()))) > 1, "the links leave something out"


def test_instances_that_no_link_divides_share_their_prims(read):
    text = INSTANCES.replace("HOW", "true").replace("INNER", "").replace("OUTER", light("")).replace("AT", "#")
    reading = read(text.replace("WORLD", NOT_ALL + "rel collection:lightLink:includes = </a>"))
    assert reading.has("/a/u") and not reading.has("/b/u") and not reading.has("/b/in/s")


INSTANCERS = """
def Scope "kept" (active = true) { token visibility = "invisible"
    def Xform "p" { def Sphere "s" { }
        def Xform "thing" (inherits = </thing>  instanceable = true) { } } }
class "thing" { def Sphere "t" { } }
def PointInstancer "i" { rel prototypes = [</i/own>, </kept/p>]  int[] protoIndices = [0, 1, 0]
    point3f[] positions = [(1,0,0), (2,0,0), (3,0,0)]
    def Sphere "own" { } }
def PointInstancer "j" { rel prototypes = </kept/p>  int[] protoIndices = [0]  point3f[] positions = [(4,0,0)] }
def SphereLight "l" { LINK }
"""
OWN, S, T = [("own", 1.0), ("own", 3.0)], [("s", 2.0), ("s", 4.0)], [("t", 2.0), ("t", 4.0)]


@pytest.mark.parametrize("link, lit", [
    ("rel collection:lightLink:excludes = </i/own>", S + T),
    ("rel collection:lightLink:excludes = </i>", [S[1], T[1]]),
    ("rel collection:lightLink:excludes = </kept/p/s>", OWN + T),
    ("rel collection:lightLink:excludes = [</kept/p/s>, </j>]", OWN + T[:1]),
    ("rel collection:lightLink:excludes = </kept/p/thing/t>", OWN + S),
    (NOT_ALL + "rel collection:lightLink:includes = </i/own>", OWN),
    (NOT_ALL + "rel collection:lightLink:includes = [</kept/p/s>, </j>]", S + T[1:]),
    (NOT_ALL + "rel collection:lightLink:includes = </j>  rel collection:lightLink:excludes = </kept/p/thing>", S[1:])])
def test_prototypes_of_point_instancers_are_linked(read, numbers, link, lit):
    """What a link says of a prototype or of a prim below counts, for the rest what it says of the instancer."""
    found = linked(read(INSTANCERS.replace("LINK", link)), numbers)
    assert set(found) == {*OWN, *S, *T}
    assert sorted(shape for shape, names in found.items() if names) == sorted(lit)


ELSEWHERE = """
def Scope "kept" { token visibility = "invisible"
    def Xform "p" { def Sphere "s" { }
        def Xform "thing" (inherits = </thing>  instanceable = HOW) { AT0.25 } }
    def Xform "q" { def Sphere "x" { }
        def PointInstancer "k" { rel prototypes = </kept/p>  int[] protoIndices = [0]  point3f[] positions = [(0.5,0,0)] } } }
class "thing" { def Sphere "t" { } }
class "inner" { def Sphere "s" { }
    def Sphere "t" { AT1 }
    def SphereLight "lamp" { INNER } }
class "outer" { def Xform "in" (inherits = </inner>  instanceable = HOW) { AT2 }
    def Sphere "u" { }
    def PointInstancer "i" { rel prototypes = </kept/DRAWN>  int[] protoIndices = [0]  point3f[] positions = [(4,0,0)] }
    def SphereLight "lamp" { OUTER } }
class "two" { def Sphere "s" { }
    def Sphere "t" { AT1 } }
def Xform "a" (inherits = </outer>  instanceable = HOW) { AT10 }
def Xform "b" (inherits = </outer>  instanceable = HOW) { AT20 }
def Xform "c" (inherits = </inner>  instanceable = HOW) { AT30 }
def PointInstancer "j" { rel prototypes = [</kept/q>, </kept/p>]  int[] protoIndices = [0, 1]
    point3f[] positions = [(40,0,0), (50,0,0)] }
def Xform "d" (inherits = </two>  instanceable = HOW) { AT60 }
def SphereLight "world" { WORLD }
"""
SHARED = ("/kept/p", "/kept/p/s", "/kept/p/thing", "/kept/p/thing/t", "/kept/q", "/kept/q/x", "/j", "/d", "/d/s", "/d/t")
NAMED = {"INNER": (*SHARED, "/inner", "/inner/s", "/inner/t"), "OUTER": (*SHARED, "/outer", "/outer/u", "/outer/in/s"),
         "WORLD": (*SHARED, "/a", "/b", "/c", "/a/in", "/b/in", "/a/in/s", "/b/in/t", "/c/s", "/a/u", "/a/i")}


def a_link(chance, kind, paths):
    """:returns: statements of a light that is linked to some of the paths, to all but some, or to all"""
    def some(most):
        return ", ".join(f"<{path}>" for path in chance.sample(paths, chance.randint(1, most)))

    choice = chance.random()
    if choice < 0.3:
        return ""
    if choice < 0.6:
        return f"rel collection:{kind}:excludes = [{some(2)}]"
    if choice < 0.7:
        pattern = chance.choice(["//t", "//in//", "/kept//"])
        return PATTERN.replace("lightLink", kind) + f'"{pattern}"'
    excludes = chance.choice(["", f"  rel collection:{kind}:excludes = [{some(1)}]"])
    rule = chance.choice(["", "", "", f'  uniform token collection:{kind}:expansionRule = "explicitOnly"'])
    return NOT_ALL.replace("lightLink", kind) + f"rel collection:{kind}:includes = [{some(3)}]{excludes}{rule}"


@pytest.mark.parametrize("seed", range(20))
def test_links_do_not_depend_on_what_is_instanceable(read, numbers, seed):
    """Links by chance, of the world and of lights in instances, to prims of the world, of other instances, and of prototypes
    that lie outside of the instances that draw them. Instances that share a light share its link."""
    chance = random.Random(seed)
    drawn = chance.choice("pq")
    text = ELSEWHERE.replace("DRAWN", drawn)
    for word, paths in NAMED.items():
        links = (a_link(chance, kind, paths) for kind in ("lightLink", "shadowLink"))
        text = text.replace(word, "  ".join(filter(None, links)))
    for x in ("0.25", "1", "2", "10", "20", "30", "60"):
        text = text.replace(f"AT{x} ", at(x) + " ")
    flat, instanced = (lit_by(read(text.replace("HOW", how)), numbers) for how in ("false", "true"))
    assert instanced == flat and len(flat[0]) == 19 + 2 * (drawn == "q")


def lit_by(reading, numbers):
    """:returns: (set of all shapes, set of those that each link of a light holds, without empty ones)"""
    shapes = linked(reading, numbers)
    links = set(re.findall(r'^  (?:light|shadow)Link = "(.+)"', reading.text, re.M))
    held = {frozenset(shape for shape, names in shapes.items() if link in names) for link in links}
    return set(shapes), held - {frozenset()}


def test_lights_that_leave_out_the_same_are_one_category(read):
    reading = read("".join(f'def SphereLight "l{i}" {{ rel collection:lightLink:excludes = </out> }}  ' for i in range(3)) +
                   'def Sphere "in" { }  def Sphere "out" { }')
    assert len(reading.prim("/in")["categories"].split()) == 1 and "categories" not in reading.prim("/out")
    assert len({reading.prim(f"/l{i}")["lightLink"] for i in range(3)}) == 1


def test_links_are_asked_about_what_they_name_alone(read, monkeypatch):
    """Thousands of prims under hundreds of lights, none of which names them, are asked about by no light."""
    asked, query = [], Usd.UsdCollectionMembershipQuery
    ask = query.IsPathIncluded
    monkeypatch.setattr(query, "IsPathIncluded", lambda own, path: asked.append(path.pathString) or ask(own, path))
    reading = read("".join(f'def SphereLight "l{i}" {{ rel collection:lightLink:excludes = </lot{i}/s> }}  '
                           f'def Xform "lot{i}" {{ def Sphere "s" {{ }} \n def Sphere "t" {{ }} }}  ' for i in range(20)))
    assert len(reading.prim("/lot3/t")["categories"].split()) == 20 and len(reading.prim("/lot3/s")["categories"].split()) == 19
    assert sorted(asked) == sorted(f"/lot{i}/s" for i in range(20))
