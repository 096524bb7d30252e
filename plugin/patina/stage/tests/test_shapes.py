# SPDX-License-Identifier: Apache-2.0
"""Implicit prims, curves, points and transforms."""
import numpy as np
import pytest


IMPLICIT = {  # -> what the scene has of it
    'Sphere "a" { double radius = 3 }': {"radius": "3"},
    'Cube "b" { double size = 4 }': {"shape": "cube", "size": "4"},
    'Cone "c" { uniform token axis = "X"  double height = 5  double radius = 0.5 }': {
        "shape": "cone", "height": "5", "radius": "0.5", "axis": "0"},
    'Cylinder "d" { uniform token axis = "Y"  double height = 6 }': {"shape": "cylinder", "axis": "1", "height": "6"},
    'Capsule "e" { }': {"shape": "capsule", "radius": "0.5", "height": "1"},
    'Plane "f" { double width = 7  double length = 8 }': {"shape": "plane", "width": "7", "length": "8"},
    'Cylinder_1 "g" { double radiusBottom = 1  double radiusTop = 0.25 }': {"radiusTop": "0.25"},
    'Capsule_1 "h" { double radiusBottom = 0.75  double radiusTop = 0.5 }': {"radius": "0.75"}}


def test_every_implicit_prim(read):
    reading = read("\n".join("def " + prim for prim in IMPLICIT))
    for prim, fields in IMPLICIT.items():
        assert fields.items() <= reading.prim("/" + prim.split('"')[1]).items(), prim
    assert reading.info.counts["capsule"] == 2


def test_curves(read):
    reading = read("""
    def BasisCurves "ribbon" {
        uniform token type = "cubic"
        uniform token basis = "bspline"
        uniform token wrap = "pinned"
        int[] curveVertexCounts = [4]
        point3f[] points = [(0,0,0), (1,0,0), (2,0,0), (3,0,0)]
        float[] widths = [0.1, 0.2] (interpolation = "varying")
        normal3f[] normals = [(0,0,1)] (interpolation = "constant") }
    def BasisCurves "line" { uniform token type = "linear"  uniform token basis = "bspline"
        int[] curveVertexCounts = [2]  point3f[] points = [(0,0,0), (1,0,0)] }""")
    ribbon = reading.prim("/ribbon")
    assert (ribbon["basis"], ribbon["wrap"], ribbon["curveVertexCounts"]) == ("bspline", "pinned", "4")
    assert ribbon["primvar widths varying"] == "0.1 0.2"
    assert ribbon["primvar normals constant x3"] == "0 0 1"
    assert reading.prim("/line")["basis"] == "linear"


def test_points(read):
    points = read("""def Points "p" { point3f[] points = [(1,2,3), (4,5,6)]  float[] widths = [0.5, 1] }""").prim("/p")
    assert points["points"] == "1 2 3, 4 5 6" and points["primvar widths vertex"] == "0.5 1"


def test_transforms_and_reset(read, numbers):
    reading = read("""def Xform "a" { double3 xformOp:translate = (1, 2, 3)
        float3 xformOp:scale = (2, 2, 2)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
        def Sphere "in" { double3 xformOp:translate = (1, 0, 0)  uniform token[] xformOpOrder = ["xformOp:translate"] }
        def Sphere "out" { double3 xformOp:translate = (1, 0, 0)
            uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:translate"] } }""")
    assert numbers(reading.prim("/a/in")["transform"]) == [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 3, 2, 3, 1]
    assert numbers(reading.prim("/a/out")["transform"])[12:] == [1, 0, 0, 1]


MOVING = """(timeCodesPerSecond = 24)
    def Camera "cam" { double shutter:open = -0.25  double shutter:close = 0.25 }
    def Xform "x" { double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 2: (2, 0, 0) }
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Sphere "moved" { } }
    def Points "samples" { point3f[] points.timeSamples = { 0: [(0,0,0)], 1: [(1,0,0)], 2: [(0,0,0)] } }
    def Points "velocity" { point3f[] points.timeSamples = { 1: [(0,0,0)] }
        vector3f[] velocities.timeSamples = { 1: [(24,0,0)] } }
    def Sphere "still" { }"""


