# SPDX-License-Identifier: Apache-2.0
"""Colours by face and by vertex of spheres, cubes and the like: where OpenUSD's meshes of them have them, in every host."""
import math

import numpy as np
import pytest

import hydraBuild
import stages
from rendering import color
from test_oneTruth import MODES, render_with_reader
from usda import camera, prim, stage

AROUND = 10
# prim -> (faces, points, those of the lower half, first face of the side that looks at the camera)
ROUND = {"Sphere": (100, 92, 46, 40), "Cylinder": (30, 42, 21, 10), "Cone": (20, 31, 21, 10), "Capsule": (90, 82, 41, 40)}
COLORS = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
WIDTH = 96
PITCH = 4.0  # between prims, whose middles are in a row


def stage_of(colors, interpolation):
    """:param colors: prim -> list of displayColor"""
    prims = [
        prim(kind, kind.lower(), f'color3f[] primvars:displayColor = {list(values)} (interpolation = "{interpolation}")',
             at=(i * PITCH, 0, 0), **({"axis": "Y"} if kind in ("Cylinder", "Cone", "Capsule") else {}))
        for i, (kind, values) in enumerate(colors.items())]
    span = len(colors) * PITCH
    return stage(
        camera(flat=(10 * span, 10 * PITCH), clippingRange=(1, 100), at=((span - PITCH) / 2, 0, 20)),
        prim("DomeLight", "dome"), *prims,
        up="")


def check(colors, interpolation, expected, tmp_path, scene_index):
    """:param expected: prim -> list of (x, y, number of one of COLORS) on the prim as the camera sees it"""
    if scene_index:
        hydraBuild.skip_before(2411, "scene indices leave planes out, with a warning")
    shot = stages.shot_of(stage_of(colors, interpolation), tmp_path, width=WIDTH * len(colors))
    hydra = tmp_path / "hydra.exr"
    process = hydraBuild.run_host(shot.stage, hydra, *shot.host_flags(), "--set", "samples=4", scene_index=scene_index)
    assert not hydraBuild.warnings_of(process) and not shot.scene.warnings()
    for host, image in (("reader", render_with_reader(shot)), ("hydra", color(hydra))):
        for i, kind in enumerate(colors):
            for x, y, wanted in expected[kind]:
                column = int((i + 0.5 + x / PITCH) * WIDTH)
                row = int((0.5 - y / PITCH) * WIDTH)
                assert int(np.argmax(image[row, column])) == wanted, (host, kind, x, y, image[row, column])


@MODES
def test_colors_of_faces(tmp_path, scene_index):
    """Faces go around by 36 degrees: from the camera's direction to +x for an axis y, from +x to +y for a sphere."""
    colors, expected = {}, {}
    for kind, (faces, _, _, first) in ROUND.items():
        colors[kind] = [COLORS[face % 3] for face in range(faces)]
        if kind != "Sphere":  # two faces to the right and two to the left of the middle
            sines = {face: math.sin(math.radians(36 * (face + 0.5))) for face in (0, 1, 8, 9)}
            radius = 1.0 if kind == "Cylinder" else 0.5  # of a cone at half of its height
            expected[kind] = [(radius * x, 0.0, (first + face) % 3) for face, x in sines.items()]
    # Of a sphere the faces around its pole are seen: rings of 18 degrees.
    expected["Sphere"] = [(math.sin(math.radians(polar)) * math.cos(math.radians(36 * (i + 0.5))),
                           math.sin(math.radians(polar)) * math.sin(math.radians(36 * (i + 0.5))), (first + i) % 3)
                          for polar, first in ((27, 80), (45, 70)) for i in range(AROUND)]
    colors["Cube"], colors["Plane"] = [COLORS[1], *[COLORS[0]] * 5], [COLORS[2]]
    expected["Cube"], expected["Plane"] = [(0.5, -0.3, 1)], [(0.2, 0.7, 2)]
    check(colors, "uniform", expected, tmp_path, scene_index)


@MODES
@pytest.mark.parametrize("interpolation", ["vertex", "varying"])
def test_colors_of_points(tmp_path, interpolation, scene_index):
    """The lower half of the points along the axis is red, the upper one blue."""
    colors, expected = {}, {}
    for kind, (_, points, lower, _) in ROUND.items():
        if kind != "Sphere":
            colors[kind] = [COLORS[0]] * lower + [COLORS[2]] * (points - lower)
            expected[kind] = [(0.1, -0.7, 0), (0.1, 0.4 if kind == "Cone" else 0.7, 2)]
    colors["Cube"] = [COLORS[2 if point in (0, 1, 5, 6) else 0] for point in range(8)]
    colors["Plane"] = [COLORS[2], COLORS[2], COLORS[0], COLORS[0]]
    expected["Cube"] = expected["Plane"] = [(0.2, -0.6, 0), (0.2, 0.6, 2)]
    colors["Sphere"] = [COLORS[1]] * 92
    for i in range(AROUND):  # the ring of points at 36 degrees from the pole that is seen
        colors["Sphere"][1 + 7 * AROUND + i] = COLORS[0 if 0 <= i < 5 else 2]
    expected["Sphere"] = [(0.588 * math.cos(angle), 0.588 * math.sin(angle), wanted)
                          for angle, wanted in ((math.radians(72), 0), (math.radians(252), 2))]
    check(colors, interpolation, expected, tmp_path, scene_index)


@MODES
def test_wrong_numbers_are_told_alike(tmp_path, scene_index):
    shot = stages.shot_of(stage_of({"Sphere": COLORS}, "vertex"), tmp_path)
    render_with_reader(shot)
    process = hydraBuild.run_host(shot.stage, tmp_path / "hydra.exr", *shot.host_flags(), "--set", "samples=1",
                                  scene_index=scene_index)
    told = "3 elements where vertex interpolation needs 92; the primvar is ignored"
    assert [(w["prim"], w["input"], w["message"]) for w in shot.scene.warnings()] == [
        ("/sphere", "primvars:displayColor", told)]
    said = hydraBuild.warnings_of(process)
    assert len(said) == 1 and "/sphere" in said[0] and "displayColor" in said[0] and told in said[0], said
