# SPDX-License-Identifier: Apache-2.0
"""Many warnings of few causes: what matters stands first, and is not hidden by what is met often."""
import json
import re

import pytest

from patina.cli import causes, main
from patina.cli.causes import Causes


def warning(message, prim="/p", name="", count=1):
    return {"prim": prim, "input": name, "message": message, "count": count}


MISSING = "texture '/textures/wood.png': the file cannot be opened; magenta is shown"


def test_one_missing_file_is_one_cause():
    found = Causes([warning(MISSING, f"/m{i}", f"image{i}.file") for i in range(561)]
                   + [warning("the mesh has no faces and is not drawn", "/hull", "faceVertexCounts")])
    assert [(g["count"], g["culprit"]) for g in found.groups] == [(561, "/textures/wood.png"), (1, "faceVertexCounts")]
    assert found.lines() == [f"warning: /m0.image0.file: {MISSING} (561 times at 561 prims, first this)",
                             "warning: /hull.faceVertexCounts: the mesh has no faces and is not drawn"]


@pytest.mark.parametrize("one, other", [
    (MISSING, MISSING.replace("wood", "iron")),
    ("unsupported node ND_a_float; the default is used", "unsupported node ND_b_float; the default is used"),
    ("prims of type PortalLight are not drawn", "prims of type PluginLight are not drawn"),
    ("there is no prim /a/b; it is not drawn", "there is no prim /a/c; it is not drawn")])
def test_another_culprit_is_another_cause(one, other):
    assert len(Causes([warning(one, "/p"), warning(other, "/q")])) == 2
    assert len(Causes([warning(one, "/p", "a"), warning(one, "/q", "b")])) == 1


def test_where_no_culprit_is_named_it_is_the_input():
    text = "is not a finite number; the fallback is used"
    assert len(Causes([warning(text, "/p", "x.inputs:radius"), warning(text, "/q", "y.inputs:radius")])) == 1
    assert len(Causes([warning(text, "/p", "radius"), warning(text, "/p", "height")])) == 2


def test_numbers_and_the_own_path_make_no_other_cause():
    assert len(Causes([warning("3 indices are out of range and read as 0", "/a", "primvars:st"),
                       warning("1500 indices are out of range and read as 0", "/b", "primvars:st")])) == 1
    assert len(Causes([warning("/a/b: a loop at </a/b>", "/a/b"), warning("/c/d: a loop at </c/d>", "/c/d")])) == 1


def test_what_is_missing_comes_first_then_what_is_met_most_often():
    found = Causes([warning("rare default is used", "/a"), warning("loop needs triangles; catmullClark is used", "/b", count=9),
                    warning("the material does not exist; displayColor is shown", "/c"),
                    warning("prims of type X are not drawn", "/d", count=3)])
    assert [(g["severity"], g["prim"]) for g in found.groups] == [
        ("missing", "/d"), ("missing", "/c"), ("changed", "/b"), ("changed", "/a")]


@pytest.mark.parametrize("reason", ("the file does not exist", "the file is a device, not a regular file",
                                    "no tile of it exists"))
def test_a_texture_that_is_missing_is_missing_for_whatever_reason(reason):
    assert causes.severity(warning(f"texture 'a.png': {reason}; its authored fallback, else magenta, is shown")) == "missing"


def test_the_terminal_shows_twenty_causes_and_counts_the_rest():
    letters = [chr(ord("a") + i) for i in range(26)]
    found = Causes([warning(f"{a}{a} is odd; box is used", f"/p{a}") for a in letters]
                   + [warning("the light is not finite; it is off", "/sun")])
    lines = found.lines()
    assert len(lines) == causes.MAX_CAUSES + 1 and lines[0].startswith("warning: /sun")
    assert lines[-1] == "warning: 7 more causes are in --json"


def test_where_there_are_too_many_culprits_of_one_kind_count_as_one():
    many = [warning(f"'{i}' is unknown; box is used", f"/p{i}", count=1 + (i == 7)) for i in range(30)]
    found = Causes(many + [warning("the light is not finite; it is off", "/sun"), warning("the default is used", "/q")])
    assert found.lines() == [
        "warning: /sun: the light is not finite; it is off",
        "warning: /p7: '7' is unknown; box is used (and 29 causes like it: 31 times, all in --json)",
        "warning: /q: the default is used"]
    assert len(found) == 32


def test_without_json_the_rest_is_counted():
    found = Causes([warning(f"'{i}' is unknown; box is used", f"/p{i}") for i in range(30)])
    assert found.lines(json=False) == ["warning: /p0: '0' is unknown; box is used (and 29 causes like it: 30 times)"]
    letters = [chr(ord("a") + i) for i in range(26)]
    found = Causes([warning(f"{a}{a} is odd; box is used", f"/p{a}") for a in letters])
    assert found.lines(json=False)[-1] == "warning: 6 more causes"


