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
