# SPDX-License-Identifier: Apache-2.0
"""Point instancers and native instances."""
import tracemalloc

import pytest
from pxr import Usd

from patina.stage import cycles, walk

MATERIALS = """
    def Material "red" { token outputs:surface.connect = </red/s.outputs:out>
        def Shader "s" { uniform token info:id = "UsdPreviewSurface"  token outputs:out } }
    def Material "blue" { token outputs:surface.connect = </blue/s.outputs:out>
        def Shader "s" { uniform token info:id = "UsdPreviewSurface"  token outputs:out } }
"""
TREE = """
    class Xform "tree" {
        def Sphere "crown" { double3 xformOp:translate = (0, 1, 0)  uniform token[] xformOpOrder = ["xformOp:translate"] }
        def Xform "leaf" (instanceable = true; inherits = </leaf>) { } }
    class Xform "leaf" { def Cube "blade" { } }
"""


def place(x):
    return f"double3 xformOp:translate = ({x}, 0, 0)  uniform token[] xformOpOrder = [\"xformOp:translate\"] "


def test_native_instances_share_one_prototype(read, numbers):
    reading = read(TREE + "".join(
        f'def Xform "t{i}" (instanceable = true; inherits = </tree>) {{ {place(i)} }}\n' for i in range(3)))
    instancer = reading.prim("/t0")
    assert instancer["kind"] == "Instancer" and instancer["instances"] == "3"
    assert numbers(instancer["transform 2"])[12] == 2.0
    crown = reading.prim("/t0/crown")
    assert crown["group"] == '"/t0"' and numbers(crown["transform"])[13] == 1.0
    # nested: the leaf is an instance inside of the tree's group, once
    leaf = reading.prim("/t0/leaf")
    assert leaf["kind"] == "Instancer" and leaf["group"] == '"/t0"' and leaf["instances"] == "1"
    assert reading.prim("/t0/leaf/blade")["group"] == '"/t0/leaf"'
    assert reading.text.count("Implicit ") == 2


def test_what_no_transform_above_moves_stays_in_the_world(read, numbers):
    """It differs from instance to instance, and so does what holds it; other instances inside are shared as before."""
    reading = read(MATERIALS + """
    class Xform "part" {
        def Sphere "fixed" { double3 xformOp:translate = (1, 0, 0)
            uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:translate"] }
        def Sphere "moved" { } }
    class Xform "leaf" { def Cube "blade" { } }
    class Xform "asset" {
        def Xform "inner" (instanceable = true; inherits = </part>) { %s }
        def Xform "leaf" (instanceable = true; inherits = </leaf>) { } }""" % place(3) + "".join(
        f"""
    def Xform "t{i}" (instanceable = true; inherits = </asset>; prepend apiSchemas = ["MaterialBindingAPI"]) {{
        {place(10 * (i + 1))} rel material:binding = </red> }}""" for i in range(2)))
    assert not reading.warnings
    for i in range(2):
        fixed, moved = (reading.prim(f"/t{i}/inner/{name}") for name in ("fixed", "moved"))
        assert numbers(fixed["transform"])[12] == 1.0 and fixed["material"] == '"/red"'
        assert numbers(moved["transform"])[12] == 10.0 * (i + 1) + 3.0
    leaf = reading.prim("/t0/leaf")
    assert leaf["instances"] == "2" and numbers(leaf["transform 1"])[12] == 20.0
    assert reading.prim("/t0/leaf/blade")["material"] == '"/red"'


