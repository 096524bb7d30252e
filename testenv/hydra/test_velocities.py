# SPDX-License-Identifier: Apache-2.0
"""What velocities move through the shutter, and to a frame that lies between samples: by scene indices since OpenUSD 25.08."""
import pytest

import hydraBuild
import stages
from test_oneTruth import compare, rel_mse, render_with_hydra, render_with_reader
import usda

CORNERS = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
TILE = {"faceVertexCounts": [4], "faceVertexIndices": [0, 1, 2, 3], "subdivisionScheme": "none"}
TWO, UP = [(-2, 0, 0), (2, 0, 0)], [(0, 30, 0), (0, -50, 0)]
# name -> (type, lines and attributes of the prim, name of what moves, its value, velocities)
PRIMS = {
    "mesh": ("Mesh", (), TILE, "points", CORNERS, [(24, 0, 0), (24, 0, 0), (48, 0, 0), (48, 0, 0)]),
    "points": ("Points", (), {"widths": [0.5]}, "points", TWO, UP),
    "curves": ("BasisCurves", (), {"widths": [0.5], "curveVertexCounts": [2], "type": "linear"}, "points", TWO, UP),
    "instances": ("PointInstancer", ("rel prototypes = [</prim/tile>]", usda.prim("Mesh", "tile", points=CORNERS, **TILE)),
                  {"protoIndices": [0, 0]}, "positions", TWO, UP)}


@pytest.fixture(autouse=True)
def _new_enough():
    hydraBuild.skip_before(2508, "Hydra's scene index of velocities does not know the time codes per second")


def sampled(kind, name, value):
    """:returns: an attribute with the same value at two times"""
    return usda.attribute(f"{kind}[] {name}", {0: value, 6: value})


def shot_of(tmp_path, prim, shutter, frame, *more):
    kind, held, values, moved, value, velocities = PRIMS[prim]
    lines = (sampled("point3f", moved, value), sampled("vector3f", "velocities", velocities), *more)
    tmp_path.mkdir(exist_ok=True)
    return stages.shot_of(stages.front(
        8, 8, usda.prim(kind, "prim", *lines, *held, apis=("MotionAPI",), **values), startTimeCode=frame,
        camera=[f"double shutter:{end} = {time}" for end, time in zip(("open", "close"), shutter)]), tmp_path)


@pytest.mark.parametrize("shutter, frame", [((-0.5, 0.5), 0), ((0.0, 0.0), 0.75), ((0.0, 0.5), 2)])
@pytest.mark.parametrize("prim", PRIMS)
def test_hosts_agree(tmp_path, prim, shutter, frame):
    shot = shot_of(tmp_path, prim, shutter, frame)
    image, _ = render_with_hydra(shot, tmp_path, True)
    assert 0 < (image[..., 0] < 0.9).sum() < image[..., 0].size / 2
    compare(shot, image, True, 1e-4, "times of samples are rounded otherwise")


@pytest.mark.parametrize("prim, name, value", [
    ("mesh", "accelerations", [(0, 6000, 0), (0, 6000, 0), (0, 0, 0), (0, 0, 0)]),
    ("instances", "accelerations", [(6000, 0, 0), (0, 0, 0)]),
    ("instances", "angularVelocities", [(0, 0, 720), (0, 0, 0)])])
def test_hosts_agree_where_the_way_is_bent(tmp_path, prim, name, value):
    orientations = sampled("quath", "orientations", [(1, 0, 0, 0)] * 2) if prim == "instances" else ""
    # Two chords of 15 degrees are near enough to an arc: the command takes more times for faster turns, and Hydra does not.
    # Hydra is told of the count of instancers since OpenUSD 26.08; before, and without one, it is 3.
    told = prim == "mesh" or int(hydraBuild.folder("version")) >= 2608
    count = "int motion:nonlinearSampleCount = 5" if told else ""
    shot = shot_of(tmp_path, prim, (-0.5, 0.5), 0, orientations, count, sampled("vector3f", name, value))
    straight = shot_of(tmp_path / "straight", prim, (-0.5, 0.5), 0, orientations)
    image, _ = render_with_hydra(shot, tmp_path, True)
    compare(shot, image, True, 1e-4, "times of samples are rounded otherwise")
    assert rel_mse(render_with_reader(straight), image) > 1e-3
