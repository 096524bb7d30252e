# SPDX-License-Identifier: Apache-2.0
"""What prims inside of prototypes inherit: native instances from where they stand, point instances by namespace."""
import pytest

BALL = 'class Xform "ball" { def Sphere "s" { } }\n'


def instance(name, inside, model=""):
    return f'def Xform "{name}" ({model} instanceable = true; inherits = </ball>) {{ {inside} }}\n'


def test_primvars_above_native_instances_are_their_values(read):
    reading = read(BALL + 'def Xform "w" { color3f[] primvars:displayColor = [(1, 0, 0)]\n'
                   + "".join(instance(f"i{i}", f"float primvars:level = {i}") for i in range(3))
                   + instance("blue", "color3f[] primvars:displayColor = [(0, 0, 1)]  float primvars:level = 7")
                   + instance("plain", "") + "}")
    assert reading.text.count("Implicit ") == 1
    assert "primvar level" not in str(reading.prim("/w/i0/s")) and "displayColor" not in str(reading.prim("/w/i0/s"))
    valued = reading.prim("/w/i0")
    assert valued["instances"] == "4" and valued["primvar level vertex"] == "0 1 2 7"
    assert valued["primvar displayColor vertex x3"] == "1 0 0, 1 0 0, 1 0 0, 0 0 1"
    plain = reading.prim("/w/plain")  # without a level, so that materials take their own fallback there
    assert plain["instances"] == "1" and plain["prototypes"] == "/w/i0" and "primvar level" not in str(plain)
    assert plain["primvar displayColor constant x3"] == "1 0 0"


def test_values_inside_of_prototypes_are_nearer(read):
    """The renderer takes the prim's own value, then that of the innermost instance."""
    reading = read("""class Xform "inner" { def Sphere "s" { } }
    class Xform "ball" { def Xform "n" (instanceable = true; inherits = </inner>) { float primvars:level = 1 }
        def Sphere "own" { float primvars:level = 2 } }
    """ + instance("a", "float primvars:level = 3"))
    assert reading.prim("/a")["primvar level constant"] == "3"
    assert reading.prim("/a/n")["primvar level constant"] == "1"
    assert reading.prim("/a/own")["primvar level constant"] == "2"


COPIED = {
    "a text of lights": ("", 'string primvars:lightGroup = "%d"'),
    "widths": ("", "float primvars:widths = 0.%d"),
    "several values": ("", "float[] primvars:level = [%d, 2]"),
    "a matrix": ("", "matrix4d primvars:level = ((%d,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1))"),
    "what materials displace by": ("""def Material "m" {
        token outputs:displacement.connect = </m/s.outputs:o>
        def Shader "s" { uniform token info:id = "UsdPreviewSurface"  float inputs:displacement.connect = </m/r.outputs:result>
            token outputs:o }
        def Shader "r" { uniform token info:id = "UsdPrimvarReader_float"  string inputs:varname = "level"
            float outputs:result } }""", "float primvars:level = %d"),
}


@pytest.mark.parametrize("what", COPIED)
def test_what_no_instance_can_have_is_copied_alone(read, what):
    """A primvar beside it does not copy the prototype again."""
    before, text = COPIED[what]
    reading = read(before + "\n" + BALL + "".join(
        instance(f"i{i}{k}", text % i + f"  float primvars:other = {k}") for i in (1, 2) for k in range(3)))
    assert reading.text.count("Implicit ") == 2 and reading.prim("/i10")["instances"] == "3"
    assert reading.prim("/i10")["primvar other vertex"] == "0 1 2"


def test_marks_of_native_instances_are_kept_apart(read):
    reading = read(BALL + instance("a", "bool primvars:arnold:visibility:camera = 0") + instance("b", "")
                   + instance("c", "bool primvars:arnold:visibility:camera = 0"))
    assert reading.prim("/a")["instances"] == "2" and reading.prim("/b")["instances"] == "1"
    assert reading.prim("/a/s") != {**reading.prim("/b/s"), "group": '"/a"'}


@pytest.mark.parametrize("first", "ab")
@pytest.mark.parametrize("inner", ["component", "group"])
def test_draw_modes_of_native_instances_are_kept_apart(read, first, inner):
    outer, part = ("group", "component") if inner == "component" else ("component", "subcomponent")
    ball = f"""class Xform "ball" (kind = "{outer}") {{ def Xform "part" (kind = "{part}") {{
        def Sphere "s" {{ }} }} }}\n"""
    places = {"a": """def Xform "a" (kind = "assembly"; prepend apiSchemas = ["GeomModelAPI"]) {
        uniform token model:drawMode = "bounds"
        """ + instance("i", "") + "}\n", "b": 'def Xform "b" (kind = "assembly") { ' + instance("i", "") + "}\n"}
    order = [places[first], places["b" if first == "a" else "a"]]
    reading = read(ball + 'def Xform "w" (kind = "group") { ' + "".join(order) + "}")
    assert reading.has("/w/b/i/part/s") and not reading.has("/w/a/i/part/s")
    assert reading.prim("/w/a/i/part" if inner == "component" else "/w/a/i")["kind"] == "Curves"