def test_instances_inherit_from_where_they_stand(read):
    reading = read(MATERIALS + TREE + """
    def Xform "a" (instanceable = true; inherits = </tree>; prepend apiSchemas = ["MaterialBindingAPI"]) {
        rel material:binding = </red> }
    def Xform "b" (instanceable = true; inherits = </tree>; prepend apiSchemas = ["MaterialBindingAPI"]) {
        rel material:binding = </blue>  color3f[] primvars:displayColor = [(1, 0, 0)] }
    def Xform "c" (instanceable = true; inherits = </tree>; prepend apiSchemas = ["MaterialBindingAPI"]) {
        rel material:binding = </red> }
    def Xform "hidden" (instanceable = true; inherits = </tree>) { token visibility = "invisible" }
    def Xform "guides" { uniform token purpose = "guide"
        def Xform "d" (instanceable = true; inherits = </tree>) { } }""")
    assert reading.prim("/a")["instances"] == "2"
    assert reading.prim("/a/crown")["material"] == '"/red"'
    assert reading.prim("/b/crown")["material"] == '"/blue"'
    assert reading.prim("/b")["primvar displayColor constant x3"] == "1 0 0"
    assert reading.prim("/b/leaf/blade")["material"] == '"/blue"'
    assert not reading.has("/hidden") and not reading.has("/guides/d/crown")


def test_bindings_inside_a_prototype_are_stronger_unless_told_otherwise(read):
    text = MATERIALS + """
    class Xform "p" { def Sphere "s" (prepend apiSchemas = ["MaterialBindingAPI"]) { rel material:binding = </p/own>  }
        def Material "own" { token outputs:surface.connect = </p/own/s.outputs:out>
            def Shader "s" { uniform token info:id = "UsdPreviewSurface"  token outputs:out } } }
    def Xform "i" (instanceable = true; inherits = </p>; prepend apiSchemas = ["MaterialBindingAPI"]) {
        rel material:binding = </red> %s }"""
    weak = read(text % "")
    assert weak.prim("/i/s")["material"] == '"/i/own"'
    assert weak.prim("/i/own")["node /i/own/s"] == "UsdPreviewSurface"
    assert read(text % '(bindMaterialAs = "strongerThanDescendants")').prim("/i/s")["material"] == '"/red"'


POINTED = """
    def PointInstancer "pi" {
        %s
        rel prototypes = [</pi/protos/ball>, </over>]
        point3f[] positions = [(0,0,0), (1,0,0), (2,0,0), (3,0,0)]
        int[] protoIndices = [0, 1, 0, 1]
        int64[] ids = [10, 11, 12, 13]
        float[] primvars:heat = [0.1, 0.2, 0.3, 0.4] (interpolation = "varying")
        def Scope "protos" { token visibility = "invisible"
            def Xform "ball" { double3 xformOp:translate = (0, 5, 0)  uniform token[] xformOpOrder = ["xformOp:translate"]
                def Sphere "s" { } } } }
    over "over" { def Cube "c" { } }
    class "class" { def Cube "c" { } }
"""


def test_point_instancer(read, numbers):
    reading = read(POINTED % "")
    pi = reading.prim("/pi")
    assert pi["prototypes"] == "/pi[0] /pi[1]" and pi["prototypeIndices"] == "0 1 0 1"
    assert [numbers(pi[f"transform {i}"])[12] for i in (1, 2, 3)] == [1, 2, 3] and "transform 0" not in pi
    assert pi["ids"] == "10 11 12 13"
    assert pi["primvar heat vertex"] == "0.1 0.2 0.3 0.4"
    ball = reading.prim("/pi/protos/ball/s")
    assert ball["group"] == '"/pi[0]"' and numbers(ball["transform"])[13] == 5.0  # the prototype's own transform
    assert reading.prim("/pi/over/c")["group"] == '"/pi[1]"'


def test_hidden_instances(read):
    pi = read(POINTED % "int64[] invisibleIds = [11]").prim("/pi")
    assert pi["ids"] == "10 12 13" and pi["prototypeIndices"] == "0 0 1" and pi["instances"] == "3"
    assert pi["primvar heat vertex"] == "0.1 0.3 0.4"
    inactive = read(POINTED.replace('"pi" {', '"pi" (inactiveIds = [10]) {', 1) % "").prim("/pi")
    assert inactive["ids"] == "11 12 13"


