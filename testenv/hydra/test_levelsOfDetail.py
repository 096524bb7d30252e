# SPDX-License-Identifier: Apache-2.0
"""Levels of detail of UsdLod in usdrecord: those of the command line; instances of a prototype share that of the nearest."""
import numpy as np
import pytest

import hydraBuild
from glowingTiles import COLORS, TILE, WIDTH, looks, pictures
from rendering import pixels

pytestmark = pytest.mark.skipif(not hydraBuild.missing() and not hydraBuild.has_usdrecord(),
                                reason="this OpenUSD has no usdrecord")
# Level a is 4 units wide, as are b, which other renderers are told not to show, and c. b holds a square that nobody shows.
ITEMS = """
    def Xform "a" { %s }
    def Xform "b" { token visibility = "invisible"
        %s
        def Xform "hidden" { token visibility = "invisible"
            double3 xformOp:translate = (0, 0, 0.5)  uniform token[] xformOpOrder = ["xformOp:translate"]
            %s } }
    def Xform "c" { %s }
""" % (TILE % "a", TILE % "b", TILE % "d", TILE % "c")
ROOT = ' "%s" (prepend apiSchemas = ["LODRootAPI", "LODOverrideAPI"] %s) { rel lod:heuristics = </by>\n%s\n' + ITEMS + "}\n"
DISTANCE = """def LODDistanceHeuristic "by" {
    uniform token lod:domain = "imaging"  uniform float[] thresholds = [25, 50] }
"""
SIZE = """def LODScreenSizeHeuristic "by" {
    uniform token lod:domain = "imaging"  uniform float[] thresholds = [0.08, 0.03]
    float3[] extent = [(-2, -2, 0), (2, 2, 0)] }
"""
# Half as high as wide, so that the frame is no square, and one unit beside the middle, so that the tile is not in the middle.
CAMERA = """#usda 1.0
(
    startTimeCode = 1
    endTimeCode = 3
    renderSettingsPrimPath = "/Render/main"
)
def Scope "Render" { def RenderSettings "main" { int patina:samples = 4 } }
def Camera "camera" {
    float horizontalAperture = 40  float verticalAperture = 20  float focalLength = 40  float2 clippingRange = (1, 1000)
    double3 xformOp:translate = (0, 0, %g)  double3 xformOp:translate.timeSamples = { %s }
    uniform token[] xformOpOrder = ["xformOp:translate"] }
"""


def at(*distances):
    """:returns: text of a camera that is so far away in frame 1, 2 and so on; of one distance it stands still"""
    samples = ", ".join(f"{i + 1}: (0, 0, {z:g})" for i, z in enumerate(distances))
    text = CAMERA % (distances[0], samples)
    return text if len(distances) > 1 else text.replace("double3 xformOp:translate.timeSamples = { " + samples + " }", "")


def stage(tmp_path, camera, *parts):
    path = tmp_path / "levels.usda"
    text = camera + 'def Xform "World" {' + looks() + "}\n" + "\n".join(parts)
    path.write_text(text.replace("  ", "\n").replace(" }", "\n}"), encoding="utf-8")  # statements end with a line
    return path


def levels(picture):
    """:returns: of which levels there is a pixel of their colour; levels that are far cover none whole"""
    seen = picture[picture[..., 3] > 0.3]
    seen = seen[:, :3] / seen[:, 3:]
    return "".join(name for name, rgb in COLORS.items() if np.isclose(seen, rgb, atol=0.01).all(axis=-1).any())


def both(tmp_path, *parts, camera=at(20)):
    hydraBuild.skip_before(2608, "there is no UsdLod")
    hydra, record = pictures(stage(tmp_path, camera, *parts), tmp_path, "--camera", "camera")
    return hydra, record


@pytest.mark.parametrize("heuristic", [DISTANCE, SIZE])
@pytest.mark.parametrize("distance, shown", [(20, "a"), (30, "b"), (60, "c")])
def test_the_heuristic_chooses(tmp_path, heuristic, distance, shown):
    hydra, record = both(tmp_path, heuristic, "def Xform" + ROOT % ("root", "", ""), camera=at(distance))
    assert levels(record) == shown
    assert np.array_equal(hydra, record)


