# SPDX-License-Identifier: Apache-2.0
"""Bindings of native instances by collections and for purposes: the same as where nothing is instanceable."""
import re

import pytest

MATERIALS = "".join(f"""
    def Material "{name}" {{ token outputs:surface.connect = </{name}/s.outputs:out>
        def Shader "s" {{ uniform token info:id = "UsdPreviewSurface"  token outputs:out }} }}""" for name in ("red", "green"))
API = 'prepend apiSchemas = ["MaterialBindingAPI", "CollectionAPI:k"]'
STRONGER = '(bindMaterialAs = "strongerThanDescendants")'


def by(owner, parts, more=""):
    """:returns: statements of a prim that binds red to all and green to parts"""
    includes = f"rel collection:k:includes = [{parts}]" if parts else ""
    return f"""{more}  {includes}
        rel material:binding = </red>
        rel material:binding:collection:k = [<{owner}.collection:k>, </green>]"""


def asset(root="", child=""):
    return f"""
    class Xform "a" ({API}) {{ {root}
        def Cube "c" ({API}) {{ {child} }}
        def Sphere "s" {{ }}
    }}"""


def instances(*statements):
    return "".join(f'\ndef Xform "i{i}" (instanceable = true; inherits = </a>; {API}) {{ {own} }}'
                   for i, own in enumerate(statements))


def within(text, own):
    return f'\ndef Xform "g" ({API}) {{ {own} {text} }}'


FULL, ALL = "rel material:binding:full = </green>", "rel material:binding = </red>"
STAGES = {
    "asset's own": asset(by("/a", "</a/s>")) + instances("", ""),
    "of the stage": asset() + within(instances("", "", ""), by("/g", "</g/i1/s>, </g/i2>")),
    "the root alone": asset() + within(instances(""), by("/g", "</g/i0>", 'uniform token collection:k:expansionRule = '
                                                         '"explicitOnly"')),
    "all but one": asset() + within(instances("", ""), by("/g", "</g>", "rel collection:k:excludes = </g/i0/c>")),
    "by pattern": asset() + within(instances("", ""), by("/g", "", 'pathExpression collection:k:membershipExpression = "//s"')),
    "stronger beside": asset("", ALL) + within(instances("", ""), by("/g", "</g>").replace("</red>", f"</red> {STRONGER}")),
    "nested": asset() + f"""
    class Xform "b" ({API}) {{ {by("/b", "</b/i0/s>")} {instances("", "")} }}
    def Xform "x" (instanceable = true; inherits = </b>) {{ }}
    def Xform "y" (instanceable = true; inherits = </b>) {{ }}""",
    "full above": asset(FULL, ALL) + instances(""),
    "full below": asset("", FULL) + instances(ALL + STRONGER),
    "full between": asset("", ALL) + within(instances(FULL), ALL + STRONGER),
    "full above all": asset("", ALL) + within(instances(ALL), FULL),
}


@pytest.mark.parametrize("purpose", ["full", ""])
@pytest.mark.parametrize("name", STAGES)
def test_instances_show_what_plain_prims_show(read, name, purpose):
    text = MATERIALS + STAGES[name]
    plain = read(text.replace("instanceable = true", "instanceable = false"), material_purpose=purpose)
    shared = read(text, material_purpose=purpose)
    drawn = re.findall(r"^Implicit (\S+)", shared.text, re.M)
    assert drawn and not shared.warnings
    for path in drawn:
        assert shared.prim(path).get("material") == plain.prim(path).get("material"), path


def test_instances_that_collections_divide_alike_share_a_prototype(read):
    own = read(MATERIALS + asset(by("/a", "</a/s>")) + instances(*[""] * 5))
    assert own.prim("/i0")["instances"] == "5"
    above = read(MATERIALS + asset() + within(instances(*[""] * 5), by("/g", "</g/i1/s>, </g/i3/s>, </g/i4>")))
    assert [above.prim(f"/g/i{i}")["instances"] for i in (0, 1, 4)] == ["2", "2", "1"]
    assert above.prim("/g/i1/s")["material"] == '"/green"' and above.prim("/g/i0/s")["material"] == '"/red"'


def test_instances_that_bind_a_material_of_their_own_asset_share_a_prototype(read):
    looks = MATERIALS.replace("</red/", "</a/red/").replace("</green/", "</a/green/")
    reading = read(asset("rel material:binding = </a/red>" + looks) + instances("", "", ""))
    assert reading.prim("/i0")["instances"] == "3" and reading.prim("/i0/s")["material"] == '"/i0/red"'


def named_by(count):
    """:returns: statements of a prim with as many collections as instances, each of which names a part of one"""
    return within(instances(*[""] * count), "".join(f"""
        rel collection:k{i}:includes = </g/i{i}/s>
        rel material:binding:collection:k{i} = [</g.collection:k{i}>, </green>]""" for i in range(count))).replace(
            '"CollectionAPI:k"', ", ".join(f'"CollectionAPI:k{i}"' for i in range(count)), 1)


def test_collections_cost_only_the_instances_that_they_name(read, steps):
    few, many = (MATERIALS + asset() + named_by(count) for count in (40, 80))
    reading = read(few)
    assert all(reading.prim(f"/g/i{i}/s")["material"] == '"/green"' for i in range(40))
    assert steps(many) <= 2 * steps(few), "twice as much of both costs twice, not four times"


@pytest.mark.parametrize("pattern, shared", [("/elsewhere//", ["4"]), ("//s", ["4"]), ("/g//", ["4"]),
                                             ("/g/i1/s /g/i3/s", ["2", "2"])])
def test_instances_of_which_a_pattern_holds_the_same_share_a_prototype(read, pattern, shared):
    own = by("/g", "", f'pathExpression collection:k:membershipExpression = "{pattern}"')
    reading = read(MATERIALS + asset() + within(instances(*[""] * 4), own))
    assert re.findall(r" instances = (\d+)", reading.text) == shared


@pytest.mark.parametrize("how", ["true", "false"])
@pytest.mark.parametrize("name", STAGES)
def test_a_binding_by_what_is_no_collection_is_left_out_alone(read, name, how):
    text = MATERIALS + STAGES[name].replace("instanceable = true", f"instanceable = {how}")
    text = text if 'Xform "g"' in text else text + within("", "")
    broken = 'rel material:binding:collection:b = [</g.nothing>, </red>]  def Sphere "own" { }\n'
    good = read(text, material_purpose="")
    bad = read(re.sub(r'(def Xform "g" \(.*?\) \{)', rf"\1 {broken}", text), material_purpose="")
    drawn = re.findall(r"^Implicit (\S+)", good.text, re.M)
    assert drawn and [bad.prim(path).get("material") for path in drawn] == [good.prim(path).get("material") for path in drawn]
    assert bad.has("/g/own") and not good.warnings
    told, = bad.warnings
    assert told.startswith("/g material:binding:collection:b: ") and "/g.nothing, which is no collection" in told
