# SPDX-License-Identifier: Apache-2.0
"""Many warnings of few causes: what matters stands first, and is not hidden by what is met often."""
import json
import re

import pytest

from patina import messages
from patina.cli import causes, main
from patina.cli.causes import Causes
import usda


def warning(id_, *fields, prim="/p", name="", count=1):
    return {**messages.warning(prim, name, id_, *fields), "count": count}


MISSING = ("textureUnreadable", "/textures/wood.png", "the file cannot be opened")
TEXT = "texture '/textures/wood.png': the file cannot be opened; magenta is shown"


def test_one_missing_file_is_one_cause():
    found = Causes([warning(*MISSING, prim=f"/m{i}", name=f"image{i}.file") for i in range(561)]
                   + [warning("meshWithoutFaces", prim="/hull", name="faceVertexCounts")])
    assert [(g["count"], g["culprit"]) for g in found.groups] == [(561, "/textures/wood.png"), (1, "faceVertexCounts")]
    assert found.lines() == [f"warning: /m0.image0.file: {TEXT} (561 times at 561 prims, first this)",
                             "warning: /hull.faceVertexCounts: the mesh has no faces and is not drawn"]


@pytest.mark.parametrize("one, other", [
    (MISSING, ("textureUnreadable", "/textures/iron.png", MISSING[2])),
    (MISSING, (*MISSING[:2], "out of memory")),
    (("inputMissing", "ND_a_float"), ("inputMissing", "ND_b_float")),
    (("typeNotDrawn", "PortalLight"), ("typeNotDrawn", "PluginLight")),
    (("projectionUnknown", "1"), ("projectionUnknown", "2")),
    (("prototypeNotFound", "/a/b"), ("prototypeNotFound", "/a/c"))])
def test_another_culprit_is_another_cause(one, other):
    assert len(Causes([warning(*one, prim="/p"), warning(*other, prim="/q")])) == 2
    assert len(Causes([warning(*one, prim="/p", name="a"), warning(*one, prim="/q", name="b")])) == 1


def test_where_no_culprit_is_named_it_is_the_input():
    found = Causes([warning("notFinite", prim="/p", name="x.inputs:radius"),
                    warning("notFinite", prim="/q", name="y.inputs:radius")])
    assert [g["culprit"] for g in found.groups] == ["radius"]
    assert len(Causes([warning("notFinite", name="radius"), warning("notFinite", name="height")])) == 2


def test_numbers_limits_and_the_own_path_make_no_other_cause():
    assert len(Causes([warning("indicesOutOfRange", 3, prim="/a", name="primvars:st"),
                       warning("indicesOutOfRange", 1500, prim="/b", name="primvars:st")])) == 1
    assert len(Causes([warning("compositionError", "/a/b: a loop at </a/b>", prim="/a/b"),
                       warning("compositionError", "/c/d: a loop at </c/d>", prim="/c/d")])) == 1
    assert len(Causes([warning("lightsTooMany", "7 (--limit lights)", prim="/a"),
                       warning("lightsTooMany", "8 (--limit lights)", prim="/b")])) == 1


def test_what_is_missing_comes_first_then_what_is_met_most_often():
    found = Causes([warning("wrongType", prim="/a"), warning("loopNeedsTriangles", prim="/b", count=9),
                    warning("materialMissing", "/m", prim="/c"), warning("typeNotDrawn", "X", prim="/d", count=3)])
    assert [(g["severity"], g["prim"]) for g in found.groups] == [
        ("missing", "/d"), ("missing", "/c"), ("changed", "/b"), ("changed", "/a")]


# Twenty-six messages that nothing is missing with.
CHANGED = [(id_, *row.fields) for id_, row in messages.table().items() if row.severity == "changed"][:26]
OFF = warning("lightNotFinite", prim="/sun")


def test_the_terminal_shows_twenty_causes_and_counts_the_rest():
    lines = Causes([*(warning(*one) for one in CHANGED), OFF]).lines()
    assert len(lines) == causes.MAX_CAUSES + 1 and lines[0].startswith("warning: /sun")
    assert lines[-1] == "warning: 7 more causes are in --json"
    assert Causes([warning(*one) for one in CHANGED]).lines(json=False)[-1] == "warning: 6 more causes"


def test_where_there_are_too_many_culprits_of_one_kind_count_as_one():
    many = [warning("basisUnknown", i, prim=f"/p{i}", count=1 + (i == 7)) for i in range(30)]
    found = Causes([*many, OFF, warning("wrongType", prim="/q")])
    assert found.lines() == [
        "warning: /sun: the light's colour or intensity is not finite; the light is off",
        "warning: /p7: '7' is unknown; bezier is drawn (and 29 causes like it: 31 times, all in --json)",
        "warning: /q: has a wrong type; the default is used"]
    assert len(found) == 32
    assert Causes(many[:7] + many[8:]).lines(json=False) == [
        "warning: /p0: '0' is unknown; bezier is drawn (and 28 causes like it: 29 times)"]


def test_names_stay_in_their_line():
    found = Causes([warning("basisUnknown", "s\n  error: forged\x1b[2J", prim="/p\rq")])
    assert found.lines() == ["warning: /p q: 's error: forged\\x1b[2J' is unknown; bezier is drawn"]


def test_what_was_told_is_told_again_only_at_the_end_and_when_there_is_more():
    reported = {}
    few, many = [[warning(*MISSING, prim=f"/m{i}") for i in range(n)] for n in (2, 50)]
    assert len(Causes(few).lines(reported, last=False)) == 1
    assert Causes(many).lines(reported, last=False) == []
    assert "(50 times" in Causes(many).lines(reported)[0]
    assert Causes(many).lines(reported) == []


STAGE = usda.stage(
    usda.camera(name="cam", at=(0, 0, 5)),
    usda.prim("DomeLight", "sky"),
    usda.prim("Mesh", "hull", points=[(0, 0, 0)]),
    up="")
SPHERE = (
    usda.prim("Sphere", "s%d", bind="m%d")
    + usda.material("m%d", {
                    "s": ("UsdPreviewSurface", {"color3f diffuseColor": "<t>"}),
                    "t": ("UsdUVTexture", {"file": "missing.png"})},
                    surface="s"))


@pytest.fixture
def stage(tmp_path):
    """30 materials with one missing texture, and a mesh without faces."""
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
    assert all(w["fields"].keys() == set(messages.table()[w["id"]].fields) for w in found["warnings"])
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
    for id_ in ("basisUnknown", "compositionError"):
        assert text in Causes([warning(id_, text)]).groups[0]["message"]


def test_printable_text_stays_in_its_line():
    assert causes.printable("a \n b") == "a b"
    assert causes.printable(" \t\r\n \na  b\v\n\u2003c \n") == " a  b c "
    assert causes.printable("a\tb\x1b\udcff") == "a\\tb\\x1b\\udcff"


@pytest.mark.parametrize("text, last", [(" " * 10 ** 6 + "x", "x"), (("\t" * 999 + "\n") * 1000, " "),
                                        ((" " * 10 ** 6 + "\n") + "\v" * 10 ** 6 + "y", " y")])
def test_long_blanks_take_no_time_without_end(text, last):
    assert causes.printable(text) == (text if "\n" not in text else last)


def test_a_long_warning_shows_its_ends():
    long = warning("basisUnknown", "a" * 10 ** 6)
    shown, = Causes([long]).lines()
    assert len(shown) < 2100 and shown.startswith("warning: /p: 'aaa") and shown.endswith("aaa' is unknown; bezier is drawn")
    assert Causes([long]).groups[0]["message"] == long["message"]
