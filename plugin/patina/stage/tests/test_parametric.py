# SPDX-License-Identifier: Apache-2.0
"""NURBS patches and curves, Hermite curves, meshes of tetrahedra: read, drawn, and the same as what pxr says of them."""
import numpy as np
import pytest


PATCH = """int uVertexCount = 3  int vVertexCount = 2  int uOrder = 3  int vOrder = 2
    double[] uKnots = [0, 0, 0, 1, 1, 1]  double[] vKnots = [0, 0, 1, 1]
    point3f[] points = [(0,0,0), (1,1,0), (2,0,0), (0,0,1), (1,1,1), (2,0,1)] """

TETS = """point3f[] points = [(0,0,0), (1,0,0), (0,1,0), (0,0,1), (1,1,1)]
    int4[] tetVertexIndices = [(0,1,2,3), (1,4,2,3)] """


def test_a_patch_keeps_its_knots_weights_and_side(read):
    patch = read("""def NurbsPatch "p" { """ + PATCH + """ double2 uRange = (0.25, 0.75)  double2 vRange = (0, 1)
        double[] pointWeights = [1, 0.5, 1, 1, 0.5, 1]  uniform token orientation = "leftHanded"
        uniform bool doubleSided = 1 }""").prim("/p")
    assert patch["kind"] == "Mesh" and patch["patch u"] == "3 order 3" and patch["patch v"] == "2 order 2"
    assert patch["patch u knots"] == "0 0 0 1 1 1" and patch["patch u range"] == "0.25 0.75"
    assert patch["patch weights"] == "1 0.5 1 1 0.5 1" and patch["leftHanded"] == "true"
    assert patch["faceVertexIndices"] == "0 1 4 3 1 2 5 4"  # the grid of control points, u fastest


TRIM = """ int[] trimCurve:counts = [2]  int[] trimCurve:orders = [2, 2]  int[] trimCurve:vertexCounts = [2, 3]
    double[] trimCurve:knots = [0, 0, 1, 1, 0, 0, 1, 2, 2]  double2[] trimCurve:ranges = [(0, 1), (0, 2)]
    double3[] trimCurve:points = [(0.2, 0.2, 1), (0.8, 0.2, 1), (0.8, 0.2, 1), (1, 1.6, 2), (0.2, 0.2, 1)] """


def test_a_patch_keeps_its_trim_curves(read, numbers):
    patch = read("""def NurbsPatch "p" { """ + PATCH + TRIM + "}").prim("/p")
    assert patch["trim counts"] == "2" and patch["trim orders"] == "2 2" and patch["trim vertexCounts"] == "2 3"
    assert patch["trim knots"] == "0 0 1 1 0 0 1 2 2" and patch["trim ranges"] == "0 1 0 2"
    assert numbers(patch["trim points"]) == [0.2, 0.2, 1, 0.8, 0.2, 1, 0.8, 0.2, 1, 1, 1.6, 2, 0.2, 0.2, 1]
    assert "trim keepInside" not in patch


def test_which_side_of_trim_curves_stays(read):
    """RenderMan's attribute, also from a prim above."""
    reading = read("""def Scope "s" { string primvars:ri:attributes:trimcurve:sense = "outside"
        def NurbsPatch "p" { """ + PATCH + TRIM + "} }")
    assert reading.prim("/s/p")["trim keepInside"] == "true"


@pytest.mark.parametrize("oriented", ["", ' uniform token orientation = "leftHanded"'])
def test_tetrahedra_show_the_surface_that_pxr_finds(read, numbers, oriented):
    from pxr import Usd, UsdGeom

    reading = read("""def TetMesh "t" { """ + TETS + oriented + " }")
    tets = reading.prim("/t")
    found = np.array(numbers(tets["faceVertexIndices"]), int).reshape(-1, 3)
    stage = Usd.Stage.CreateInMemory()
    mesh = UsdGeom.TetMesh.Define(stage, "/t")
    mesh.CreateTetVertexIndicesAttr([(0, 1, 2, 3), (1, 4, 2, 3)])
    wanted = np.array(UsdGeom.TetMesh.ComputeSurfaceFaces(mesh, Usd.TimeCode.Default()))

    def turned(faces):  # each triangle from its lowest index on: its winding stays
        return sorted(tuple(np.roll(face, -int(np.argmin(face)))) for face in faces)

    assert turned(found) == turned(wanted)
    assert "scheme" not in tets or tets["scheme"] == "none"
    assert tets.get("leftHanded", "false") == ("true" if oriented else "false")


