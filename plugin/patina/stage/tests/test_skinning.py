# SPDX-License-Identifier: Apache-2.0
"""UsdSkel."""
import numpy as np
import pytest
from pxr import Usd, UsdSkel

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


CROWD = (SKELETON % WEIGHTS).replace("rel skel:animationSource = </r/skel/anim>", "").replace(
    "    def SkelRoot", 'class Xform "human" {  def SkelRoot', 1).replace("</r/", "</human/r/") + """ }
    def SkelAnimation "near" { uniform token[] joints = ["a/b"]  half3[] scales = [(1, 1, 1)]
        quatf[] rotations = [(1, 0, 0, 0)]  float3[] translations = [(3, 1, 0)] }
    def SkelAnimation "far" { uniform token[] joints = ["a/b"]  half3[] scales = [(1, 1, 1)]
        quatf[] rotations = [(1, 0, 0, 0)]  float3[] translations = [(8, 1, 0)] }
    class Xform "pair" {
        def Xform "own" (instanceable = HOW; inherits = </human>; prepend apiSchemas = ["SkelBindingAPI"]) {
            rel skel:animationSource = </far> }
        def Xform "others" (instanceable = HOW; inherits = </human>) { } }
    def Xform "moved" (instanceable = HOW; inherits = </pair>; prepend apiSchemas = ["SkelBindingAPI"]) {
        rel skel:animationSource = </near> }
    def Xform "still" (instanceable = HOW; inherits = </pair>) { }
    def Xform "one" (instanceable = HOW; inherits = </human>) { }"""


def test_instances_inherit_animations_from_above_their_skel_roots(read, numbers):
    """As the same stage without instances; those that inherit none share what they hold."""
    plain, instanced = (read(CROWD.replace("HOW", how)) for how in ("false", "true"))
    for path, x in (("/moved/own", 8), ("/moved/others", 3), ("/still/own", 8)):
        for reading in (plain, instanced):
            assert numbers(reading.prim(path + "/r/m")["points"]) == pytest.approx([0, 0, 0, 1, 0, 0, x, 1, 0])
    assert instanced.prim("/one")["kind"] == "Instancer" and not instanced.warnings


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
    text = (SKELETON % (WEIGHTS + SHAPE + """
            uniform token subdivisionScheme = "none"
            normal3f[] normals = [(0,0,1), (0,0,1), (0,0,1)]""")).replace(
                "int[] faceVertexCounts = [3]", f"{type_}[] faceVertexCounts = [{'4611686018427387904, ' * 4}3]")
    assert "/r/m" in read_apart(text, frame=5.0)


TURNED = SKELETON.replace("rotations = [(1, 0, 0, 0)]", "rotations = [(0.8, 0.6, 0, 0)]").replace("[0, 1, 2]", "[2, 0, 1]")
NORMALS = """
            uniform token subdivisionScheme = "none"
            normal3f[] normals = [%s] (interpolation = "%s")"""


def normals_of(reading, path="/r/m"):
    """:returns: (interpolation, array of normals of length 1) of a prim"""
    (key, value), = [item for item in reading.prim(path).items() if item[0].startswith("primvar normals")]
    normals = np.array([float(x) for x in value.replace(",", " ").split()]).reshape(-1, 3)
    return key.split()[2], normals / np.linalg.norm(normals, axis=1, keepdims=True)


@pytest.mark.parametrize("interpolation, given, wanted", [
    ("constant", "(0,1,0)", [1, 1, 1]), ("uniform", "(0,1,0)", [1, 1, 1]),
    ("vertex", "(1,0,0), (0,1,0), (0,0,1)", [0, 1, 2]), ("faceVarying", "(1,0,0), (0,1,0), (0,0,1)", [0, 1, 2])])
def test_an_identity_pose_changes_no_normals(read, interpolation, given, wanted):
    _, found = normals_of(read(SKELETON % (WEIGHTS + NORMALS % (given, interpolation)), frame=0.0))
    assert found == pytest.approx(np.eye(3)[wanted])