def test_motion_samples_inside_the_shutter(read, numbers):
    reading = read(MOVING, frame=1.0)
    assert reading.info.shutter == (-0.25, 0.25)
    moved = reading.prim("/x/moved")
    assert numbers(moved["transform@-0.25"])[12] == 0.75 and numbers(moved["transform@0.25"])[12] == 1.25
    samples = reading.prim("/samples")
    assert numbers(samples["points@-1"])[0] == 0.0  # the authored sample before the shutter opens
    assert numbers(samples["points@0"])[0] == 1.0
    assert numbers(samples["points@1"])[0] == 0.0
    assert "points@-0.25" not in samples
    velocity = reading.prim("/velocity")
    assert numbers(velocity["points@-0.25"])[0] == -0.25 and numbers(velocity["points@0.25"])[0] == 0.25
    assert "transform" not in reading.prim("/still")


@pytest.mark.parametrize("op, degrees, chords", [
    ("double xformOp:rotateZ", 10, 1), ("double xformOp:rotateZ", 45, 3), ("double xformOp:rotateZ", 100, 7),
    ("double xformOp:rotateZ", 360, 7), ("float3 xformOp:rotateXYZ", 45, 3), ("quatf xformOp:orient", 45, 3),
    ("double3 xformOp:translate", 360, 1), ("matrix4d xformOp:transform", 45, 1)])
def test_what_turns_is_read_where_its_chords_are_near_its_arcs(read, numbers, op, degrees, chords):
    """Between the times matrices are linear. A hundredth of the radius is allowed, as far as the renderer takes times."""

    def value(turn):
        half = np.radians(turn) / 2.0
        return {"rotateZ": turn, "rotateXYZ": f"(0, 0, {turn})", "orient": f"({np.cos(half)}, 0, 0, {np.sin(half)})",
                "translate": f"({turn}, 0, 0)",
                "transform": f"( ({1 - turn}, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )"}[op.partition(":")[2]]
    turning = f'def Xform "x" {{ {op}.timeSamples = {{ 1: {value(0)}, 2: {value(degrees)} }}\n' \
              f'uniform token[] xformOpOrder = ["{op.split()[1]}"]\ndef Sphere "s" {{ }}\n}}'
    sphere = read(turning, frame=1.0, shutter=(0.0, 1.0)).prim("/x/s")
    matrices = {float(key.partition("@")[2]): numbers(value) for key, value in sphere.items() if key.startswith("transform@")}
    assert list(matrices) == pytest.approx(np.linspace(0.0, 1.0, chords + 1), abs=1e-6)
    if degrees <= 100 and "rotate" in op:
        rows = np.array(list(matrices.values()))[:, :3]
        assert np.linalg.norm((rows[1:] + rows[:-1]) / 2.0, axis=1).min() >= 0.99


def test_turns_add_up_and_authored_times_stay(read):
    """Of the parent and the prim itself. Authored times are enough where no chord between them is too long."""

    def times(parent, own):
        def turn(samples):
            return 'double xformOp:rotateZ.timeSamples = {%s}\nuniform token[] xformOpOrder = ["xformOp:rotateZ"]\n' % samples
        text = 'def Xform "x" {%s def Xform "y" {%s def Sphere "s" { }\n}\n}' % (turn(parent), turn(own))
        return [float(key.partition("@")[2]) for key in read(text, frame=1.0, shutter=(0.0, 1.0)).prim("/x/y/s")
                if key.startswith("transform@")]
    assert times("1: 0, 2: 10", "1: 0, 2: 10") == [0.0, 0.5, 1.0]
    assert times("1: 0, 2: 0", "1: 0, 1.1: 8, 2: 16") == pytest.approx([0.0, 0.1, 1.0])
    assert times("1: 0, 2: 0", "1: 0, 1.5: 20, 2: 40") == pytest.approx([0.0, 1 / 3, 0.5, 2 / 3, 1.0], abs=1e-6)


