# SPDX-License-Identifier: Apache-2.0
"""Bones of skeletons."""
import numpy as np
import pytest

ARM = """def Skeleton "s" {@more@ uniform token[] joints = ["a", "a/b", "a/b/c", "d"]
    uniform matrix4d[] bindTransforms = [( (1,0,0,0), (0,1,0,0), (0,0,1,0), (0,0,0,1) ),
        ( (1,0,0,0), (0,1,0,0), (0,0,1,0), (0,2,0,1) ), ( (1,0,0,0), (0,1,0,0), (0,0,1,0), (3,2,0,1) ),
        ( (1,0,0,0), (0,1,0,0), (0,0,1,0), (9,9,9,1) )]
    uniform matrix4d[] restTransforms = [( (1,0,0,0), (0,1,0,0), (0,0,1,0), (0,0,0,1) ),
        ( (1,0,0,0), (0,1,0,0), (0,0,1,0), (0,2,0,1) ), ( (1,0,0,0), (0,1,0,0), (0,0,1,0), (@reach@,0,0,1) ),
        ( (1,0,0,0), (0,1,0,0), (0,0,1,0), (9,9,9,1) )] }"""
GUIDES = {"purposes": ("render", "guide")}


def arm(reach=3, more=""):
    return ARM.replace("@reach@", str(reach)).replace("@more@", more and f" {more} ")


def test_bones_are_pyramids_from_parent_to_child(read, numbers):
    reading = read(arm(), **GUIDES)
    bones = reading.prim("/s")
    assert numbers(bones["points"]) == pytest.approx([
        0, 2, 0, 0.2, 0, 0.2, 0.2, 0, -0.2, -0.2, 0, -0.2, -0.2, 0, 0.2,
        3, 2, 0, 0, 2.3, 0.3, 0, 2.3, -0.3, 0, 1.7, -0.3, 0, 1.7, 0.3], abs=1e-6)
    assert numbers(bones["faceVertexIndices"])[:12] == [0, 2, 1, 0, 3, 2, 0, 4, 3, 0, 1, 4]
    assert len(numbers(bones["faceVertexCounts"])) == 8 and "scheme" not in bones and not reading.warnings


def test_the_framing_camera_shows_all_bones(read, numbers):
    reading = read(arm().replace("9,9,9", "0,0,0"), **GUIDES)
    camera = reading.prim(reading.info.camera)
    points = np.array(numbers(reading.prim("/s")["points"])).reshape(-1, 3)
    x, y, z, _ = (np.c_[points, np.ones(len(points))] @ np.linalg.inv(np.reshape(numbers(camera["transform"]), (4, 4)))).T
    lens = reading.scene.camera(reading.info.camera)
    for across, aperture in ((x, "horizontal_aperture"), (y, "vertical_aperture")):
        assert (np.abs(across / -z) <= lens[aperture] / lens["focal_length"] / 2).all()


def test_bones_follow_the_pose(read, numbers):
    """Tips move with their joint, bases with its parent."""
    points = np.array(numbers(read(arm(reach=5), **GUIDES).prim("/s")["points"])).reshape(-1, 3)
    assert points[5] == pytest.approx([5, 2, 0]) and points[6] == pytest.approx([0, 2.3, 0.3])


@pytest.mark.parametrize("purpose, shown", [("", False), ("default", True), ("guide", False), ("render", True)])
def test_bones_have_the_purpose_that_is_authored(read, purpose, shown):
    more = f'uniform token purpose = "{purpose}"' if purpose else ""
    assert read(arm(more=more)).has("/s") == shown
    above = f'def Xform "x" {{ {more}  ' + arm() + " }"
    assert read(above).has("/x/s") == shown


def test_skeletons_that_do_not_fit_are_told_of(read):
    reading = read("""def Skeleton "s" { uniform token[] joints = ["a", "a/b"] }
    def Skeleton "empty" { }""", **GUIDES)
    assert not reading.has("/s") and not reading.has("/empty")
    assert any(w.startswith("/s joints:") for w in reading.warnings)
    assert not any(w.startswith("/empty") for w in reading.warnings)