def test_orientations_and_velocities(read, numbers):
    reading = read("""def Camera "cam" { double shutter:close = 1 }
    def PointInstancer "pi" { rel prototypes = </pi/s>
        point3f[] positions.timeSamples = { 0: [(0,0,0)] }
        vector3f[] velocities.timeSamples = { 0: [(24,0,0)] }
        int[] protoIndices = [0]
        quath[] orientations = [(0.7071, 0, 0, 0.7071)]
        float3[] scales = [(2, 2, 2)]
        def Sphere "s" { } }""", frame=0.0)
    pi = reading.prim("/pi")
    start, end = numbers(pi["transform 0@0"]), numbers(pi["transform 0@1"])
    assert abs(start[1] - 2.0) < 1e-2 and abs(start[0]) < 1e-2  # x turns to y, twice as long
    assert start[12] == 0.0 and end[12] == 1.0


@pytest.mark.parametrize("turning, times", [
    ("quath[] orientations.timeSamples = { 0: [(1, 0, 0, 0), (1, 0, 0, 0)], 1: [(1, 0, 0, 0), (0.92388, 0, 0, 0.38268)] }", 4),
    ("quatf[] orientationsf.timeSamples = { 0: [(1, 0, 0, 0), (1, 0, 0, 0)], 1: [(1, 0, 0, 0), (0.92388, 0, 0, 0.38268)] }", 4),
    ("""quath[] orientations.timeSamples = { 0: [(1, 0, 0, 0), (1, 0, 0, 0)] }
        vector3f[] angularVelocities.timeSamples = { 0: [(0, 0, 0), (0, 0, 2400)] }""", 8),
    ("""quath[] orientations.timeSamples = { 0: [(1, 0, 0, 0), (1, 0, 0, 0)] }
        vector3f[] angularVelocities.timeSamples = { 0: [(0, 0, 0), (0, 0, 24)] }""", 3),
    ("quath[] orientations = [(1, 0, 0, 0), (0.92388, 0, 0, 0.38268)]", 2)])
def test_instances_that_turn_are_read_at_more_times(read, turning, times):
    """45 and 100 degrees in the shutter; the renderer's chords leave the arcs by a hundredth of the radius."""
    prim = read("""(timeCodesPerSecond = 24)
    def PointInstancer "pi" { rel prototypes = </pi/s>
        point3f[] positions.timeSamples = { 0: [(0,0,0), (1,0,0)], 1: [(1,0,0), (2,0,0)] }
        int[] protoIndices = [0, 0]
        %s
        def Sphere "s" { } }""" % turning, frame=0.0, shutter=(0.0, 1.0)).prim("/pi")
    assert len([key for key in prim if key.startswith("transform 1@")]) == times, prim


@pytest.mark.filterwarnings("error")
def test_nested_and_broken_instancers(read):
    reading = read("""
    def PointInstancer "outer" { rel prototypes = [</outer/inner>, </missing>, </outer>]
        int[] protoIndices = [0, 0, 7]
        point3f[] positions = [(0,0,0), (nan,inf,0), (0,0,0)]
        def PointInstancer "inner" { rel prototypes = </outer/inner/s>
            int[] protoIndices = [0, 0]
            point3f[] positions = [(0,0,0), (1,0,0)]
            def Sphere "s" { } } }
    def PointInstancer "short" { rel prototypes = </short/s>  int[] protoIndices = [0, 0]
        point3f[] positions = [(0,0,0)]
        def Sphere "s" { } }""")
    inner = reading.prim("/outer/inner")
    assert inner["group"] == '"/outer[0]"' and inner["instances"] == "2"
    assert reading.prim("/outer/inner/s")["group"] == '"/outer/inner[0]"'
    assert reading.prim("/outer")["instances"] == "1"
    said = "\n".join(reading.warnings)
    for part in ("there is no prim /missing", "/outer holds itself", "1 indices that no prototype has",
                 "1 instances that are not finite", "/short positions:"):
        assert part in said, said
    assert not reading.has("/short")


