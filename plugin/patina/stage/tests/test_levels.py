# SPDX-License-Identifier: Apache-2.0
"""Levels of detail of UsdLod: one child of a root is drawn."""
import pytest

from patina.stage import levels

ITEMS = """{
    def Sphere "near" { %s }  def Cube "middle" { token visibility = "invisible" }  def Cone "far" { }
}"""
ROOT = 'def Xform "root" (prepend apiSchemas = ["LODRootAPI"%s]) { %s\n' + ITEMS[1:]
DISTANCE = """
def LODDistanceHeuristic "by" {
    uniform token lod:domain = "imaging"  uniform float[] thresholds = [5, 50]  %s
}
"""
CAMERA = """def Camera "camera" {
    double3 xformOp:translate = (0, 0, %g)  uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
BY = "rel lod:heuristics = </by>"


def drawn(reading, root="/root"):
    return [name for name in ("near", "middle", "far") if reading.has(f"{root}/{name}")]


@pytest.fixture
def usd_lod():
    return pytest.importorskip("pxr.UsdLod", reason="levels of detail need OpenUSD 26.08 or later")


@pytest.mark.parametrize("index, shown", [(0, "near"), (1, "middle"), (2, "far"), (9, "far"), (-1, "near")])
def test_the_default_is_an_index_among_the_children(read, index, shown):
    # The middle one is authored invisible, for renderers that know no levels.
    assert drawn(read(ROOT % ("", f"int lod:default:index = {index}", ""))) == [shown]


@pytest.mark.parametrize("distance, shown", [(1, "near"), (4.9, "near"), (5.1, "middle"), (60, "far")])
def test_a_distance_chooses(read, usd_lod, distance, shown):
    assert drawn(read(CAMERA % distance + DISTANCE % "" + ROOT % ("", BY, ""))) == [shown]


def test_distances_are_from_the_box_of_a_bounding_volume_in_the_space_of_the_root(read, usd_lod):
    volume = 'def Cube "box" { float3[] extent = [(-1, -1, -1), (1, 1, 1)] }\n'
    moved = 'double3 xformOp:translate = (0, 0, -6)  uniform token[] xformOpOrder = ["xformOp:translate"] '
    near = DISTANCE % "rel boundingVolume = </box>"
    assert drawn(read(CAMERA % 5.5 + DISTANCE % "" + ROOT % ("", BY, ""))) == ["middle"]
    assert drawn(read(CAMERA % 5.5 + volume + near + ROOT % ("", BY, ""))) == ["near"]  # 4.5 to the box
    assert drawn(read(CAMERA % 5.5 + volume + near + ROOT % ("", moved + "\n" + BY, ""))) == ["middle"]


def test_between_two_levels_the_nearer_one_is_drawn(read, usd_lod):
    blended = DISTANCE % "uniform float[] blendThresholds = [15, 60]"
    for distance, shown in ((9.0, "near"), (11.0, "middle"), (54.0, "middle"), (56.0, "far")):
        assert drawn(read(CAMERA % distance + blended + ROOT % ("", BY, ""))) == [shown], distance


def test_the_size_on_screen_chooses(read, usd_lod):
    size = """def LODScreenSizeHeuristic "by" {
        uniform token lod:domain = "imaging"  uniform float[] thresholds = [0.5, 0.01]  uniform token projectionMethod = "%s" }
    """
    for method in ("projectedSphere", "projectedExtent"):
        for distance, shown in ((4.0, "near"), (20.0, "middle"), (200.0, "far")):
            assert drawn(read(CAMERA % distance + size % method + ROOT % ("", BY, ""))) == [shown], (method, distance)


def test_other_domains_and_what_is_no_heuristic_are_passed_over(read, usd_lod):
    audio = DISTANCE.replace("imaging", "audio") % ""
    assert drawn(read(CAMERA % 60 + audio + ROOT % ("", BY, ""))) == ["near"]
    reading = read(CAMERA % 60 + 'def Scope "s" { }\n' + DISTANCE % "" + ROOT % ("", "rel lod:heuristics = [</s>, </by>]", ""))
    assert drawn(reading) == ["far"]
    assert any("/root lod:heuristics: names /s" in w for w in reading.warnings), reading.warnings


@pytest.mark.parametrize("mode, shown", [("indexedLOD", ["middle"]), ("noLOD", []), ("allLOD", ["near", "middle", "far"]),
                                         ("noOverride", ["far"])])
def test_an_override_stands_above_heuristics_and_is_inherited(read, usd_lod, mode, shown):
    own = f'token lod:override:mode = "{mode}"  float lod:override:index = 1.4\n'
    assert drawn(read(CAMERA % 60 + DISTANCE % "" + ROOT % (', "LODOverrideAPI"', own + "\n" + BY, ""))) == shown
    above = f'def Xform "top" (prepend apiSchemas = ["LODOverrideAPI"]) {{ {own}\n{ROOT % ("", BY, "")}\n}}'
    assert drawn(read(CAMERA % 60 + DISTANCE % "" + above), "/top/root") == shown


def test_roots_in_levels_that_are_not_drawn_choose_nothing(read, usd_lod):
    inner = ROOT.replace('"root"', '"inner"') % ("", "", "")
    text = ('def Xform "root" (prepend apiSchemas = ["LODRootAPI"]) {\nint lod:default:index = %d\n'
            + inner + '\ndef Cone "far" { }\n}')
    assert drawn(read(text % 0), "/root/inner") == ["near"] and not drawn(read(text % 0))
    assert not drawn(read(text % 1), "/root/inner") and drawn(read(text % 1)) == ["far"]


TREE = 'class Xform "tree" %s { %s\n' + ITEMS[1:]
PLACED = """def Xform "%s" (prepend references = </tree>  instanceable = true) {
    double3 xformOp:translate = (0, 0, %g)  uniform token[] xformOpOrder = ["xformOp:translate"] }
