# SPDX-License-Identifier: Apache-2.0
"""UsdSkel."""

import pytest

SKELETON = """
    def SkelRoot "r" {
        def Skeleton "skel" (prepend apiSchemas = ["SkelBindingAPI"]) {
            uniform token[] joints = ["a", "a/b"]
            uniform matrix4d[] bindTransforms = [((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1)),
                ((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,1,0,1))]
            uniform matrix4d[] restTransforms = [((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1)),
                ((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,1,0,1))]
            rel skel:animationSource = </r/skel/anim>
            double3 xformOp:translate = (100, 0, 0)  uniform token[] xformOpOrder = ["xformOp:translate"]
            def SkelAnimation "anim" {
                uniform token[] joints = ["a/b"]
                float3[] translations.timeSamples = { 0: [(0, 1, 0)], 10: [(10, 1, 0)] }
                quatf[] rotations = [(1, 0, 0, 0)]
                half3[] scales = [(1, 1, 1)]
                uniform token[] blendShapes = ["up"]
                float[] blendShapeWeights.timeSamples = { 0: [0], 10: [1] } } }
        def Mesh "m" (prepend apiSchemas = ["SkelBindingAPI"]) {
            rel skel:skeleton = </r/skel>
            int[] faceVertexCounts = [3]
            int[] faceVertexIndices = [0, 1, 2]
            point3f[] points = [(0,0,0), (1,0,0), (0,1,0)]
            %s } }"""
WEIGHTS = """
            int[] primvars:skel:jointIndices = [0, 0, 1] (interpolation = "vertex"; elementSize = 1)
            float[] primvars:skel:jointWeights = [1, 1, 1] (interpolation = "vertex"; elementSize = 1)"""
SHAPE = """
            uniform token[] skel:blendShapes = ["up"]
            rel skel:blendShapeTargets = </r/m/up>
            def BlendShape "up" { vector3f[] offsets = [(0, 0, 5)]  int[] pointIndices = [0] }"""


def test_linear_blend(read, numbers):
    mesh = read(SKELETON % WEIGHTS, frame=5.0).prim("/r/m")
    assert numbers(mesh["points"]) == pytest.approx([0, 0, 0, 1, 0, 0, 5, 1, 0])
    assert numbers(mesh["transform"])[12] == 100.0  # points are in the space of the skeleton
    assert not any("skel" in key for key in mesh)


def test_blend_shapes_come_first(read, numbers):
    mesh = read(SKELETON % (WEIGHTS + SHAPE), frame=10.0).prim("/r/m")
    assert numbers(mesh["points"]) == pytest.approx([0, 0, 5, 1, 0, 0, 10, 1, 0])


def test_blend_shapes_without_joints(read, numbers):
    mesh = read(SKELETON % SHAPE, frame=10.0).prim("/r/m")
    assert numbers(mesh["points"]) == pytest.approx([0, 0, 5, 1, 0, 0, 0, 1, 0])
    assert "transform" not in mesh


def test_blend_shapes_that_fit_nothing_are_told_of_the_mesh(read, numbers):
    reading = read(SKELETON % SHAPE.replace("pointIndices = [0]", "pointIndices = [-1]"), frame=10.0)
    assert numbers(reading.prim("/r/m")["points"]) == [0, 0, 0, 1, 0, 0, 0, 1, 0]
    assert any("/r/m skel:blendShapes: cannot be applied" in line for line in reading.warnings), reading.warnings


def test_rigid_meshes_move_as_a_whole(read, numbers):
    mesh = read(SKELETON % """
            int[] primvars:skel:jointIndices = [1] (interpolation = "constant"; elementSize = 1)
            float[] primvars:skel:jointWeights = [1] (interpolation = "constant"; elementSize = 1)""", frame=5.0).prim("/r/m")
    assert numbers(mesh["points"]) == [0, 0, 0, 1, 0, 0, 0, 1, 0]
    assert numbers(mesh["transform"])[12:15] == pytest.approx([105, 0, 0])


def test_deformation_blur(read, numbers):
    mesh = read('def Camera "c" { double shutter:close = 1 }' + SKELETON % WEIGHTS, frame=5.0).prim("/r/m")
    assert numbers(mesh["points@0"])[6] == pytest.approx(5.0) and numbers(mesh["points@1"])[6] == pytest.approx(6.0)


