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
SHAPE = """
            uniform token[] skel:blendShapes = ["up"]
            rel skel:blendShapeTargets = </r/m/up>
            def BlendShape "up" { vector3f[] offsets = [(0, 0, 1)]  int[] pointIndices = [1]
                vector3f[] inbetweens:side = [(0, 3, 0)] (weight = 0.5)
                vector3f[] inbetweens:away = [(0, 0, 5)] (weight = -1) }"""
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
    for points in found.values():
        assert points == pytest.approx(np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0]]))
    bones = samples_of(read(text, purposes=("render", "guide"), **SHUTTER), "/r/skel")
    assert len(bones) == len(found)


def weights(name, samples):
    return f'uniform token[] blendShapes = ["{name}"]  float[] blendShapeWeights.timeSamples = {{ {samples} }}'


POINTS = "point3f[] points.timeSamples = { 4: [(0,0,0), (1,0,0), (0,2,0)], 5.1: %s, 6: [(0,0,0), (1,0,0), (0,2,3)] }"
BIND = "matrix4d primvars:skel:geomBindTransform.timeSamples = { 4.9: %s, 5.1: %s }" % tuple(
    f"((1,0,0,0), (0,1,0,0), (0,0,1,0), (0,0,{z},1))" for z in (0, 4))
WEIGHTS = "float[] primvars:skel:jointWeights.timeSamples = { 4: [1,1,1], 5.1: [1,1,1], 6: [1,1,0] }"


@pytest.mark.parametrize("text, times", [
    (stage(mesh=SHAPE, animation=weights("up", "4: [0.05], 6: [0.85]")), [0.125]),  # it passes 0.5 at 5.125
    (stage(mesh=SHAPE, animation=weights("up", "4: [0.4], 5.1: [0.4], 6: [4]")), [0.1, 0.1 + 0.9 / 36]),
    (stage(mesh=SHAPE, animation=weights("up", "4: [-5], 6: [5]")), [0.0, 0.1]),
    (stage(mesh=SHAPE, animation=weights("up", "4: [1], 6: [2]")), []),
    (stage(mesh=SHAPE, animation=weights("other", "4: [-5], 6: [5]")), []),
    (stage(mesh=SHAPE.replace("</r/m/up>", "[</r/m/up>, </r/m/down>]"), animation=weights("up", "4: [0], 6: [1]")), []),
    (stage(animation=MOVING + "  quatf[] rotations.timeSamples = { 5.1: [(1,0,0,0), (1,0,0,0)] }"), [0.1]),
    (stage().replace("point3f[] points = [(0,0,0), (1,0,0), (0,2,0)]", POINTS % "[(0,0,0), (1,0,7), (0,2,0)]"), [0.1]),
    (stage(mesh=BIND), [-0.1, 0.1]),
    (stage().replace("float[] primvars:skel:jointWeights = [1, 1, 1]", "float[] primvars:skel:jointWeights").replace(
        "int[] faceVertexCounts", WEIGHTS + "  int[] faceVertexCounts"), [0.1])],
    ids=["in-between", "in-between and sample", "in-betweens below 0 too", "beyond all", "shapes without weights",
         "targets that do not fit", "joints", "points", "bind transform", "joint weights"])
def test_points_are_read_wherever_they_take_another_direction(read, text, times):
    found = samples_of(read(text, **SHUTTER))
    assert sorted(found) == pytest.approx([-0.25, *times, 0.25], abs=1e-5)
    for offset in np.linspace(-0.25, 0.25, 11):  # between them they move on straight lines
        still = samples_of(read(text, frame=5.0 + offset))[0.0]
        chord = [np.interp(offset, sorted(found), values)
                 for values in np.array([found[time].ravel() for time in sorted(found)]).T]
        assert np.ravel(still) == pytest.approx(chord, abs=2e-4)


def test_how_far_joints_turn_does_not_depend_on_their_order(read):
    """Each of three turns by 40 degrees in the shutter, so that what hangs on the last one turns three times as far."""
    names = ("a", "a/b", "a/b/c")
    skeleton = stage().replace('joints = ["a", "a/b"]', 'joints = ["a", "a/b", "a/b/c"]').replace(
        "(0,1,0,1))]", "(0,1,0,1)), ((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,1,0,1))]")

    def times(order):
        half = np.radians(80)  # in two time codes
        turned = f"({np.cos(half)}, 0, 0, {np.sin(half)})"
        animation = f"""uniform token[] joints = [{", ".join(f'"{names[k]}"' for k in order)}]
            float3[] translations = [{", ".join("(0,0,0)" if k == 0 else "(0,1,0)" for k in order)}]
            half3[] scales = [(1,1,1), (1,1,1), (1,1,1)]
            quatf[] rotations.timeSamples = {{ 4: [{", ".join(["(1,0,0,0)"] * 3)}], 6: [{", ".join([turned] * 3)}] }}"""
        head, _, tail = skeleton.partition('def SkelAnimation "anim" {')
        return read(head + 'def SkelAnimation "anim" {' + animation + tail[tail.index(" } }"):], **SHUTTER)
    wanted = samples_of(times((0, 1, 2)))
    assert len(wanted) == 8  # 120 degrees take all times that there are
    for order in ((2, 1, 0), (2, 0, 1), (1, 2, 0)):
        found = samples_of(times(order))
        assert sorted(found) == sorted(wanted)
        assert all(found[time] == pytest.approx(wanted[time], abs=1e-5) for time in wanted)