"""


@pytest.mark.parametrize("deep", [False, True])
def test_each_native_instance_has_levels_of_its_own(read, usd_lod, deep):
    tree = TREE % ('(prepend apiSchemas = ["LODRootAPI"])', BY, "")
    if deep:  # the root is below that of the prototype
        tree = 'class Xform "tree" { ' + ROOT % ("", BY, "") + "\n}"
    below = "/root" if deep else ""
    places = "".join(PLACED % (name, z) for name, z in (("a", -1), ("b", -2), ("c", -20), ("d", -200)))
    reading = read(CAMERA % 0 + DISTANCE % "" + tree + "\n" + places)
    assert drawn(reading, "/a" + below) == ["near"]
    assert not drawn(reading, "/b" + below), "two instances that show the same level share it"
    assert drawn(reading, "/c" + below) == ["middle"] and drawn(reading, "/d" + below) == ["far"]


def test_instances_of_a_point_instancer_have_the_level_of_the_nearest(read, usd_lod):
    trees = """def PointInstancer "trees" {
        point3f[] positions = [(0, 0, -100), (0, 0, %g)]  int[] protoIndices = [0, 0]  rel prototypes = </trees/root>
        """ + ROOT % ("", BY, "") + "\n}"
    assert drawn(read(CAMERA % 0 + DISTANCE % "" + trees % -20), "/trees/root") == ["middle"]
    assert drawn(read(CAMERA % 0 + DISTANCE % "" + trees % -70), "/trees/root") == ["far"]


def test_a_stage_without_a_camera_is_seen_from_that_which_frames_it(read, usd_lod):
    assert drawn(read(DISTANCE % "" + ROOT % ("", BY, ""))) == ["middle"]  # some 6 units away
    ball = 'def Sphere "ball" { double radius = 100  float3[] extent = [(-100, -100, -100), (100, 100, 100)] }\n'
    assert drawn(read(ball + DISTANCE % "" + ROOT % ("", BY, ""))) == ["far"]


def test_an_older_openusd_tells_and_draws_the_default(read, monkeypatch):
    monkeypatch.setattr(levels, "UsdLod", None)
    reading = read(CAMERA % 60 + DISTANCE % "" + ROOT % ("", "int lod:default:index = 1  " + BY, ""))
    assert drawn(reading) == ["middle"]
    assert any("/root : levels of detail need OpenUSD 26.08" in w for w in reading.warnings), reading.warnings


def test_instances_nested_without_end_are_read(read, usd_lod):
    """Ten instances on each of nine levels, with levels of detail in the innermost: a thousand million of them."""
    layers = 'class Xform "l0" { ' + ROOT % ("", "", "") + "\n}\n"
    for i in range(1, 10):
        layers += f'class Xform "l{i}" {{\n' + "".join(
            f'def Xform "i{k}" (instanceable = true  prepend references = </l{i - 1}>) {{ }}\n' for k in range(10)) + "}\n"
    reading = read(layers + 'def Xform "top" (prepend references = </l9>) { }')
    assert " near" in reading.text.replace("/", " ") and not reading.has("/top/far")
