# SPDX-License-Identifier: Apache-2.0
"""Input beyond a limit is left out with a message that names it, and the rest is shown."""
import json
import os
import subprocess
import sys

import numpy as np
import pytest

import inProcess
import mtlx
from patina import limits
import usda

HEAD = usda.stage(usda.camera(at=(0, 0, 6)), usda.prim("DomeLight", "dome"), up="")
BALL = usda.prim("Sphere", "ball")


def textured(file="t.png"):
    return usda.material("m", {"s": ("UsdPreviewSurface", {"color3f diffuseColor": "<t>"}),
                               "t": ("UsdUVTexture", {"file": file}, "color3f rgb")}, surface="s")


def quad(name, **values):
    return usda.card(name, 1, **values)


def instances(name, count, prototype=BALL):
    return usda.prim("PointInstancer", name, f"rel prototypes = [</{name}/ball>]", prototype, protoIndices=[0] * count,
                     positions=[(float(i), 0.0, 0.0) for i in range(count)])


def chained(length):
    """:returns: a material whose colour passes so many nodes"""
    nodes = {f"n{i}": ("ND_add_color3", {"color3f in1": f"<n{i + 1}>"}, "color3f out") for i in range(length)}
    return usda.material("m", {"s": ("UsdPreviewSurface", {"color3f diffuseColor": "<n0>"}), **nodes,
                               f"n{length}": ("ND_constant_color3", {"value": (0.5, 0.5, 0.5)}, "color3f out")}, surface="s")


CASES = {  # limit -> stage, what the message names, and its words
    "triangles=3": (quad("a") + quad("b"), "/b",
                    "more triangles than 3 (--limit triangles); the prim is left out, and 0 others"),
    "prims=1": (quad("a") + quad("b"), "/b", "more prims of a kind than 1 (--limit prims)"),
    "instances=5": (instances("few", 3) + instances("many", 4), "/many", "more instances than 5 (--limit instances)"),
    "lights=2": (quad("a") + usda.prim("SphereLight", "x") + usda.prim("SphereLight", "y"), "/y",
                 "more lights, each wherever it is placed, than 2 (--limit lights); the light is off"),
    "chain=20": (chained(30) + quad("a", bind="m"), "/m/n", "more nodes follow each other than 20 (--limit chain)"),
    "textLength=9": (quad("a") + quad("aVeryLongName"), "/aVeryLongName", "more bytes in a path than 9 (--limit textLength)"),
    "nodes=1": (textured() + quad("a", bind="m"), "/m", "more nodes than 1 (--limit nodes)"),
    "textureBytes=40": (textured() + quad("a", bind="m"), "/m/t",
                        "4x4 texels takes more bytes than 40 (--limit textureBytes)"),
    "imageBytes=20": (textured() + quad("a", bind="m"), "/m/t", "bytes; at most 20 (--limit imageBytes) are read"),
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
    assert [w["message"] for w in told if w["prim"].startswith(prim) and words in w["message"]], told
    # It held for that command alone.
    assert not [w for w in rendered(tmp_path, text)[1] if "--limit" in w["message"]]
    assert limits.value(limit.partition("=")[0]) == limits.table()[limit.partition("=")[0]][0]


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
        (tmp_path / f"{name}.mtlx").write_text(mtlx.document(body))
    wanted = {"markup": "many", "nesting": "deep", "documentBytes": "long"}.get(limit.partition("=")[0], "1")
    (tmp_path / "main.mtlx").write_text(mtlx.document(f"<xi:include href='{wanted}.mtlx'/>", mtlx.shader("M")))
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


def test_triangles_that_glow_beyond_the_limit_are_found_by_chance(tmp_path):
    """The same light with more noise. Five standard errors of two means over pixels: a significance of 6e-7."""
    glow = usda.preview("m", emissiveColor=(1, 2, 3), diffuseColor=(0, 0, 0), ior=1)
    panel = usda.mesh("ball", [(-0.4, 1, -1), (0.4, 1, -1), (0.4, 1, 3), (-0.4, 1, 3)], bind="m")
    text = glow + instances("panels", 4, panel) + quad("floor", color=(0.5, 0.5, 0.5))

    def lit(*flags):
        image, told = rendered(tmp_path, text, "-w", 24, "--samples", 256, *flags)
        middle = image[10:14, 10:14, :3].reshape(-1, 3).astype(float)
        return middle.mean(0), middle.std(0) / len(middle) ** 0.5, told

    mean, error, told = lit()
    limited, more, messages = lit("--limit", "lights=5")
    assert not [w for w in told if "--limit" in w["message"]]
    assert [w["prim"] for w in messages if "more glowing triangles" in w["message"]], messages
    assert (mean > 0.01).all() and (abs(mean - limited) < 5 * np.hypot(error, more)).all(), (mean, limited, error, more)


@pytest.mark.skipif(bool(inProcess.without_opengl()), reason="the rasterizer cannot run here")
def test_the_rasterizer_lists_so_many_prims_at_their_places(tmp_path):
    balls = (usda.prim("Sphere", f"b{i}") for i in range(5))
    text = instances("many", 40, usda.prim("Xform", "ball", *balls))
    image, told = rendered(tmp_path, text, "--limit", "instances=100", "--backend", "raster")
    assert np.isfinite(image).all()
    assert [w for w in told if "more prims, each wherever it is placed, than 100 (--limit instances)" in w["message"]], told
    assert not [w for w in rendered(tmp_path, text, "--limit", "instances=100")[1] if "--limit" in w["message"]]