def test_instancers_that_hold_each_other_end(read):
    reading = read("""
    def PointInstancer "a" { rel prototypes = </b>  int[] protoIndices = [0]  point3f[] positions = [(0,0,0)] }
    def PointInstancer "b" { rel prototypes = </a>  int[] protoIndices = [0]  point3f[] positions = [(0,0,0)] }""")
    assert any("holds itself" in w for w in reading.warnings)


@pytest.mark.parametrize("undrawn", ['uniform token model:drawMode = "bounds"', ""])
def test_instancers_that_hold_themselves_and_are_not_drawn(read, undrawn):
    """UsdGeom.BBoxCache, which draw modes and the framing camera ask, would never end there."""
    purpose = "" if undrawn else 'uniform token purpose = "guide"'
    reading = read(f"""def Xform "M" (kind = "component"
        prepend apiSchemas = ["GeomModelAPI"]) {{ {undrawn}
        def Sphere "s" {{ }}
        def PointInstancer "I" {{ rel prototypes = </M>
            {purpose}
            int[] protoIndices = [0]
            point3f[] positions = [(0, 0, 0)] }} }}""")
    assert reading.info.framed


def test_cycles_lead_through_native_instances_too():
    text = """#usda 1.0
class Xform "proto"
{
    def PointInstancer "inner"
    {
        rel prototypes = <%s>
    }
}
def Xform "a" (instanceable = true
    inherits = </proto>)
{
}
def Xform "holder"
{
    def Xform "b" (instanceable = true
        inherits = </proto>)
    {
    }
}
def Xform "leaf"
{
}
"""
    for target, cyclic in (("/holder", True), ("/leaf", False)):
        found = Usd.Stage.CreateInMemory()
        found.GetRootLayer().ImportFromString(text % target)
        assert cycles.are_in(found) == cyclic


def test_prototypes_that_hold_each_other_end(read, limit):
    """Each way through them is a group of its own: n! of them."""
    limit(groups=200)
    n = 7
    targets = ", ".join(f"</P{i}>" for i in range(n))
    reading = read("".join(f"""def Xform "P{i}" {{ def PointInstancer "I" {{ rel prototypes = [{targets}]
        int[] protoIndices = [0]
        point3f[] positions = [(0, 0, 0)] }} }}
    """ for i in range(n)))
    assert sum("--limit groups" in warning for warning in reading.warnings) == 1
    assert reading.text.count("Instancer ") < 200 + 2 * n * n


def test_moving_instances_have_no_more_times_than_others(read):
    """Times that are the same as 32-bit floats are one; of many, some are taken."""
    near = "def Xform \"{0}\" (instanceable = true; inherits = </leaf>) {{ double3 xformOp:translate.timeSamples = {{ {1} }}" \
        "  uniform token[] xformOpOrder = [\"xformOp:translate\"] }}\n"
    samples = [f"{t}: (0, 0, 0), {t + 0.5}: (1, 0, 0)" for t in (10.1, 10.10000000001)]
    reading = read('class Xform "leaf" { def Cube "blade" { } }\n'
                   + "".join(near.format(f"t{i}", text) for i, text in enumerate(samples)), frame=10.0, shutter=(0.0, 1.0))
    assert reading.prim("/t0")["instances"] == "2"
    many = [", ".join(f"{10 + (k + i / 40) / 12:.6f}: ({k}, 0, 0)" for k in range(12)) for i in range(30)]
    reading = read('class Xform "leaf2" { def Cube "blade" { } }\n'
                   + "".join(near.replace("/leaf", "/leaf2").format(f"m{i}", text) for i, text in enumerate(many)),
                   frame=10.0, shutter=(0.0, 1.0))
    assert reading.prim("/m0")["instances"] == "30"