def test_an_authored_surface_is_used_and_none_is_told_of(read):
    reading = read("""def TetMesh "t" { """ + TETS + """ int3[] surfaceFaceVertexIndices = [(0, 2, 1)] }
    def TetMesh "empty" { point3f[] points = [(0,0,0)] }""")
    assert reading.prim("/t")["faceVertexIndices"] == "0 2 1" and not reading.has("/empty")
    assert any(w.startswith("/empty tetVertexIndices:") for w in reading.warnings)


def test_hermite_curves_are_bezier_curves(read, numbers):
    curves = read("""def HermiteCurves "h" { int[] curveVertexCounts = [2]  point3f[] points = [(0,0,0), (3,0,0)]
        vector3f[] tangents = [(0,3,0), (0,-6,0)]  float[] widths = [1, 2] (interpolation = "vertex") }""").prim("/h")
    assert curves["kind"] == "Curves" and curves["basis"] == "bezier" and curves["curveVertexCounts"] == "4"
    assert numbers(curves["points"]) == [0, 0, 0, 0, 1, 0, 3, 2, 0, 3, 0, 0]
    assert curves["primvar widths varying"] == "1 2"


def test_nurbs_curves_are_bezier_curves(read, numbers):
    curves = read("""def NurbsCurves "n" { int[] curveVertexCounts = [4, 3]  int[] order = [4, 2]
        double[] knots = [0, 0, 0, 0, 2, 2, 2, 2, 0, 0, 1, 2, 2]  double2[] ranges = [(0, 2), (0, 2)]
        point3f[] points = [(0,0,0), (1,1,0), (2,1,0), (3,0,0), (0,0,1), (3,0,1), (3,3,1)]
        float[] widths = [1, 2, 3, 4, 5, 6, 7] (interpolation = "vertex") }""").prim("/n")
    assert curves["curveVertexCounts"] == "4 7"
    assert numbers(curves["points"])[:12] == pytest.approx([0, 0, 0, 1, 1, 0, 2, 1, 0, 3, 0, 0], abs=1e-6)
    assert numbers(curves["points"])[12:] == pytest.approx(
        [0, 0, 1, 1, 0, 1, 2, 0, 1, 3, 0, 1, 3, 1, 1, 3, 2, 1, 3, 3, 1], abs=1e-6)
    assert numbers(curves["primvar widths vertex"])[:4] == pytest.approx([1, 2, 3, 4], abs=1e-6)


def test_tangents_move_with_points(read, numbers):
    curves = read("""(timeCodesPerSecond = 24)
    def Camera "cam" { double shutter:open = -0.5  double shutter:close = 0.5 }
    def HermiteCurves "h" { int[] curveVertexCounts = [2]
        point3f[] points.timeSamples = { 0: [(0,0,0), (3,0,0)], 2: [(0,0,2), (3,0,2)] }
        vector3f[] tangents.timeSamples = { 0: [(0,0,0), (0,0,0)], 2: [(0,6,0), (0,6,0)] } }""", frame=1.0).prim("/h")
    assert numbers(curves["points@-1"])[3:6] == [0, 0, 0] and numbers(curves["points@1"])[3:6] == [0, 2, 2]


def test_what_is_broken_is_named(read):
    reading = read("""def NurbsPatch "p" { }
    def NurbsCurves "n" { int[] curveVertexCounts = [4]  point3f[] points = [(0,0,0), (1,0,0), (2,0,0), (3,0,0)]
        int[] order = [4]  double[] knots = [0, 1] }
    def HermiteCurves "h" { int[] curveVertexCounts = [2]  point3f[] points = [(0,0,0), (1,0,0)] }
    def NurbsPatch "types" { string uOrder = "x"  point3f[] uKnots = [(0,0,0)]  int2 uRange = (1, 2)
        string vRange = "x"  string trimCurve:counts = "x" }""")
    assert any(w.startswith("/n knots: has 2 values where 8 are needed") for w in reading.warnings)
    assert any(w.startswith("/h tangents:") for w in reading.warnings)
    assert any(w.startswith("/types uKnots:") for w in reading.warnings)
    assert any(w.startswith("/types vRange:") for w in reading.warnings) and reading.has("/types")


TRIMMED_SQUARE = """int uVertexCount = 2  int vVertexCount = 2  int uOrder = 2  int vOrder = 2
        double[] uKnots = [0, 0, 1, 1]  double[] vKnots = [0, 0, 1, 1]
        int[] trimCurve:counts = [1]  int[] trimCurve:orders = [2]  int[] trimCurve:vertexCounts = [5]
        double[] trimCurve:knots = [0, 0, 1, 2, 3, 4, 4]"""