@pytest.mark.parametrize("method", ["classicLinear", "dualQuaternion"])
@pytest.mark.parametrize("kind, interpolation", [("Mesh", "vertex"), ("Mesh", "faceVarying"), ("BasisCurves", "vertex")])
def test_normals_turn_as_pxr_bakes_them(read, statements, tmp_path, kind, interpolation, method):
    normals = NORMALS % ("(1,0,0), (0,1,0), (0,0,1)", interpolation)
    text = TURNED.replace('def Mesh "m"', f'def {kind} "m"') % (SHAPE + normals + """
            int[] curveVertexCounts = [3]
            matrix4d primvars:skel:geomBindTransform = ((1,0,0,0), (0,2,1,0), (0,0,1,0), (0,0,0,1))
            int[] primvars:skel:jointIndices = [0, 1, 0, 1, 1, 0] (interpolation = "vertex"; elementSize = 2)
            float[] primvars:skel:jointWeights = [1, 0, 0.3, 0.7, 1, 0] (interpolation = "vertex"; elementSize = 2)
            uniform token primvars:skel:skinningMethod = "%s" """ % method)
    text = text.replace("vector3f[] offsets", "vector3f[] normalOffsets = [(0, 0.5, 0)]  vector3f[] offsets")
    baked = Usd.Stage.CreateInMemory()
    baked.GetRootLayer().ImportFromString("#usda 1.0\n" + statements(text))
    # pxr leaves offsets of blend shapes out for normals of corners.
    frame = 10.0 if interpolation == "vertex" else 0.0
    assert UsdSkel.BakeSkinning(baked.Traverse())
    baked.Export(str(tmp_path / "baked.usda"))
    (_, found), (_, wanted) = (normals_of(read(which, frame=frame)) for which in (text, tmp_path / "baked.usda"))
    assert found == pytest.approx(wanted, abs=1e-6)
    assert np.abs(found - np.eye(3)).max() > 0.1


@pytest.mark.parametrize("interpolation, values, same_interpolation, same_values", [
    ("uniform", "(0,1,1)", "faceVarying", "(0,1,1), (0,1,1), (0,1,1)"),
    ("constant", "(0,1,1)", "vertex", "(0,1,1), (0,1,1), (0,1,1)"),
    ("faceVarying", "(1,0,0), (0,1,0), (0,0,1)", "vertex", "(0,1,0), (0,0,1), (1,0,0)")])  # corners are points 2, 0, 1
def test_normals_of_all_interpolations_turn_alike(read, interpolation, values, same_interpolation, same_values):
    posed = TURNED % (WEIGHTS + SHAPE + NORMALS)
    posed = posed.replace("vector3f[] offsets", "vector3f[] normalOffsets = [(0.5, 0, 0)]  vector3f[] offsets")
    name, found = normals_of(read(posed % (values, interpolation), frame=10.0))
    _, wanted = normals_of(read(posed % (same_values, same_interpolation), frame=10.0))
    assert found == pytest.approx(wanted[[2, 0, 1]] if interpolation == "faceVarying" else wanted, abs=1e-6)
    indexed = (posed % (values, interpolation)).replace("normals = [", "primvars:normals = [(9, 0, 0), ")
    count = values.count("(")
    indexed = indexed.replace("uniform token subdivisionScheme", "int[] primvars:normals:indices = %s  uniform token "
                              "subdivisionScheme" % list(range(1, count + 1)))
    assert normals_of(read(indexed, frame=10.0))[0] == name
    assert normals_of(read(indexed, frame=10.0))[1] == pytest.approx(found)


def test_normals_turn_with_the_mesh_where_a_blend_shape_has_no_offsets_for_them(read):
    """The triangle's third point rises: the triangle turns about its first edge, and what stood on it still does."""
    up = SHAPE.replace("pointIndices = [0]", "pointIndices = [2]").replace("(0, 0, 5)", "(0, 0, 1)")
    for interpolation, values in (("uniform", "(0,0,1)"), ("vertex", "(0,0,1), (0,0,1), (0,0,1)")):
        _, found = normals_of(read(SKELETON % (up + NORMALS % (values, interpolation)), frame=10.0))
        assert found == pytest.approx(np.array([[0, -0.5 ** 0.5, 0.5 ** 0.5]] * 3), abs=1e-6)


SIDE = "normalOffsets = [%s]  vector3f[] offsets"
TWO = SHAPE.replace('["up"]', '["up", "down"]').replace("</r/m/up>", "[</r/m/up>, </r/m/down>]").replace(
    "vector3f[] offsets", "vector3f[] " + SIDE % "(3, 0, 0)") + """
            def BlendShape "down" { vector3f[] offsets = [(0, 0, -1)]  int[] pointIndices = [1] }"""