def test_prototypes_are_walked_no_longer_than_limits_allow(read, limit, monkeypatch):
    """Each instance with a light group of its own walks the prototype anew: instances times meshes."""
    found = []

    class Counted(walk.Found):
        def __post_init__(self):
            found.append(self.path)

    monkeypatch.setattr(walk, "Found", Counted)
    limit(prims=100)
    reading = read('class Xform "leaf" { ' + "".join(f'def Sphere "s{i}" {{ }}\n' for i in range(200)) + "}\n"
                   + "".join(f'def Xform "i{i}" (instanceable = true; inherits = </leaf>) '
                             f'{{ string primvars:lightGroup = "g{i}" }}\n' for i in range(200))
                   + 'def Camera "after" { }')
    assert len(found) < 500 and reading.info.camera == "/after"
    told = [w for w in reading.warnings if "there are more prims of a kind than 100 (--limit prims)" in w]
    assert len(told) == 1 and told[0].startswith("/i100 :")


def test_native_instances_are_found_no_longer_than_limits_allow(read, limit):
    limit(instances=5)
    reading = read('class Xform "leaf" { def Sphere "s" { } }\n'
                   + "".join(f'def Xform "i{i}" (instanceable = true; inherits = </leaf>) {{ }}\n' for i in range(9)))
    assert reading.prim("/i0")["instances"] == "5"
    assert sum("there are more instances than 5 (--limit instances)" in w for w in reading.warnings) == 1


def test_steps_bound_the_search_for_cycles(monkeypatch):
    below = {"/start": ["/a"] * 100, **{f"/a/{i}": [] for i in range(10000)}}
    monkeypatch.setattr(cycles, "_holders", lambda stage: below)
    monkeypatch.setattr(cycles, "MOST_STEPS", 1000)
    tracemalloc.start()
    try:
        assert cycles.are_in(None)
        assert tracemalloc.get_traced_memory()[1] < 1 << 20
    finally:
        tracemalloc.stop()


SWARM = """def Xform "x" { double3 xformOp:translate.timeSamples = { %s }
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def PointInstancer "many" { rel prototypes = </x/many/ball>  int[] protoIndices = [0]
        point3f[] positions.timeSamples = { %s }
        def Sphere "ball" { } } }"""


def test_times_of_an_instancer_and_of_what_is_above_are_merged(read):
    def at(times):
        return ", ".join(f"{t}: {{}}" for t in times)

    def values(times, value):
        return at(times).replace("{}", value)

    above, own = [10.1, 10.7], [10.10000000001, 10.5]
    reading = read(SWARM % (values(above, "(0, 0, 0)"), values(own, "[(0, 0, 0)]")), frame=10.0, shutter=(0.0, 1.0))
    assert reading.prim("/x/many")["instances"] == "1" and not reading.warnings
    above, own = ([f"{10 + (k + part) / 13:.6f}" for k in range(13)] for part in (0.3, 0.6))
    reading = read(SWARM % (values(above, "(0, 0, 0)"), values(own, "[(0, 0, 0)]")), frame=10.0, shutter=(0.0, 1.0))
    assert reading.prim("/x/many")["instances"] == "1" and not reading.warnings
    assert len([key for key in reading.prim("/x/many") if "transforms@" in key]) <= 16


def test_moving_instances_that_are_not_finite_later_stand_still(read):
    moving = """def Xform "i%d" (instanceable = true; inherits = </leaf>) {
        double3 xformOp:translate.timeSamples = { 10: (0, 0, 0), 11: (%s, 0, 0) }
        uniform token[] xformOpOrder = ["xformOp:translate"] }
    """
    reading = read('class Xform "leaf" { def Sphere "s" { } }\n' + moving % (0, "1") + moving % (1, "nan"),
                   frame=10.0, shutter=(0.0, 1.0))
    assert reading.prim("/i0")["instances"] == "2" and "nan" not in reading.text
    assert any("not finite" in w for w in reading.warnings)