def test_both_back_ends_draw_them(read, pictures):
    """A patch, tetrahedra and both kinds of curves, each in its quarter of a small image, are there in both. A square is cut
    out of the patch; of a second one nothing is left."""
    reading = read("""def Camera "cam" { token projection = "orthographic"
        float horizontalAperture = 40  float verticalAperture = 40
        double3 xformOp:translate = (0, 0, 9)  uniform token[] xformOpOrder = ["xformOp:translate"] }
    def DomeLight "d" { }
    def NurbsPatch "p" { """ + TRIMMED_SQUARE + """
        point3f[] points = [(-1.9,0.1,0), (-0.1,0.1,0), (-1.9,1.9,0), (-0.1,1.9,0)]
        double3[] trimCurve:points = [(0.35,0.1,1), (0.95,0.1,1), (0.95,0.9,1), (0.35,0.9,1), (0.35,0.1,1)]
        color3f[] primvars:displayColor = [(1, 0, 0)] }
    def NurbsPatch "gone" { """ + TRIMMED_SQUARE + """
        point3f[] points = [(-2,-2,1), (2,-2,1), (-2,2,1), (2,2,1)]
        double3[] trimCurve:points = [(0,0,1), (1,0,1), (1,1,1), (0,1,1), (0,0,1)] }
    def TetMesh "t" { point3f[] points = [(0.1,0.1,0), (1.9,0.1,0), (0.1,1.9,0), (0.1,0.1,1)]
        int4[] tetVertexIndices = [(0,1,2,3)]  color3f[] primvars:displayColor = [(0, 1, 0)] }
    def HermiteCurves "h" { int[] curveVertexCounts = [2]  point3f[] points = [(-1.9,-1,0), (-0.1,-1,0)]
        vector3f[] tangents = [(2,0,0), (2,0,0)]  float[] widths = [1] (interpolation = "constant")
        color3f[] primvars:displayColor = [(0, 0, 1)] }
    def NurbsCurves "n" { int[] curveVertexCounts = [3]  int[] order = [3]  double[] knots = [0, 0, 0, 1, 1, 1]
        point3f[] points = [(0.1,-1,0), (1,-1,0), (1.9,-1,0)]  float[] widths = [1] (interpolation = "constant")
        color3f[] primvars:displayColor = [(1, 1, 0)] }""")
    assert not reading.warnings
    for backend, image in pictures(reading, 16):
        assert (image[3:5, 5] > 0.99).all(), (backend, image[3:5, 5])  # the sky
        for name, (row, column), wanted in (("patch", (4, 1), (1, 0, 0)), ("tets", (5, 9), (0, 1, 0)),
                                            ("hermite", (12, 4), (0, 0, 1)), ("nurbs", (12, 12), (1, 1, 0))):
            pixel = image[row, column]
            # Beside its colour a form shows the white sky in its interface of ior 1.5: below a quarter, Fresnel's share at 75
            # degrees.
            assert (pixel[np.array(wanted) == 0] < 0.25).all() and (pixel[np.array(wanted) == 1] > 0.5).all(), (
                backend, name, pixel)


def test_even_knots_stand_in_for_those_that_are_not_authored(read, numbers):
    text = """def NurbsCurves "n" { int[] curveVertexCounts = [4, 5]  int[] order = [4, 3]  %s
        point3f[] points = [(0,0,0), (1,1,0), (2,1,0), (3,0,0), (0,0,1), (3,0,1), (3,3,1), (0,3,1), (0,0,1)] }"""
    without = read(text % "")
    knots = "double[] knots = [0,0,0,0,1,1,1,1, 0,0,0,1,2,3,3,3]  double2[] ranges = [(0, 1), (0, 3)]"
    assert without.prim("/n") == read(text % knots).prim("/n") and not without.warnings
    ranged = read(text % "double2[] ranges = [(2, 4), (0, 6)]")
    assert ranged.prim("/n")["curveVertexCounts"] == "4 10" and not ranged.warnings
    broken = read("""def NurbsCurves "n" { int[] curveVertexCounts = [2]  int[] order = [3]
        point3f[] points = [(0,0,0), (1,1,0)] }""")
    assert any("curves are not drawn" in w for w in broken.warnings)


def test_even_knots_of_patches(read):
    even = PATCH.replace("double[] uKnots = [0, 0, 0, 1, 1, 1]  double[] vKnots = [0, 0, 1, 1]", "")
    assert read('def NurbsPatch "p" { ' + even + " }").prim("/p") == read('def NurbsPatch "p" { ' + PATCH + " }").prim("/p")
