# SPDX-License-Identifier: Apache-2.0
"""Cameras: fields, choice, framing."""
import pytest

from patina.cli.errors import is_temporary
from patina.stage import StageError, cameras


def test_every_field(read, numbers):
    same = {"horizontalAperture": 36, "verticalAperture": 24, "horizontalApertureOffset": 1, "verticalApertureOffset": 2,
            "focalLength": 35, "fStop": 2.8, "focusDistance": 4}
    reading = read('def Camera "c" { ' + "".join(f"float {name} = {value}\n" for name, value in same.items()) + """
        float2 clippingRange = (0.5, 50)
        float4[] clippingPlanes = [(0, 0, 1, 2)]
        double shutter:open = -0.25
        double shutter:close = 0.25
        float exposure = 2
        token projection = "orthographic"
        double3 xformOp:translate = (1, 2, 3)
        uniform token[] xformOpOrder = ["xformOp:translate"] }""", frame=1.0)
    camera = reading.prim("/c")
    expected = {**same, "clipNear": 0.5, "clipFar": 50, "shutterOpen": -0.25, "shutterClose": 0.25, "exposureScale": 4}
    assert {name: float(camera[name]) for name in expected} == pytest.approx(expected)
    assert camera["orthographic"] == "true" and camera["clippingPlanes"] == "0 0 1 2"
    assert numbers(camera["transform"])[12:] == [1, 2, 3, 1]


CAMERAS = """
    def Xform "a" { def Camera "first" { } }
    def Camera "main_cam" { }
    def Camera "second" { }
    def Scope "Render" { def RenderSettings "s" { rel camera = </second> } }"""


def test_choice(read):
    from patina.stage import StageError
    assert read(CAMERAS).info.camera == "/main_cam"
    assert read('(renderSettingsPrimPath = "/Render/s")' + CAMERAS).info.camera == "/second"
    assert read(CAMERAS.replace("main_cam", "x")).info.camera == "/a/first"
    assert read(CAMERAS, camera="/second").info.camera == "/second"
    assert read(CAMERAS, camera="first").info.camera == "/a/first"
    with pytest.raises(StageError, match="no camera /nowhere .*/a/first, /main_cam, /second"):
        read(CAMERAS, camera="/nowhere")


@pytest.mark.parametrize("up", "YZ")
def test_framing_shows_everything(read, numbers, up):
    """The corners of the bounding box fall inside of the picture."""
    import numpy as np
    reading = read(f'(upAxis = "{up}")\ndef Cube "c" {{ double3 xformOp:translate = (10, 20, 30)  uniform token[] xformOpOrder '
                   f'= ["xformOp:translate"] }}')
    assert reading.info.framed
    camera = reading.prim(reading.info.camera)
    inverse = np.linalg.inv(np.array(numbers(camera["transform"])).reshape(4, 4))
    focal = float(camera.get("focalLength", 50))
    size = 0.0
    for x in (9, 11):
        for y in (19, 21):
            for z in (29, 31):
                p = np.array([x, y, z, 1.0]) @ inverse
                assert p[2] < -float(camera["clipNear"]) and -p[2] < float(camera["clipFar"])
                u, v = focal * p[:2] / -p[2]
                assert abs(u) < 20.955 / 2 and abs(v) < 15.2908 / 2
                size = max(size, abs(u) / (20.955 / 2), abs(v) / (15.2908 / 2))
    assert size > 0.9  # and fill it


def test_authored_extents_that_hold_nothing(read, numbers):
    text = """def Mesh "m" { int[] faceVertexCounts = [3]  int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0,0,0), (4,0,0), (0,4,0)]  float3[] extent = [%s] }"""
    good = read(text % "(0,0,0), (4,4,0)")
    inverse = read(text % "(4,4,0), (0,0,0)")
    zero = read(text % "(0,0,0), (0,0,0)")
    assert good.prim(good.info.camera)["transform"] == zero.prim(zero.info.camera)["transform"]
    assert good.prim(good.info.camera)["transform"] == inverse.prim(inverse.info.camera)["transform"]


def test_empty_stage(read):
    reading = read("", headlight=True)
    assert reading.info.framed and reading.has(reading.info.camera)
    assert any("no extents" in w for w in reading.warnings)


def test_cameras_and_prims_without_a_usable_transform(read):
    matrix = "uniform token[] xformOpOrder = [\"xformOp:transform\"]  matrix4d xformOp:transform ="
    reading = read(f"""
    def Camera "flat" {{ {matrix} ((0,0,0,0),(0,0,0,0),(0,0,0,0),(0,0,0,0)) }}
    def Sphere "nan" {{ {matrix} ((nan,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1)) }}""")
    assert "transform" not in reading.prim("/flat") and "transform" not in reading.prim("/nan")
    assert any(w.startswith("/flat xformOpOrder:") for w in reading.warnings)
    assert any(w.startswith("/nan xformOpOrder:") for w in reading.warnings)