def test_no_motion_without_a_shutter(read, numbers):
    reading = read(MOVING, frame=1.0, shutter=(0.0, 0.0))
    assert numbers(reading.prim("/x/moved")["transform"])[12] == 1.0
    assert "points@0.25" not in reading.prim("/samples")
    assert "transform" not in read(MOVING).prim("/x/moved")  # default time


@pytest.mark.parametrize("shutter,inside", [((-0.25, 0.25), (-0.25, 0.25)), ((0.0, 0.0), (0.0,)), ((0.5, 0.5), (0.0,))])
def test_aovs_of_motion_ask_for_the_frames_beside(read, numbers, shutter, inside):
    """What is seen while the shutter is open, or at the frame's time where it is not, stays as it is without them."""
    reading = read(MOVING, frame=1.0, shutter=shutter, motion=True)
    times = sorted({-1.0, 1.0, *inside})
    moved, velocity = reading.prim("/x/moved"), reading.prim("/velocity")
    assert [k for k in moved if k.startswith("transform@")] == [f"transform@{t:g}" for t in times]
    assert [numbers(moved[f"transform@{t:g}"])[12] for t in times] == [1.0 + t for t in times]
    assert [numbers(velocity[f"points@{t:g}"])[0] for t in times] == times
    assert [numbers(reading.prim("/samples")[f"points@{t}"])[0] for t in (-1, 0, 1)] == [0.0, 1.0, 0.0]
    assert "transform" not in reading.prim("/still")
    assert "transform@1" not in read(MOVING, motion=True).prim("/x/moved")  # default time


def test_types_that_are_newer_fall_back_as_the_stage_says(read):
    reading = read("""(fallbackPrimTypes = { token[] Globe = ["Ball", "Sphere"]
        token[] Lamp = ["SphereLight"] })
    def Globe "a" { double radius = 3 }
    def Lamp "b" { float inputs:radius = 2 }
    def Nothing "c" { }""")
    assert reading.prim("/a")["shape"] == "sphere" and reading.prim("/a")["radius"] == "3"
    assert reading.prim("/b")["type"] == "sphere" and reading.prim("/b")["radius"] == "2" and not reading.has("/c")


PLUGIN = """{"Plugins": [{"Type": "resource", "Name": "own", "Root": ".", "ResourcePath": ".", "LibraryPath": "",
    "Info": {"Types": {"OwnTypesBall": {"bases": ["UsdGeomSphere"], "schemaKind": "concreteTyped",
                                   "alias": {"UsdSchemaBase": "OwnBall"}},
                       "OwnTypesSky": {"bases": ["UsdLuxDomeLight_1"], "schemaKind": "concreteTyped",
                                  "alias": {"UsdSchemaBase": "OwnSky"}}}}}]}"""
SCHEMA = """#usda 1.0
class OwnBall "OwnBall" { double radius = 4 }
class OwnSky "OwnSky" { token poleAxis = "Z" }
"""


def test_types_derived_from_known_ones_are_those(tmp_path, read_apart, statements):
    """In a process of its own: OpenUSD reads plugins once."""
    (tmp_path / "plugInfo.json").write_text(PLUGIN)
    (tmp_path / "generatedSchema.usda").write_text(statements(SCHEMA))
    text = read_apart('def OwnBall "a"\n{\n}\ndef OwnSky "b"\n{\n}\n', PXR_PLUGINPATH_NAME=str(tmp_path))
    assert text.endswith(" []\n"), text
    assert "shape = sphere" in text and "radius = 4" in text, text
    assert "type = dome" in text and "transform = 1 0 0 0" in text, text


