# SPDX-License-Identifier: Apache-2.0
"""The collections of a UsdRenderPass."""
import pytest

from patina.stage import StageError

PASS = """
def RenderPass "pass" (prepend apiSchemas = ["CollectionAPI:renderVisibility", "CollectionAPI:cameraVisibility",
                                              "CollectionAPI:prune", "CollectionAPI:matte"]) {
    %s
}
"""
SCENE = """
def Xform "set" {
    def Sphere "a" { }
    def Sphere "b" { }
    def SphereLight "lamp" { }
}
def Sphere "c" { }
""" + PASS
NAMES = ("/set/a", "/set/b", "/set/lamp", "/c")


def drawn(reading):
    return [name for name in NAMES if reading.has(name)]


def seen(reading, path):
    """:returns: (whether the camera sees it, whether it is a matte)"""
    prim = reading.prim(path)
    return prim.get("visibility camera") != "false", prim.get("matte") == "true"


def test_a_pass_without_collections_draws_all(read):
    reading = read(SCENE % "", render_pass="/pass")
    assert drawn(reading) == list(NAMES) and seen(reading, "/c") == (True, False)


@pytest.mark.parametrize("lines, left", [
    ("rel collection:prune:includes = </set>", ["/c"]),
    ("rel collection:prune:includes = </set>\nrel collection:prune:excludes = </set/b>", ["/set/b", "/c"]),
    ("rel collection:renderVisibility:excludes = </set/a>", ["/set/b", "/set/lamp", "/c"]),
    ("uniform bool collection:renderVisibility:includeRoot = 0\nrel collection:renderVisibility:includes = </set/lamp>",
     ["/set/lamp"])])
def test_what_is_pruned_or_not_visible_is_not_drawn(read, lines, left):
    assert drawn(read(SCENE % lines, render_pass="/pass")) == left
    assert drawn(read(SCENE % lines)) == list(NAMES)


def test_patterns_are_followed(read):
    lines = """uniform bool collection:renderVisibility:includeRoot = 0
        uniform pathExpression collection:renderVisibility:membershipExpression = "/set//"
    """
    assert drawn(read(SCENE % lines, render_pass="/pass")) == ["/set/a", "/set/b", "/set/lamp"]


def test_what_the_camera_does_not_see_and_mattes_are_marks(read):
    reading = read(SCENE % "rel collection:cameraVisibility:excludes = </set>\nrel collection:matte:includes = </c>",
                   render_pass="/pass")
    assert seen(reading, "/set/a") == (False, False) and seen(reading, "/c") == (True, True)
    assert reading.prim("/set/lamp")["cameraVisible"] == "false"


INSTANCES = """
class Xform "thing" {
    def Sphere "a" { }
    def Sphere "b" { }
}
def Xform "one" (prepend references = </thing>  instanceable = true) { }
def Xform "two" (prepend references = </thing>  instanceable = true) { }
def Xform "three" (prepend references = </thing>  instanceable = true) { }
""" + PASS


def test_instances_are_in_a_collection_each_for_itself(read):
    reading = read(INSTANCES % "rel collection:prune:includes = </two>", render_pass="/pass")
    assert reading.has("/one/a") and not reading.has("/two/a") and not reading.has("/three/a"), "one and three share"
    reading = read(INSTANCES % "rel collection:prune:includes = </two/b>", render_pass="/pass")
    assert reading.has("/one/b") and reading.has("/two/a") and not reading.has("/two/b")
    reading = read(INSTANCES % 'uniform pathExpression collection:prune:membershipExpression = "/two/b"', render_pass="/pass")
    assert reading.has("/one/b") and reading.has("/two/a") and not reading.has("/two/b"), "patterns may name parts, too"


@pytest.mark.parametrize("pattern, groups", [("/elsewhere//", 1), ("//b", 1), ("/one/b /three/b", 2)])
def test_instances_of_which_a_pattern_holds_the_same_share_their_prims(read, pattern, groups):
    rule = f'uniform pathExpression collection:prune:membershipExpression = "{pattern}"'
    reading = read(INSTANCES % rule, render_pass="/pass")
    assert reading.text.count("Instancer ") == groups


def test_rules_cost_only_the_instances_that_they_name(read, steps):
    def stage(count):
        things = "".join(f'def Xform "i{i}" (prepend references = </thing>  instanceable = true) {{ }}  ' for i in range(count))
        rules = ", ".join(f"</i{i}/b>" for i in range(0, count, 2))
        return INSTANCES % f"rel collection:prune:includes = [{rules}]" + things

    assert steps(stage(160), render_pass="/pass") <= 2 * steps(stage(80), render_pass="/pass"), "twice as much costs twice"


def test_a_pass_without_its_lights_gets_no_headlight(read):
    reading = read(SCENE % "rel collection:prune:includes = </set/lamp>", render_pass="/pass", headlight=True)
    assert not reading.info.headlight
    unlit = SCENE.replace('def SphereLight "lamp" { }', "") % "rel collection:prune:includes = </c>"
    assert read(unlit, render_pass="/pass", headlight=True).info.headlight, "it never had lights"


def test_what_is_no_pass_is_told(read):
    for path in ("/c", "/none", "no path"):
        with pytest.raises(StageError, match="is no UsdRenderPass prim"):
            read(SCENE % "", render_pass=path)