@pytest.mark.parametrize("projection, reported", [("perspective", False), ("orthographic", False), ("fisheye", True)])
def test_a_projection_that_is_not_known_is_told(read, projection, reported):
    reading = read(f'def Camera "c" {{ token projection = "{projection}" }}')
    assert (reading.prim("/c").get("orthographic") == "true") == (projection == "orthographic")
    assert ("/c projection: 'fisheye' is not known; perspective is used" in reading.warnings) == reported
    assert reported or not any("projection" in w for w in reading.warnings)


def test_what_cameras_have_beyond_the_schema(read):
    reading = read("""def Camera "c" {
        token patina:projection = "fisheyeEquisolid"
        float patina:fieldOfView = 200
        int primvars:arnold:aperture_blades = 5
        float primvars:arnold:aperture_rotation = 30
        float primvars:patina:apertureRotation = 40
        float patina:apertureRotation = 50
        token patina:stereo = "sideBySide"
        double patina:interocularDistance = 6.5
        asset patina:distortionMap = @./map.exr@ }""")
    camera = reading.prim("/c")
    assert camera["projection"] == "fisheyeEquisolid" and camera["stereo"] == "sideBySide"
    assert [camera[n] for n in ("fieldOfView", "apertureBlades", "apertureRotation", "interocularDistance")] == [
        "200", "5", "50", "6.5"]
    assert camera["distortionMap"].startswith('"/') and camera["distortionMap"].endswith('map.exr"')
    assert not reading.warnings
    assert reading.scene.camera("/c")["image_aspect"] == pytest.approx(2 * 20.955 / 15.2908)


def test_a_value_that_is_neither_number_nor_text(read):
    reading = read('def Camera "c" { float3 patina:fieldOfView = (1, 2, 3) }')
    assert reading.warnings == ["/c patina:fieldOfView: is neither a number nor a text; it is left out"]


@pytest.mark.parametrize("error, text, passes", (
    (MemoryError(), "/c cannot be read: there is not enough memory for it", True),
    (ValueError("no camera"), "/c cannot be read: no camera", False)))
def test_without_the_camera_that_is_used_there_is_no_image(read, monkeypatch, error, text, passes):
    emit = cameras.emit

    def fails_once(context, found):
        if found.path == "/c":
            raise error
        emit(context, found)

    monkeypatch.setattr(cameras, "emit", fails_once)
    stage = 'def Camera "a" {}\ndef Camera "c" {}'
    with pytest.raises(StageError) as raised:
        read(stage, camera="/c")
    assert str(raised.value) == text
    assert is_temporary(raised.value) == passes
    reading = read(stage)  # which uses the first
    assert any(warning.startswith("/c") and "is not drawn" in warning for warning in reading.warnings)
    assert reading.scene.camera("/a")


BROKEN = {
    "string as a transform": """def Sphere "bad" { string xformOp:translate = "far"
        uniform token[] xformOpOrder = ["xformOp:translate"] }""",
    "numbers as points": """def SkelRoot "r" {
        def Skeleton "skel" { }
        def Mesh "bad" (prepend apiSchemas = ["SkelBindingAPI"]) {
            rel skel:skeleton = </r/skel>
            int[] faceVertexCounts = [3]
            int[] faceVertexIndices = [0, 1, 2]
            float[] points = [1, 2]
            uniform token[] skel:blendShapes = ["up"]
            rel skel:blendShapeTargets = </r/bad/up>
            def BlendShape "up" { vector3f[] offsets = [(0, 0, 5)] } } }""",
}


@pytest.mark.parametrize("broken", BROKEN)
def test_a_broken_prim_leaves_the_rest_framed(read, numbers, broken):
    good = """def Sphere "good" { double3 xformOp:translate = (0, 50, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]  double radius = 2 }"""
    reading = read(BROKEN[broken] + "\n    " + good)
    assert reading.info.framed and reading.has("/good") and any("bad" in w for w in reading.warnings)
    assert numbers(reading.prim(reading.info.camera)["transform"])[13] > 10


RIG = """class Xform "rig" { def Camera "shot" { float focalLength = 7
        double3 xformOp:translate = (0, 0, 10)  uniform token[] xformOpOrder = ["xformOp:translate"] } }
    class Xform "outer" { def Xform "in" (instanceable = true; inherits = </rig>) { } }
    def Xform "a" (instanceable = true; inherits = </outer>) {
        double3 xformOp:translate = (1, 0, 0)  uniform token[] xformOpOrder = ["xformOp:translate"] }
    def RenderSettings "rs" { rel camera = </a/in/shot> }
    """


@pytest.mark.parametrize("way", ["path", "name", "settings", "the only one"])
def test_cameras_inside_of_native_instances(read, numbers, way):
    head = '(renderSettingsPrimPath = "/rs")' if way == "settings" else ""
    other = "" if way == "the only one" else 'def Camera "main_cam" { }'
    reading = read(head + RIG + other, camera={"path": "/a/in/shot", "name": "shot"}.get(way))
    camera = reading.prim("/a/in/shot")
    assert reading.info.camera == "/a/in/shot" and "/a/in/shot" in reading.info.cameras
    assert camera["focalLength"] == "7" and numbers(camera["transform"])[12:] == [1, 0, 10, 1]


def test_other_cameras_are_chosen_before_those_of_instances(read):
    assert read(RIG + 'def Camera "plain" { }').info.cameras == ["/plain"]