def test_velocities_place_points_between_samples(read, numbers):
    moving = """def Points "p" { point3f[] points.timeSamples = { 0: [(0,0,0)], 4: [(100,0,0)] }
        vector3f[] velocities.timeSamples = { 0: [(24,0,0)], 4: [(24,0,0)] }%s }"""
    assert numbers(read(moving % "", frame=1.0).prim("/p")["points"]) == [1, 0, 0]
    faster = "  vector3f[] accelerations.timeSamples = { 0: [(0,1152,0)], 4: [(0,0,0)] }"
    assert numbers(read(moving % faster, frame=1.0).prim("/p")["points"]) == [1, 1, 0]
    assert numbers(read(moving % "", frame=4.0).prim("/p")["points"]) == [100, 0, 0]


def test_accelerations_bend_the_way_through_the_shutter(read):
    """As often as UsdGeomMotionAPI asks for, and three times at least."""
    scene = """def Camera "c" { double shutter:open = -0.5  double shutter:close = 0.5 }
        def Points "p" (prepend apiSchemas = ["MotionAPI"]) { %s
        point3f[] points.timeSamples = { 0: [(0,0,0)], 4: [(0,0,0)] }
        vector3f[] velocities.timeSamples = { 0: [(24,0,0)], 4: [(24,0,0)] }%s }"""
    faster = "  vector3f[] accelerations.timeSamples = { 0: [(0,1152,0)], 4: [(0,1152,0)] }"
    for count, more, times in (("", "", 2), ("", faster, 3), ("int motion:nonlinearSampleCount = 5", faster, 5)):
        prim = read(scene % (count, more), frame=0.0).prim("/p")
        assert len([name for name in prim if name.startswith("points@")]) == times, prim
    assert prim["points@-0.25"] == "-0.25 0.0625 0"


def test_colors_of_faces_show_in_both_back_ends(read, pictures):
    """A cube's first face is the one along +z; its points along +x are blue. A sphere's last 20 faces are around its pole."""
    colors = ", ".join(["(1, 0, 0)"] * 80 + ["(0, 1, 0)"] * 20)
    reading = read(f"""def Camera "cam" {{ token projection = "orthographic"
        float horizontalAperture = 40  float verticalAperture = 40
        double3 xformOp:translate = (0, 0, 9)  uniform token[] xformOpOrder = ["xformOp:translate"] }}
    def DomeLight "d" {{ }}
    def Sphere "s" {{ double3 xformOp:translate = (-1, 1, 0)  uniform token[] xformOpOrder = ["xformOp:translate"]
        color3f[] primvars:displayColor = [{colors}] (interpolation = "uniform") }}
    def Cube "faces" {{ double3 xformOp:translate = (1, 1, 0)  uniform token[] xformOpOrder = ["xformOp:translate"]
        color3f[] primvars:displayColor = [(0, 1, 0), (1, 0, 0)] (interpolation = "uniform")
        int[] primvars:displayColor:indices = [0, 1, 1, 1, 1, 1] }}
    def Cube "points" {{ double3 xformOp:translate = (1, -1, 0)  uniform token[] xformOpOrder = ["xformOp:translate"]
        color3f[] primvars:displayColor = [(0,0,1), (1,0,0), (1,0,0), (0,0,1), (1,0,0), (1,0,0), (0,0,1), (0,0,1)] (
            interpolation = "vertex") }}""")
    for backend, image in pictures(reading, 64):
        # The cap ends at 36 degrees from the pole, whose sine is 0.59.
        for (x, y), wanted in (((-1, 1.3), 1), ((-1.3, 1), 1), ((-1, 1.8), 0), ((-0.2, 1), 0), ((1, 1), 1), ((1.8, 0.3), 1),
                               ((0.3, -1), 0), ((1.7, -1.5), 2)):
            pixel = image[int(32 - 16 * y), int(32 + 16 * x)]
            assert int(pixel.argmax()) == wanted, (backend, x, y, pixel)
    assert not reading.scene.warnings()
