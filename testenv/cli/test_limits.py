# SPDX-License-Identifier: Apache-2.0
"""Input beyond a limit is left out with a message that names it, and the rest is shown."""
import json
import os
import subprocess
import sys

import numpy as np
import pytest

import inProcess
from patina import limits

HEAD = '#usda 1.0\ndef Camera "camera"\n{\n    double3 xformOp:translate = (0, 0, 6)\n' \
       '    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\ndef DomeLight "dome"\n{\n}\n'
QUAD = 'def Mesh "%s"\n{\n    int[] faceVertexCounts = [4]\n    int[] faceVertexIndices = [0, 1, 2, 3]\n' \
       '    point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]\n' \
       '    uniform token subdivisionScheme = "none"\n}\n'
INSTANCES = 'def PointInstancer "%s"\n{\n    rel prototypes = [</%s/ball>]\n    int[] protoIndices = %s\n' \
            '    point3f[] positions = %s\n    def Sphere "ball"\n    {\n    }\n}\n'
PREVIEW = 'def Material "m"\n{\n    token outputs:surface.connect = </m/s.outputs:surface>\n    def Shader "s"\n    {\n' \
          '        uniform token info:id = "UsdPreviewSurface"\n        token outputs:surface\n' \
          '        color3f inputs:diffuseColor.connect = </m/t.outputs:rgb>\n    }\n    def Shader "t"\n    {\n' \
          '        uniform token info:id = "UsdUVTexture"\n        asset inputs:file = @%s@\n' \
          '        color3f outputs:rgb\n    }\n}\n'


def instances(name, count):
    return INSTANCES % (name, name, [0] * count, [(float(i), 0.0, 0.0) for i in range(count)])


def bound(prim):
    return prim.replace("{", "{\n    rel material:binding = </m>", 1)


CASES = {  # limit -> stage, what the message names, and its words
    "triangles=3": (QUAD % "a" + QUAD % "b", "/b",
                    "more triangles than 3 (--limit triangles); the prim is left out, and 0 others"),
    "prims=1": (QUAD % "a" + QUAD % "b", "/b", "more prims of a kind than 1 (--limit prims)"),
    "instances=5": (instances("few", 3) + instances("many", 4), "/many", "more instances than 5 (--limit instances)"),
    "textLength=9": (QUAD % "a" + QUAD % "aVeryLongName", "/aVeryLongName", "more bytes in a path than 9 (--limit textLength)"),
    "nodes=1": (PREVIEW % "t.png" + bound(QUAD % "a"), "/m", "more nodes than 1 (--limit nodes)"),
    "textureBytes=40": (PREVIEW % "t.png" + bound(QUAD % "a"), "/m/t",
                        "4x4 texels takes more bytes than 40 (--limit textureBytes)"),
    "imageBytes=20": (PREVIEW % "t.png" + bound(QUAD % "a"), "/m/t", "bytes; at most 20 (--limit imageBytes) are read"),
}


def rendered(tmp_path, text, *flags):
    """:returns: an image, and what was warned of"""
    import _patina

    stage = tmp_path / "stage.usda"
    stage.write_text(HEAD + text)
    _patina.write_image(str(tmp_path / "t.png"), np.full((4, 4, 3), 0.5, np.float32), ["R", "G", "B"])
    done = inProcess.record(stage, tmp_path / "a.exr", "-w", 8, "--samples", 1, "--camera", "/camera",
                            f"--json={tmp_path / 'told.json'}", *flags, check=False)
    assert done.returncode == 0, done.stderr
    return inProcess.pixels(tmp_path / "a.exr"), json.loads((tmp_path / "told.json").read_text())["warnings"]


@pytest.mark.parametrize("limit", CASES)
def test_a_limit_is_met(limit, tmp_path):
    text, prim, words = CASES[limit]
    image, told = rendered(tmp_path, text, "--limit", limit)
    assert np.isfinite(image).all() and image.max() > 0
    assert [w["message"] for w in told if w["prim"] == prim and words in w["message"]], told
    # It held for that command alone.
    assert not [w for w in rendered(tmp_path, text)[1] if "--limit" in w["message"]]
    assert limits.value(limit.partition("=")[0]) == limits.table()[limit.partition("=")[0]][0]


MATERIAL = '<standard_surface name="s" type="surfaceshader"/><surfacematerial name="M" type="material">' \
           '<input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>'


def document(body):
    return f'<?xml version="1.0"?><materialx version="1.39">{body}</materialx>'


@pytest.mark.parametrize("limit, words", [
    ("includes=2", "more included documents than 2 (--limit includes)"),
    ("includeDepth=2", "more levels deep than 2 (--limit includeDepth)"),
    ("markup=20000", "more tags and attributes than the 20000 (--limit markup)"),
    ("nesting=8", "elements nested more levels deep than 8 (--limit nesting)"),
    ("documentBytes=9000", "bytes; at most"),
])
def test_a_document_meets_a_limit(limit, words, tmp_path):
    deep = "<a>" * 12 + "</a>" * 12
    many = "<a b=''/>" * 11000
    for name, body in (("1", "<xi:include href='2.mtlx'/>"), ("2", "<xi:include href='3.mtlx'/>"), ("3", ""), ("deep", deep),
                       ("many", many), ("long", " " * 10000)):
        (tmp_path / f"{name}.mtlx").write_text(document(body))
    wanted = {"markup": "many", "nesting": "deep", "documentBytes": "long"}.get(limit.partition("=")[0], "1")
    (tmp_path / "main.mtlx").write_text(document(f"<xi:include href='{wanted}.mtlx'/>" + MATERIAL))
    albedo = ("bsdf", "albedo", tmp_path / "main.mtlx", "--wo", "0,0,1")
    plain, limited = inProcess.patina(*albedo), inProcess.patina(*albedo, "--limit", limit)
    assert limited.stdout == plain.stdout and words in limited.stderr and words not in plain.stderr, limited.stderr


@pytest.mark.parametrize("text, words", [("nodes", "NAME=VALUE"), ("nodes=-1", "whole number"), ("nothing=1", "no limit"),
                                         ("nodes=0", "from 1 to"), ("nesting=100000", "from 8 to 1000")])
def test_what_is_no_limit_is_wrong_usage(text, words, tmp_path):
    (tmp_path / "a.usda").write_text(HEAD)
    done = inProcess.record(tmp_path / "a.usda", tmp_path / "a.exr", "--limit", text, check=False)
    assert done.returncode == 2 and words in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize("command", ["record", "merge", "explain", "bsdf", "check", "bake", "shader", "view"])
def test_commands_that_read_files_have_the_flag(command):
    assert "--limit NAME=VALUE" in inProcess.patina(command, "--help").stdout


def test_all_are_listed():
    listed = inProcess.patina("record", "--limit", "list").stdout
    assert [line.split()[0] for line in listed.splitlines()] == list(limits.table())


def test_the_environment_sets_them_in_every_host():
    code = "import _patina; print(_patina.limits()['nodes'])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True,
                          env=dict(os.environ, PATINA_LIMITS="nodes=7 nothing=1 prims"))
    assert done.stdout == "7\n"
    assert "no limit 'nothing'" in done.stderr and "'prims' is not NAME=NUMBER" in done.stderr