@pytest.mark.parametrize("lines, shown", [
    ('token lod:override:mode = "indexedLOD"  float lod:override:index = 1.2', "b"),
    ('token lod:override:mode = "noLOD"', ""), ('token lod:override:mode = "allLOD"', "abc"),
    ('rel lod:heuristics = []  int lod:default:index = 7', "c")])
def test_overrides_and_the_default(tmp_path, lines, shown):
    text = ROOT % ("root", "", lines)
    if "heuristics" in lines:
        text = text.replace("rel lod:heuristics = </by>\n", "", 1)
    for name, x in (("b", 4), ("c", -4)) if "allLOD" in lines else ():  # one beside the other
        text = text.replace(f'def Xform "{name}" {{', f"""def Xform "{name}" {{
            double3 xformOp:translate = ({x}, 0, 0)  uniform token[] xformOpOrder = ["xformOp:translate"]  """)
    hydra, record = both(tmp_path, DISTANCE, "def Xform" + text)
    assert levels(record) == shown
    assert np.array_equal(hydra, record)


@pytest.mark.parametrize("distances, shown", [((20, 60, 60), "aca"), ((60, ), "cca")])
def test_they_follow_the_camera_and_an_override_above_that_moves_in_time(tmp_path, distances, shown):
    hydraBuild.skip_before(2608, "there is no UsdLod")
    above = """def Xform "top" (prepend apiSchemas = ["LODOverrideAPI"]) {
        token lod:override:mode.timeSamples = { 1: "noOverride", 2: "noOverride", 3: "indexedLOD" }
        def Xform""" + ROOT % ("root", "", "") + "}"
    path = stage(tmp_path, at(*distances), DISTANCE, above)
    hydraBuild.run_usdrecord(path, tmp_path / "h.#.exr", "--camera", "camera", "--frames", "1:3", "--imageWidth", WIDTH,
                             "--disableCameraLight", "--colorCorrectionMode", "disabled", scene_index=True)
    assert [levels(pixels(tmp_path / f"h.{frame}.exr")) for frame in (1, 2, 3)] == list(shown)


PLACES = ((-4, -10), (4, -35))  # x, z: from 20 units before, the first one is nearer than 50, the other is not


@pytest.mark.parametrize("instanceable", [True, False])
def test_native_instances_share_the_level_of_the_nearest(tmp_path, instanceable):
    asset = "class Xform" + ROOT % ("asset", "", "")
    for below in (False, True):  # the root is the instance, or is in it
        text = asset if not below else 'class Xform "asset" { def Xform' + ROOT % ("root", "", "") + "}"
        placed = "".join(f"""def Xform "i{i}" (prepend references = </asset>
            instanceable = {str(instanceable).lower()}) {{ double3 xformOp:translate = ({x}, 0, {z})
            uniform token[] xformOpOrder = ["xformOp:translate"] }}
            """ for i, (x, z) in enumerate(PLACES))
        hydra, record = both(tmp_path, DISTANCE, text, placed)
        assert levels(record) == "bc"
        assert levels(hydra) == ("b" if instanceable else "bc")


def test_instances_of_a_point_instancer(tmp_path):
    points = ", ".join(f"({x}, 0, {z})" for x, z in PLACES)
    hydra, record = both(tmp_path, DISTANCE, f"""def PointInstancer "trees" {{ rel prototypes = </trees/root>
        int[] protoIndices = [0, 0]  point3f[] positions = [{points}]
        def Xform""" + ROOT % ("root", "", "") + "}")
    assert levels(record) == "b"
    assert np.array_equal(hydra, record)


def test_instances_in_a_level_go_with_it(tmp_path):
    trees = """def Xform "root" (prepend apiSchemas = ["LODRootAPI"]) { int lod:default:index = %d
        def Xform "near" { token visibility = "invisible"
            def Xform "i" (prepend references = </asset>
                instanceable = true) { } }
        def PointInstancer "far" { rel prototypes = </outOfView/p>  int[] protoIndices = [0]
            point3f[] positions = [(0, 0, 0)] } }
    class Xform "asset" { %s }
    def Xform "outOfView" { double3 xformOp:translate = (0, 999, 0)  uniform token[] xformOpOrder = ["xformOp:translate"]
        def Xform "p" { %s } }
    """
    for index, shown in ((0, "a"), (1, "b")):
        hydra, record = both(tmp_path, trees % (index, TILE % "a", TILE % "b"))
        assert levels(record) == shown
        assert np.array_equal(hydra, record)
