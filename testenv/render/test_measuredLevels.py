# SPDX-License-Identifier: Apache-2.0
"""Levels of detail by measured error: fewer triangles where the camera does not see the difference."""
import json
import math
import subprocess
import sys

import pytest

from usda import camera, preview, prim, stage

CAMERA = stage(camera(lens=(40, 40, 30), clippingRange=(0.1, 10000)), preview("grey"), up="")
ROOT = prim("Xform", "%s", "%s", "%s", apis=("LODRootAPI", "LODOverrideAPI"), at="(%g, 0, %g)")
LEVELS = {"fine": 48, "middle": 16, "coarse": 6}


def ball(name, count):
    """A ball of radius 1 of so many quads around and half as many from pole to pole."""
    rows = count // 2
    points = [(math.sin(math.pi * i / rows) * math.cos(2 * math.pi * k / count), math.cos(math.pi * i / rows),
               -math.sin(math.pi * i / rows) * math.sin(2 * math.pi * k / count))
              for i in range(rows + 1) for k in range(count)]
    quads = [(i * count + k, (i + 1) * count + k, (i + 1) * count + (k + 1) % count, i * count + (k + 1) % count)
             for i in range(rows) for k in range(count)]
    return prim("Mesh", name, bind="grey", subdivisionScheme="none",
                points=[", ".join("(%.5f, %.5f, %.5f)" % p for p in points)],
                faceVertexCounts=[", ".join("4" for _ in quads)],
                faceVertexIndices=[", ".join(str(i) for quad in quads for i in quad)])


BALLS = "\n".join(ball(*level) for level in LEVELS.items())


def root(name, x, distance, lines=""):
    return ROOT % (name, x, -distance, lines, BALLS)


def measured(tmp_path, *roots, tolerance=0.05, levels="measured"):
    """:returns: path -> root, as explain tells it in JSON"""
    (tmp_path / "s.usda").write_text(CAMERA + "\n".join(roots), encoding="utf-8")
    found = subprocess.run([sys.executable, "-m", "patina", "explain", tmp_path / "s.usda", "--tolerance", str(tolerance),
                            "--levels", levels, "--json"], capture_output=True, text=True, check=True)
    return {r["path"]: r for r in json.loads(found.stdout)["levels"]}


def drawn(found):
    return {path: r["names"][r["chosen"]] for path, r in found.items()}


def test_what_is_far_has_fewer_triangles(tmp_path):
    found = measured(tmp_path, root("a", -1, 6), root("b", 3, 12), root("c", -600, 2000))
    assert drawn(found) == {"/a": "fine", "/b": "middle", "/c": "coarse"}
    for r in found.values():
        assert r["names"] == list(LEVELS) and r["truth"] == 0 and r["errors"][0] == 0.0
        assert r["errors"][1] <= r["errors"][2] and r["triangles"] == sorted(r["triangles"], reverse=True)
    assert sum(r["errors"][r["chosen"]] for r in found.values()) <= 0.1 * 0.05


def test_a_larger_tolerance_takes_a_coarser_level_and_roots_share_it(tmp_path):
    near = root("a", 0, 6)
    errors = measured(tmp_path, near)["/a"]["errors"]
    assert 0.0 < errors[1] < errors[2]
    assert drawn(measured(tmp_path, near, tolerance=10.1 * errors[1]))["/a"] == "middle"
    assert drawn(measured(tmp_path, near, tolerance=9.9 * errors[1]))["/a"] == "fine"
    both = drawn(measured(tmp_path, near, root("b", 0, 6), tolerance=10.1 * errors[1]))
    assert sorted(both.values()) == ["fine", "middle"]


def test_the_stage_says_what_the_truth_is_and_overrides_stay(tmp_path):
    middle = root("a", 0, 2000, "int lod:default:index = 1")
    found = measured(tmp_path, middle, root("b", 0, 2000, 'token lod:override:mode = "indexedLOD"'))
    assert list(found) == ["/a"] and found["/a"]["truth"] == 1 and found["/a"]["errors"][1] == 0.0
    assert drawn(found) == {"/a": "coarse"}


def test_what_the_camera_does_not_see_and_other_calls_keep_the_level_of_the_stage(tmp_path):
    assert measured(tmp_path, root("a", 0, -50)) == {}
    assert measured(tmp_path, root("a", 0, 2000), levels="stage") == {}


def test_record_draws_them(tmp_path):
    (tmp_path / "s.usda").write_text(CAMERA + root("a", 0, 2000), encoding="utf-8")

    def frame(*flags):
        found = subprocess.run([sys.executable, "-m", "patina", "record", tmp_path / "s.usda", tmp_path / "s.exr", "-w", "32",
                                "--samples", "1", "--json", "--quiet", *flags], capture_output=True, text=True)
        return json.loads(found.stdout)["frames"][0] if found.returncode == 0 else found.stderr

    whole, fewer = frame("--tolerance", "0.1"), frame("--tolerance", "0.1", "--levels", "measured")
    assert fewer["levels"][0]["triangles"][2] == fewer["trianglesStored"] < whole["trianglesStored"]
    assert "needs a --tolerance" in frame("--levels", "measured")


@pytest.mark.parametrize("instanceable", ("true", "false"))
def test_each_native_instance_has_its_own(tmp_path, instanceable):
    asset = 'class Xform "asset" { ' + root("root", 0, 0) + "}\n"
    places = "".join(f"""def Xform "i{k}" (prepend references = </asset>
        instanceable = {instanceable}) {{ double3 xformOp:translate = ({x}, 0, {-z})
        uniform token[] xformOpOrder = ["xformOp:translate"]
        }}\n""" for k, (x, z) in enumerate(((0, 6), (600, 2000))))
    assert drawn(measured(tmp_path, asset, places)) == {"/i0/root": "fine", "/i1/root": "coarse"}