def test_arrays_longer_than_proto_indices_are_cut(read, numbers):
    reading = read("""def Camera "c" { }
    def PointInstancer "pi" { rel prototypes = </pi/s>  int[] protoIndices = [0, 0]
        point3f[] positions = [(-2, 0, 0), (2, 0, 0), (6, 0, 0)]
        float3[] scales = [(1, 1, 1), (2, 2, 2), (3, 3, 3), (4, 4, 4)]
        vector3f[] velocities = [(24, 0, 0), (24, 0, 0)]
        def Sphere "s" { } }""")
    pi = reading.prim("/pi")
    assert pi["instances"] == "2" and numbers(pi["transform 1"])[:1] + numbers(pi["transform 1"])[12:] == [2, 2, 0, 0, 1]
    assert reading.warnings == ["/pi positions: has 3 values for 2 instances; the rest is not used"]


@pytest.mark.parametrize("moving", [False, True])
def test_cut_arrays_move(read, numbers, moving):
    reading = read("""(timeCodesPerSecond = 10)
    def PointInstancer "pi" { rel prototypes = </pi/s>  int[] protoIndices = [0]
        point3f[] positions.timeSamples = { 0: [(0, 0, 0), (9, 9, 9)], 4: [(4, 0, 0), (9, 9, 9)] }
        vector3f[] velocities.timeSamples = { 0: [(20, 0, 0), (0, 0, 0)], 4: [(20, 0, 0), (0, 0, 0)] }
        def Sphere "s" { } }""", frame=1.0, shutter=(0.0, 1.0) if moving else None)
    pi = reading.prim("/pi")
    if moving:
        assert numbers(pi["transform 0@0"])[12] == pytest.approx(2) and numbers(pi["transform 0@1"])[12] == pytest.approx(4)
    else:
        assert numbers(pi["transform 0"])[12] == pytest.approx(2)


@pytest.mark.parametrize("name, type_", [("orientations", "quath"), ("orientationsf", "quatf")])
def test_quaternions_are_normalised(read, numbers, name, type_):
    reading = read(f"""def PointInstancer "pi" {{ rel prototypes = </pi/s>  int[] protoIndices = [0, 0, 0]
        point3f[] positions = [(0, 0, 0), (0, 0, 0), (0, 0, 0)]
        {type_}[] {name} = [(2, 0, 0, 2), (0.7071, 0, 0, 0.7071), (0, 0, 0, 0)]
        def Sphere "s" {{ }} }}""")
    pi = reading.prim("/pi")
    assert numbers(pi["transform 0"])[:8] == pytest.approx([0, 1, 0, 0, -1, 0, 0, 0], abs=1e-3)
    assert "transform 2" not in pi and any("not of length 1" in w for w in reading.warnings)


LIBRARY = """
    def Xform "library" { %s  token visibility = "invisible"
        double3 xformOp:translate = (0, 7, 0)  uniform token[] xformOpOrder = ["xformOp:translate"]
        def Xform "ball" { double3 xformOp:translate = (0, 1, 0)  uniform token[] xformOpOrder = ["xformOp:translate"]
            def Sphere "s" { } } }
    class Xform "asset" { def PointInstancer "pi" { rel prototypes = </library/ball>
        int[] protoIndices = [0, 0]
        point3f[] positions = [(0,0,0), (1,0,0)] } }
    def Xform "a" (instanceable = true; inherits = </asset>) { }
    def Xform "b" (instanceable = true; inherits = </asset>; prepend apiSchemas = ["MaterialBindingAPI"]) {
        rel material:binding = </red>  color3f[] primvars:displayColor = [(0, 0, 1)] }
"""