def test_dual_quaternions_differ(read, numbers):
    half = """
            int[] primvars:skel:jointIndices = [0, 1, 0, 1, 0, 1] (interpolation = "vertex"; elementSize = 2)
            float[] primvars:skel:jointWeights = [0.5, 0.5, 0.5, 0.5, 0.5, 0.5] (interpolation = "vertex"; elementSize = 2)"""
    turned = SKELETON.replace("quatf[] rotations = [(1, 0, 0, 0)]", "quatf[] rotations = [(0, 0, 1, 0)]")
    linear = numbers(read(turned % half, frame=0.0).prim("/r/m")["points"])
    dual = numbers(read(turned % (half + '\nuniform token primvars:skel:skinningMethod = "dualQuaternion"'),
                        frame=0.0).prim("/r/m")["points"])
    assert linear[3] == pytest.approx(0.0, abs=1e-5)  # half a turn collapses
    assert abs(dual[3]) + abs(dual[5]) == pytest.approx(1.0, abs=1e-4)  # and here it does not


def test_instanced_characters_are_skinned_each(read, numbers):
    character = (SKELETON % WEIGHTS).replace('def SkelRoot "r"', 'class SkelRoot "r"')
    reading = read(character + """
    def SkelRoot "one" (instanceable = true; inherits = </r>) { }
    def SkelRoot "two" (instanceable = true; inherits = </r>) {
        double3 xformOp:translate = (0, 0, 7)  uniform token[] xformOpOrder = ["xformOp:translate"] }
    def SkelRoot "bare" (instanceable = true; inherits = </plain>) { }
    class SkelRoot "plain" { def Sphere "s" { } }""", frame=5.0)
    for path in ("/one/m", "/two/m"):
        assert numbers(reading.prim(path)["points"])[6] == pytest.approx(5.0)
    assert numbers(reading.prim("/two/m")["transform"])[12:15] == [100, 0, 7]
    assert reading.prim("/bare")["kind"] == "Instancer"  # nothing is skinned there


def test_framing_follows_the_pose(read, numbers):
    near, far = (read(SKELETON % WEIGHTS, frame=frame) for frame in (0.0, 10.0))
    place = [numbers(r.prim(r.info.camera)["transform"])[12] for r in (near, far)]
    assert place[1] > place[0] + 3  # the middle of what reaches ten to the right


def test_broken_skinning_is_drawn_at_rest(read, numbers):
    reading = read(SKELETON % """
            int[] primvars:skel:jointIndices = [0, 7, 9] (interpolation = "vertex"; elementSize = 1)
            float[] primvars:skel:jointWeights = [1, 1, 1] (interpolation = "vertex"; elementSize = 1)""", frame=5.0)
    assert len(numbers(reading.prim("/r/m")["points"])) == 9
    assert reading.warnings


@pytest.mark.parametrize("type_", ["int64", "uint64"])
def test_counts_whose_sum_wraps_are_not_used(read_apart, type_):
    """In a process of its own: numpy would write beyond its arrays there."""
    text = (SKELETON % (WEIGHTS + """
            uniform token subdivisionScheme = "none"
            normal3f[] normals = [(0,0,1), (0,0,1), (0,0,1)]""")).replace(
                "int[] faceVertexCounts = [3]", f"{type_}[] faceVertexCounts = [{'4611686018427387904, ' * 4}3]")
    assert "/r/m" in read_apart(text, frame=5.0)


def test_normals_of_a_deformed_mesh(read, numbers):
    reading = read(SKELETON % (WEIGHTS + """
            uniform token subdivisionScheme = "none"
            normal3f[] normals = [(1,0,0), (1,0,0), (1,0,0)]"""), frame=5.0)
    normals, = [value for key, value in reading.prim("/r/m").items() if key.startswith("primvar normals")]
    assert numbers(normals) == [0, 0, 1] * 3


def test_rigid_meshes_move_at_no_more_times_than_others(read):
    moving = (SKELETON % """
            int[] primvars:skel:jointIndices = [1] (interpolation = "constant"; elementSize = 1)
            float[] primvars:skel:jointWeights = [1] (interpolation = "constant"; elementSize = 1)""").replace(
                "{ 0: [(0, 1, 0)], 10: [(10, 1, 0)] }",
                "{ " + ", ".join(f"{5 + (k + 0.6) / 13:.6f}: [({k}, 1, 0)]" for k in range(13)) + " }").replace(
                "double3 xformOp:translate = (100, 0, 0)", "double3 xformOp:translate.timeSamples = { "
                + ", ".join(f"{5 + (k + 0.3) / 13:.6f}: ({k}, 0, 0)" for k in range(13)) + " }")
    mesh = read(moving, frame=5.0, shutter=(0.0, 1.0)).prim("/r/m")
    assert 2 <= len([key for key in mesh if key.startswith("transform@")]) <= 16