UPRIGHT = NORMALS % ("(0,0,1), (0,0,1), (0,0,1)", "vertex")


@pytest.mark.parametrize("frame", [10.0, 2.5])
def test_a_shape_without_offsets_for_normals_keeps_those_of_others(read, frame):
    """Whatever its weight is: it adds nothing to the normals, as in pxr."""
    alone, both = ((SKELETON % (shapes + UPRIGHT)).replace('blendShapes = ["up"]', f"blendShapes = {names}").replace(
        "[0], 10: [1]", weights) for shapes, names, weights in (
            (TWO.replace('"up", "down"', '"up"').replace("[</r/m/up>, </r/m/down>]", "</r/m/up>"), '["up"]', "[0], 10: [1]"),
            (TWO, '["up", "down"]', "[0, 0], 10: [1, %s]")))
    _, wanted = normals_of(read(alone, frame=frame))
    assert wanted[0] == pytest.approx(np.array([0.3 * frame, 0, 1]) / np.hypot(0.3 * frame, 1))
    for weight in (0, 0.001, 1):
        assert normals_of(read(both % weight, frame=frame))[1] == pytest.approx(wanted, abs=1e-6)


def test_blended_normals_are_as_long_as_skinned_ones(read):
    """No joints normalize them: the offset makes the first one longer."""
    text = SKELETON % (SHAPE.replace("vector3f[] offsets", "vector3f[] " + SIDE % "(3, 0, 0)") + UPRIGHT)
    (value,) = [value for key, value in read(text, frame=10.0).prim("/r/m").items() if key.startswith("primvar normals")]
    lengths = np.linalg.norm(np.array(value.replace(",", " ").split(), dtype=float).reshape(-1, 3), axis=1)
    assert lengths == pytest.approx([1, 1, 1], abs=1e-5)  # a dump has six digits


@pytest.mark.parametrize("wrong", ["None", '["a"]', "[(1, 0, 0), (1, 0, 0)]"])
def test_offsets_for_normals_that_are_none_leave_the_mesh(read, wrong):
    shape = TWO.replace("normalOffsets = [(3, 0, 0)]", "normalOffsets = " + wrong)
    if wrong.startswith('["'):
        shape = shape.replace("vector3f[] normalOffsets", "string[] normalOffsets")
    assert len(normals_of(read(SKELETON % (shape + UPRIGHT), frame=10.0))[1]) == 3


def test_normals_that_fit_no_points_are_told(read):
    reading = read(SKELETON % (WEIGHTS + NORMALS % ("(1,0,0), (0,1,0)", "vertex")), frame=5.0)
    assert any("/r/m normals: cannot be skinned" in line for line in reading.warnings), reading.warnings


def test_a_chain_of_joints_turns_at_enough_times(read):
    """Both joints turn alike, so what hangs on the second one turns twice as far; 120 degrees take all times that there are."""
    turning = SKELETON.replace('joints = ["a/b"]', 'joints = ["a", "a/b"]').replace(
        "translations.timeSamples = { 0: [(0, 1, 0)], 10: [(10, 1, 0)] }", "translations = [(0, 0, 0), (0, 1, 0)]").replace(
        "scales = [(1, 1, 1)]", "scales = [(1, 1, 1), (1, 1, 1)]")

    def times(degrees):
        half = np.radians(degrees) / 2.0
        end = f"({np.cos(half)}, 0, 0, {np.sin(half)})"
        text = turning.replace("rotations = [(1, 0, 0, 0)]", "rotations.timeSamples = { 0: [(1, 0, 0, 0), (1, 0, 0, 0)], "
                               f"1: [{end}, {end}] }}")
        mesh = read(text % WEIGHTS, frame=0.0, shutter=(0.0, 1.0)).prim("/r/m")
        return [float(key.partition("@")[2]) for key in mesh if key.startswith("points@")]
    assert times(60) == pytest.approx(np.linspace(0.0, 1.0, 8), abs=1e-6)
    assert times(15) == pytest.approx([0.0, 0.5, 1.0])
    assert times(5) == [0.0, 1.0]


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
