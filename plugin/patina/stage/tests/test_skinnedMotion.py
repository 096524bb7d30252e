# SPDX-License-Identifier: Apache-2.0
"""Skinned points while the shutter is open: at each time that they are read at they are those of a still frame of that time."""
import numpy as np
import pytest

STAGE = """
    def SkelRoot "r" {
        def Skeleton "skel" (prepend apiSchemas = ["SkelBindingAPI"]) {
            uniform token[] joints = ["a", "a/b"]
            uniform matrix4d[] bindTransforms = [((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1)),
                ((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,1,0,1))]
            uniform matrix4d[] restTransforms = [((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1)),
                ((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,1,0,1))]
            rel skel:animationSource = </r/skel/anim>
            def SkelAnimation "anim" {
                uniform token[] joints = ["a", "a/b"]
                float3[] translations = [(0,0,0), (0,1,0)]
                half3[] scales = [(1,1,1), (1,1,1)]
                ANIMATION } }
        def Mesh "m" (prepend apiSchemas = ["SkelBindingAPI"]) {
            rel skel:skeleton = </r/skel>
            int[] faceVertexCounts = [3]
            int[] faceVertexIndices = [0, 1, 2]
            point3f[] points = [(0,0,0), (1,0,0), (0,2,0)]
            int[] primvars:skel:jointIndices = [0, 0, 1] (interpolation = "vertex"; elementSize = 1)
            float[] primvars:skel:jointWeights = [1, 1, 1] (interpolation = "vertex"; elementSize = 1)
            MESH } }"""
SHUTTER = {"frame": 5.0, "shutter": (-0.25, 0.25)}


def stage(animation="", mesh=""):
    return STAGE.replace("ANIMATION", animation).replace("MESH", mesh)


def samples_of(reading, path="/r/m"):
    """:returns: dict from times relative to the frame to points"""
    return {float(key[7:] or 0.0): np.array(value.replace(",", " ").split(), dtype=float).reshape(-1, 3)
            for key, value in reading.prim(path).items() if key == "points" or key.startswith("points@")}


MOVING = "float3[] translations.timeSamples = { 4: [(0,0,0), (0,1,0)], 6: [(0,0,0), (0,2,0)] }"
TURNING = "quatf[] rotations.timeSamples = { 4: %s, 6: [(0,1,0,0), (1,0,0,0)] }"
JOINTS = 'uniform token[] joints = ["a", "a/b"]'


@pytest.mark.parametrize("without, animation", [
    ("float3[] translations = [(0,0,0), (0,1,0)]", MOVING),
    ("float3[] translations = [(0,0,0), (0,1,0)]", MOVING + "  quatf[] rotations = []"),
    (JOINTS, TURNING % "[(1,0,0,0), (1,0,0,0)]"), ("-", TURNING % "None"), ("-", TURNING % "[]")],
    ids=["no rotations", "empty rotations", "no joints", "blocked rotations", "empty sample"])
def test_animations_that_pxr_cannot_use_leave_the_rest_pose(read, without, animation):
    skeleton, *rest = stage(animation).partition("def SkelAnimation")
    text = skeleton + "".join(rest).replace(without, "")
    found = samples_of(read(text, **SHUTTER))
    for offset, points in found.items():
        assert points == pytest.approx(samples_of(read(text, frame=5.0 + offset))[0.0], abs=1e-6)
        assert points == pytest.approx(np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0]]))
    bones = samples_of(read(text, purposes=("render", "guide"), **SHUTTER), "/r/skel")
    assert len(bones) == len(found)