def pointed(name, target, inside=""):
    return f"""def PointInstancer "{name}" {{ point3f[] positions = [(0, 0, 0)]  int[] protoIndices = [0]
        rel prototypes = [<{target}>]
        {inside} }}\n"""


def test_prototypes_elsewhere_inherit_where_they_are(read):
    reading = read("""def Xform "library" { color3f[] primvars:displayColor = [(1, 0.5, 0)]
        bool primvars:arnold:visibility:camera = 0
        token visibility = "invisible"
        def Sphere "s" { } }
    def Xform "w" { color3f[] primvars:displayColor = [(0, 0, 1)]  float primvars:other = 1
        bool primvars:arnold:visibility:camera = 1
        """ + pointed("p", "/library/s") + "}\n" + pointed("q", "/library/s"))
    ball = reading.prim("/w/p/s")
    assert ball["primvar displayColor constant x3"] == "1 0.5 0" and "primvar other constant" not in ball
    assert reading.prim("/q")["prototypes"] == "/w/p[0]" and reading.text.count("Implicit ") == 1
    plain = read('def Sphere "s" { bool primvars:arnold:visibility:camera = 0 }').prim("/s")
    assert {k: v for k, v in ball.items() if k.startswith("mark")} == {k: v for k, v in plain.items() if k.startswith("mark")}


def test_prims_between_an_instancer_and_its_prototypes_are_inherited_from(read):
    reading = read('def Xform "w" { ' + pointed("p", "/w/p/a/s", """float primvars:x = 1
        def Scope "a" { float primvars:y = 2
            uniform token purpose = "proxy"
            def Sphere "s" { } }""") + "}", purposes=("default", "proxy"))
    ball = reading.prim("/w/p/a/s")
    assert ball["primvar x constant"] == "1" and ball["primvar y constant"] == "2"


def test_a_primvar_by_instance_ends_what_was_inherited(read):
    """A prim's own primvar that is not constant hides that of the same name above it, be it the only one."""
    for more, expected in (("", None), ("float primvars:other = 1", "1")):
        reading = read('def Xform "w" { color3f[] primvars:displayColor = [(0, 0, 0.7)]  ' + more + """
            def PointInstancer "p" { point3f[] positions = [(0, 0, 0), (3, 0, 0)]  int[] protoIndices = [0, 0]
                rel prototypes = [</w/p/s>]
                color3f[] primvars:displayColor = [(0.9, 0.1, 0), (0, 0.1, 0.9)] (interpolation = "vertex")
                def Sphere "s" { } } }""")
        ball = reading.prim("/w/p/s")
        assert "primvar displayColor constant x3" not in ball and ball.get("primvar other constant") == expected


PURPOSES = {  # of the instancer, of what is above the prototype, of the prototype -> drawn with those purposes
    ("render", "", ""): {"render"}, ("render", "", "proxy"): {"render", "proxy"}, ("guide", "", ""): {"guide"},
    ("render", "library", ""): set(), ("", "library:guide", ""): {"guide"}, ("render", "library:guide", "proxy"): {"proxy"},
}


@pytest.mark.parametrize("case", PURPOSES, ids="-".join)
def test_purposes_are_those_of_the_prototype(read, case):
    instancer, library, own = case
    lines = {name: f'uniform token purpose = "{value}"' if value else "" for name, value in
             (("instancer", instancer), ("library", library.partition(":")[2]), ("own", own))}
    ball = f'def Sphere "s" {{ {lines["own"]} }}'
    if library:
        text = f'def Xform "l" {{ {lines["library"]}\n{ball} }}\n' + pointed("p", "/l/s", lines["instancer"])
    else:
        text = pointed("p", "/p/s", lines["instancer"] + "\n" + ball)
    effective = own or (library.partition(":")[2] if library else instancer) or "default"
    for purpose in ("render", "proxy", "guide"):
        assert read(text, purposes=("default", purpose)).has("/p") == (effective in ("default", purpose)), purpose


def test_draw_modes_above_instancers_do_not_reach_prototypes_elsewhere(read):
    reading = read("""def Xform "l" (kind = "group") { class Xform "asset" (kind = "component") { def Sphere "s" { } } }
    def Xform "w" (kind = "assembly"; prepend apiSchemas = ["GeomModelAPI"]) { uniform token model:drawMode = "bounds"
        """ + pointed("p", "/l/asset") + "}")
    assert reading.prim("/w/p/asset/s")["kind"] == "Implicit"