def test_names_stay_in_their_line():
    found = Causes([warning("node 's\n  error: forged\x1b[2J' is unknown; box is used", "/p\rq")])
    assert found.lines() == ["warning: /p q: node 's error: forged\\x1b[2J' is unknown; box is used"]


def test_what_was_told_is_told_again_only_at_the_end_and_when_there_is_more():
    reported = {}
    few, many = [[warning(MISSING, f"/m{i}") for i in range(n)] for n in (2, 50)]
    assert len(Causes(few).lines(reported, last=False)) == 1
    assert Causes(many).lines(reported, last=False) == []
    assert "(50 times" in Causes(many).lines(reported)[0]
    assert Causes(many).lines(reported) == []


STAGE = """#usda 1.0
def Camera "cam" {
    double3 xformOp:translate = (0, 0, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DomeLight "sky" { }
def Mesh "hull" {
    point3f[] points = [(0, 0, 0)]
}
"""
SPHERE = """def Sphere "s%d" ( prepend apiSchemas = ["MaterialBindingAPI"] ) {
    rel material:binding = </m%d>
}
def Material "m%d" {
    token outputs:surface.connect = </m%d/s.outputs:surface>
    def Shader "s" {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </m%d/t.outputs:rgb>
        token outputs:surface
    }
    def Shader "t" {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @missing.png@
        float3 outputs:rgb
    }
}
"""


@pytest.fixture
def stage(tmp_path):
    """30 materials with one missing texture, and a mesh without faces."""
    pytest.importorskip("_patina")
    path = tmp_path / "stage.usda"
    path.write_text(STAGE + "".join(SPHERE % ((i,) * 5) for i in range(30)))
    return path


def test_record_tells_causes(stage, tmp_path, capsys):
    image = tmp_path / "image.exr"
    out = tmp_path / "out.json"
    assert main.main(["record", str(stage), str(image), "--imageWidth", "8", "--samples", "1", f"--json={out}"]) == 0
    lines = [line for line in capsys.readouterr().err.splitlines() if "missing.png" in line]
    # two lines where a part of them was told while materials were compiled
    assert len(lines) in (1, 2) and "(30 times at 30 prims" in lines[-1]
    found = json.loads(out.read_text())
    assert len([w for w in found["warnings"] if "missing.png" in w["message"]]) == 30
    assert {g["count"] for g in found["causes"] if "missing.png" in g["culprit"]} == {30}
    assert any(g["prim"] == "/hull" and g["severity"] == "missing" for g in found["causes"])
    assert main.main(["record", str(stage), str(image), "--imageWidth", "8", "--samples", "1", "--strict"]) == 1
    said = capsys.readouterr().err.splitlines()
    assert not any(line.startswith("error:") for line in said)
    assert re.search(r"--strict: (1 warning|\d+ warnings, the worst): /", said[-1])


def test_explain_and_check_tell_causes(stage, capsys):
    assert main.main(["explain", str(stage), "--json"]) == 0
    captured = capsys.readouterr()
    assert "causes" in json.loads(captured.out)
    assert main.main(["check", f"{stage}:/m0", "--samples", "1024", "--places", "1", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [g["culprit"].endswith("missing.png") for g in found["causes"]] == [True] and len(found["warnings"]) == 1


@pytest.mark.parametrize("text", ["'" + "<" * 10 ** 6, "-" * 10 ** 6, "1" * 10 ** 6 + "a", "a." * 10 ** 6])
def test_long_names_in_messages_take_no_time_without_end(text):
    warning = {"prim": "/a", "input": "basis", "message": f"'{text}' is unknown; bezier is used", "count": 1}
    assert causes.Causes([warning]).groups[0]["message"] == warning["message"]


def test_printable_text_stays_in_its_line():
    assert causes.printable("a \n b") == "a b"
    assert causes.printable(" \t\r\n \na  b\v\n\u2003c \n") == " a  b c "
    assert causes.printable("a\tb\x1b\udcff") == "a\\tb\\x1b\\udcff"


@pytest.mark.parametrize("text, last", [(" " * 10 ** 6 + "x", "x"), (("\t" * 999 + "\n") * 1000, " "),
                                        ((" " * 10 ** 6 + "\n") + "\v" * 10 ** 6 + "y", " y")])
def test_long_blanks_take_no_time_without_end(text, last):
    assert causes.printable(text) == (text if "\n" not in text else last)


def test_a_long_warning_shows_its_ends():
    message = "'" + "a" * 10 ** 6 + "' is unknown; box is used"
    shown, = Causes([warning(message)]).lines()
    assert len(shown) < 2100 and shown.startswith("warning: /p: 'aaa") and shown.endswith("aaa' is unknown; box is used")
    assert Causes([warning(message)]).groups[0]["message"] == message