def test_native_instances_draw_prototypes_that_lie_outside_of_them(read, numbers):
    """A prototype has material and primvars of its own place; those that it lacks are values of the instances around."""
    reading = read(MATERIALS + LIBRARY % "color3f[] primvars:displayColor = [(0, 1, 0)]")
    assert not reading.warnings
    for path in ("/a", "/b"):
        pi, ball = reading.prim(f"{path}/pi"), reading.prim(f"{path}/pi/ball/s")
        assert pi["group"] == f'"{path}"' and pi["instances"] == "2" and pi["prototypes"] == f"{path}/pi[0]"
        assert ball["group"] == f'"{path}/pi[0]"' and numbers(ball["transform"])[12:15] == [0, 1, 0]
        assert ball["primvar displayColor constant x3"] == "0 1 0" and "material" not in ball
    assert not any("displayColor" in line for line in reading.prim("/a"))
    bare = read(MATERIALS + LIBRARY % "")
    assert "primvar displayColor constant x3" not in bare.prim("/b/pi/ball/s")
    assert bare.prim("/b")["primvar displayColor constant x3"] == "0 0 1"


def test_prototypes_elsewhere_may_have_the_same_name(read):
    reading = read("""
    def Xform "a" { def Xform "ball" { def Sphere "s" { } } }
    def Xform "b" { def Xform "ball" { def Cube "s" { } } }
    def PointInstancer "pi" { rel prototypes = [</a/ball>, </pi/ball>, </b/ball>]
        int[] protoIndices = [0, 1, 2]
        point3f[] positions = [(0,0,0), (1,0,0), (2,0,0)]
        def Xform "ball" { def Cone "s" { } } }""")
    shapes = {}
    for line in reading.text.splitlines():
        if line.startswith("Implicit /pi/"):
            prim = reading.prim(line.split(" ", 1)[1])
            shapes[prim["group"]] = prim["shape"]
    assert shapes == {'"/pi[0]"': "sphere", '"/pi[1]"': "cone", '"/pi[2]"': "cube"}


@pytest.mark.parametrize("arc", ["inherits = </asset>", "references = </asset>", "references = @asset.usda@</asset>"])
def test_nested_instances_draw_prototypes_of_the_instance_around(read, statements, tmp_path, arc):
    """pxr names such a prototype by one of the instances around, or by the asset, by chance: all would draw what that has."""
    asset = """
    %s Xform "asset" {
        class Xform "part" { def PointInstancer "pi" { rel prototypes = </asset/ball>
            int[] protoIndices = [0]
            point3f[] positions = [(0,0,0)] } }
        def Xform "ball" { def Sphere "s" { } }
        def Xform "sub" (instanceable = true; inherits = </asset/part>; prepend apiSchemas = ["MaterialBindingAPI"]) {
            rel material:binding = </blue> } }""" % ("def" if "@" in arc else "class")
    stage = MATERIALS + f"""
    def Xform "a" (instanceable = true; {arc}) {{ }}
    def Xform "b" (instanceable = true; {arc}; prepend apiSchemas = ["MaterialBindingAPI"]) {{
        rel material:binding = </red> }}"""

    def made(asset, name):
        if "@" not in arc:
            return read(asset + stage)
        (tmp_path / name).write_text("#usda 1.0\n" + statements(asset.replace("rel material:binding = </blue>", "")))
        return read(stage.replace("asset.usda", name))

    reading = made(asset, "asset.usda")
    assert not reading.warnings
    assert "material" not in reading.prim("/a/sub/pi/ball/s")
    assert reading.prim("/b/sub/pi/ball/s")["material"] == '"/red"'
    assert reading.prim("/a/sub")["prototypes"] == "/a/sub" and reading.prim("/b/sub")["prototypes"] == "/b/sub"
    # It may hold the instancer that draws it.
    cyclic = made(asset.replace('def Sphere "s" { } }', """def Sphere "s" { }
            def Xform "again" (instanceable = true; inherits = </asset/part>) { } }"""), "cyclic.usda")
    assert any("/ball holds itself" in warning for warning in cyclic.warnings), cyclic.warnings
