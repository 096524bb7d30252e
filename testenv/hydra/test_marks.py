# SPDX-License-Identifier: Apache-2.0
"""Marks of prims through Hydra: the text of the scene has what each says, and Cryptomatte is a product of the stage."""
import pytest

import hydraBuild
import stages
from rendering import color
from test_oneTruth import MODES, compare, render_with_hydra
import usda

STAGE = usda.stage(
    usda.camera(at=(0, 0, 10)),
    usda.prim("Sphere", "arnold", "bool primvars:arnold:visibility:camera = 0"),
    usda.prim("Sphere", "karma", 'string primvars:karma:object:rendervisibility = "-shadow"'),
    usda.prim("Sphere", "renderMan", "int primvars:ri:attributes:Ri:Matte = 1"),
    usda.prim(
        "Xform", "set", "bool primvars:patina:shadowCatcher = 1", 'string primvars:patina:cryptoObject = "ground"',
        usda.prim("Cube", "floor")),
    up="")


def block(text, path):
    """:returns: the lines of a prim in a dump"""
    lines, found = text.splitlines(), []
    start = next(i for i, line in enumerate(lines) if line.endswith(" " + path) and not line.startswith(" "))
    for line in lines[start + 1:]:
        if not line.startswith(" "):
            break
        found.append(line.strip())
    return found


@MODES
@pytest.mark.parametrize("path, said", [
    ("/arnold", ["visibility camera = false"]), ("/karma", ["visibility shadow = false"]), ("/renderMan", ["matte = true"]),
    ("/set/floor", ["catches shadows = true", 'matteName = "ground"'])])
def test_marks_are_read(tmp_path, scene_index, path, said):
    shot = stages.shot_of(STAGE, tmp_path, width=8)
    _, text = render_with_hydra(shot, tmp_path, scene_index)
    for dump in (text, shot.scene.dump()):
        for line in said:
            assert line in block(dump, path), dump


ASSET = usda.prim("Xform", "asset", usda.card("tile", 0.5, color=(0.4, 0.3, 0.2)), specifier="class")
MARKS = ("", "bool primvars:arnold:visibility:camera = 0", "bool primvars:arnold:matte = 1",
         'string primvars:karma:object:rendervisibility = "-primary"')


def native(tmp_path):
    """:returns: a Shot of a row of instances, one for each of MARKS"""
    placed = (usda.prim("Xform", f"i{i}", mark, meta=("inherits = </asset>", "instanceable = true"), at=(2 * i - 3, 0, 0))
              for i, mark in enumerate(MARKS))
    return stages.shot_of(stages.front(8, 4, ASSET, *placed), tmp_path)


def seen_in(image):
    """:returns: the sky, and what is in the middle of each instance"""
    row = image[image.shape[0] // 2]
    return row[0], [row[int((2 * i - 3 + 4) / 8 * len(row))] for i in range(len(MARKS))]


@MODES
def test_marks_of_native_instances(tmp_path, scene_index):
    """Hydra makes values of the instances of them."""
    shot = native(tmp_path)
    image, _ = render_with_hydra(shot, tmp_path, scene_index)
    compare(shot, image, scene_index)
    sky, seen = seen_in(image)
    assert (seen[0] < 0.6 * sky).all() and (seen[2] == 0).all(), seen
    assert seen[1] == pytest.approx(sky) and seen[3] == pytest.approx(sky)


def test_the_rasterizer_hides_instances_and_tells_the_rest(tmp_path):
    shot, image = native(tmp_path), tmp_path / "raster.exr"
    process = hydraBuild.run_host(shot.stage, image, *shot.host_flags(), "--set", "samples=4", "--set", "backend=raster",
                                  scene_index=True)
    sky, seen = seen_in(color(image))
    assert all((seen[i] < 0.6 * sky).all() for i in (0, 2)), seen
    assert seen[1] == pytest.approx(sky, rel=0.01) and seen[3] == pytest.approx(sky, rel=0.01)
    assert any("rasterizer" in line for line in hydraBuild.warnings_of(process)), process.stderr
