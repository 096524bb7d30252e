# SPDX-License-Identifier: Apache-2.0
"""UsdLux lights, linking, and the headlight."""
from types import SimpleNamespace

import numpy as np
import pytest

from patina.stage import cameras, headlight


LIGHTS = {  # -> what the scene has of it
    'DistantLight "distant" { float inputs:angle = 1.5  float inputs:intensity = 3 }': {"angle": "1.5", "intensity": "3"},
    'DomeLight "dome" { token inputs:texture:format = "angular" }': {"textureFormat": '"angular"'},
    'SphereLight "sphere" { float inputs:radius = 2  bool treatAsPoint = 1  float inputs:exposure = 2 }': {
        "radius": "2", "treatAsPoint": "true", "exposure": "2"},
    'DiskLight "disk" { float inputs:radius = 3  bool inputs:normalize = 1 }': {"radius": "3", "normalize": "true"},
    'RectLight "rect" { float inputs:width = 4  float inputs:height = 5 }': {"width": "4", "height": "5"},
    'CylinderLight "cylinder" { float inputs:length = 6  bool treatAsLine = 1 }': {"length": "6", "treatAsLine": "true"}}


def test_every_light(read):
    reading = read("\n".join("def " + light for light in LIGHTS) + """
    def RectLight "picture" { asset inputs:texture:file = @a.png@ }
    def PortalLight "portal" { }""")
    for light, fields in LIGHTS.items():
        name = light.split('"')[1]
        found = reading.prim("/" + name)
        assert {"type": name, **fields}.items() <= found.items(), light
    assert reading.prim("/picture")["textureFile"].endswith('a.png"')
    assert any(w.startswith("/portal : prims of type PortalLight") for w in reading.warnings)


def test_fallbacks_of_the_schemas(read):
    reading = read("""
    def DistantLight "distant" { }
    def SphereLight "sphere" { }
    def DiskLight "disk" { }""")
    assert reading.prim("/distant")["intensity"] == "50000"
    assert "radius" not in reading.prim("/sphere") and "intensity" not in reading.prim("/sphere")


SHAPED = {  # input of a light -> what the scene has of it
    "color3f inputs:color = (1, 0.5, 0.25)": "color = 1 0.5 0.25",
    "bool inputs:enableColorTemperature = 1": "enableColorTemperature = true",
    "float inputs:colorTemperature = 3000": "colorTemperature = 3000",
    "float inputs:diffuse = 0.5": "diffuse = 0.5",
    "float inputs:specular = 0.25": "specular = 0.25",
    "float inputs:shaping:cone:angle = 30": "shapingConeAngle = 30",
    "float inputs:shaping:cone:softness = 0.5": "shapingConeSoftness = 0.5",
    "float inputs:shaping:focus = 4": "shapingFocus = 4",
    "color3f inputs:shaping:focusTint = (1, 0, 0)": "shapingFocusTint = 1 0 0",
    "float inputs:shaping:ies:angleScale = 0.5": "iesAngleScale = 0.5",
    "bool inputs:shaping:ies:normalize = 1": "iesNormalize = true",
    "bool inputs:shadow:enable = 0": "shadowEnable = false",
    "color3f inputs:shadow:color = (0, 0, 1)": "shadowColor = 0 0 1"}


def test_colour_shaping_and_shadow(read):
    light = read('def SphereLight "l" (prepend apiSchemas = ["ShapingAPI", "ShadowAPI"]) {\n' + "\n".join(SHAPED)
                 + "\nasset inputs:shaping:ies:file = @lamp.ies@ }").prim("/l")
    assert not set(SHAPED.values()) - {f"{name} = {value}" for name, value in light.items()}
    assert light["iesFile"].endswith('lamp.ies"') and light["shapingConeAuthored"] == "true"


def test_names_from_before_inputs(read):
    light = read('def SphereLight "l" { float intensity = 7  float radius = 2  float shaping:cone:angle = 20 }').prim("/l")
    assert light["intensity"] == "7" and light["radius"] == "2" and light["shapingConeAngle"] == "20"


def test_mesh_light(read):
    reading = read("""def Mesh "m" (prepend apiSchemas = ["MeshLightAPI"]) {
        float inputs:intensity = 9
        int[] faceVertexCounts = [3]  int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0,0,0), (1,0,0), (0,1,0)] }
    def SphereLight "invisible" { token visibility = "invisible" }""")
    assert reading.prim("/m")["kind"] == "Mesh"
    light = reading.prim("/m/light_of_mesh")
    assert light["type"] == "mesh" and light["geometry"] == '"/m"' and light["intensity"] == "9"
    assert not reading.has("/invisible")


def test_linking_by_collections(read):
    reading = read("""
    def SphereLight "some" (prepend apiSchemas = ["CollectionAPI:lightLink"]) {
        bool collection:lightLink:includeRoot = 0
        rel collection:lightLink:includes = </in> }
    def SphereLight "all" { }
    def SphereLight "shadow" (prepend apiSchemas = ["CollectionAPI:shadowLink"]) {
        rel collection:shadowLink:excludes = </out> }
    def Sphere "in" { }
    def Sphere "out" { }
    def Xform "t" (instanceable = true; inherits = </tree>) { }
    def PointInstancer "pi" { rel prototypes = </tree>  int[] protoIndices = [0]  point3f[] positions = [(0,0,0)] }
    class Xform "tree" { def Sphere "s" { } }""")
    assert reading.prim("/some")["lightLink"] == '"/some.collection:lightLink"'
    assert "lightLink" not in reading.prim("/all") and "shadowLink" not in reading.prim("/all")
    assert reading.prim("/shadow")["shadowLink"] == '"/shadow.collection:shadowLink"'
    assert reading.prim("/in")["categories"] == "/some.collection:lightLink /shadow.collection:shadowLink"
    assert "categories" not in reading.prim("/out")
    assert reading.prim("/t")["categories 0"] == "/shadow.collection:shadowLink"
    assert "categories" not in reading.prim("/t/s")  # those of the instance count
    assert reading.prim("/pi")["categories 0"] == "/shadow.collection:shadowLink"


@pytest.mark.parametrize("up,pole,turned", [("Y", "scene", False), ("Z", "scene", True), ("Y", "Z", True), ("Z", "Y", False)])
def test_pole_of_a_dome(read, numbers, up, pole, turned):
    from pxr import UsdLux
    if not hasattr(UsdLux, "DomeLight_1"):
        pytest.skip("this pxr has no DomeLight_1")
    dome = read(f'(upAxis = "{up}")\ndef DomeLight_1 "d" {{ token poleAxis = "{pole}" }}\ndef DomeLight "old" {{ }}').prim("/d")
    if turned:  # +Y of the texture's own frame goes to +Z
        assert [round(x, 6) for x in numbers(dome["transform"])[4:7]] == [0, 0, 1]
    else:
        assert "transform" not in dome


def test_headlight_only_without_lights(read):
    dark = read('def Sphere "s" { }', headlight=True)
    assert dark.info.headlight and dark.prim("/patinaHeadlight/eye")["treatAsPoint"] == "true"
    assert any("headlight" in note for note in dark.info.notes)
    flat = read('def Camera "c" { token projection = "orthographic" }', headlight=True).prim("/patinaHeadlight/eye")
    assert flat["type"] == "distant" and flat["shadowEnable"] == "false"
    assert not read('def Sphere "s" { }  def DistantLight "l" { }', headlight=True).info.headlight
    assert not read('def Sphere "s" { }').info.headlight


def test_nodes_give_values_of_inputs(read):
    """What they cannot give is told. Pictures are in testenv/render/test_lightNetworks.py."""
    reading = read("""
    def Material "rig" {
        color3f inputs:tint = (0.25, 0.5, 1)
        token outputs:mtlx:light.connect = </rig/shader.outputs:out>
        def Shader "shader" {
            uniform token info:id = "ND_light"
            token outputs:out
        }
        def Shader "no" { uniform token info:id = "ND_nobody"  float outputs:out }
        def Shader "yes" { uniform token info:id = "ND_constant_boolean"  bool inputs:value = 1  bool outputs:out }
        def Shader "less" { uniform token info:id = "ND_constant_float"  float inputs:value = -3  float outputs:out }
        def Shader "text" { uniform token info:id = "ND_constant_string"  string inputs:value = "a"  string outputs:out }
    }
    def Sphere "ball" (prepend apiSchemas = ["MaterialBindingAPI"]) { rel material:binding = </rig> }
    def SphereLight "shaded" {
        color3f inputs:color = (1, 0, 0)
        color3f inputs:color.connect = </rig/shader.outputs:out>
        float inputs:exposure.connect = </rig/no.outputs:out>
        float inputs:radius.connect = </rig/nothing.outputs:out>
        bool inputs:normalize.connect = </rig/yes.outputs:out>
        float inputs:intensity.connect = </rig/less.outputs:out>
    }
    def RectLight "profile" (prepend apiSchemas = ["ShapingAPI"]) {
        asset inputs:shaping:ies:file.connect = </rig/text.outputs:out>
    }
    def SphereLight "tinted" { color3f inputs:color.connect = </rig.inputs:tint> }
    def RectLight "other" { uniform token light:shaderId = "ND_light" }
    def RectLight "plain" { uniform token light:shaderId = "RectLight" }""")
    about = [w for w in reading.warnings if w.startswith(("/shaded", "/tinted", "/other", "/plain", "/profile"))]
    no_value = "which gives no value that this light can take; its own value is used"
    assert sorted(about) == sorted([
        f"/shaded inputs:color: is connected to /rig/shader, {no_value}",
        f"/shaded inputs:exposure: is connected to /rig/no, {no_value}",
        "/shaded radius: is connected to /rig/nothing.outputs:out, which does not exist; its own value is used",
        f"/profile inputs:shaping:ies:file: is connected to /rig/text, {no_value}",
        "/other light:shaderId: is ND_light, which is not evaluated; the light is drawn by its type"])
    assert reading.prim("/rig")["terminal surface"] == "/rig/shader.out"  # attached to geometry, it shines
    shaded = reading.prim("/shaded")
    assert (shaded["color"], shaded["normalize"], shaded["intensity"]) == ("1 0 0", "true", "-3")
    assert reading.prim("/tinted")["color"] == "0.25 0.5 1"


def test_long_values_are_not_told_in_full(read):
    long = ", ".join(["1"] * 4000)
    reading = read(f"""
    def RectLight "r" {{ float[] light:shaderId = [{long}]
        rel light:filters = </f> }}
    def LightFilter "f" {{ uniform token lightFilter:shaderId = "PxrRodLightFilter"
        float[] inputs:saturation = [{long}] }}
    def Mesh "m" {{ float[] subdivisionScheme = [{long}]
        string interpolateBoundary = "{'x' * 4000}" }}
    def BasisCurves "c" {{ float[] basis = [{long}]
        float[] wrap = [{long}] }}
    def Camera "k" {{ float[] projection = [{long}] }}""")
    for prim, field in (("/r", "light:shaderId"), ("/f", "inputs:saturation"), ("/m", "subdivisionScheme"), ("/c", "basis"),
                        ("/c", "wrap"), ("/k", "projection")):
        assert any(w.startswith(f"{prim} {field}: ") and "an array of 4000 values" in w for w in reading.warnings), field
    cut, = [w for w in reading.warnings if w.startswith("/m interpolateBoundary: ")]
    assert cut.endswith("xxx...' is unknown; edgeAndCorner is used") and max(map(len, reading.warnings)) < 600


@pytest.mark.parametrize("near, far", [(1, 1e6), (0.1, 50), (0, 100), (-5, 1e4), (float("nan"), float("inf")), (1e-30, 1e30)])
def test_the_headlight_is_as_bright_near_as_far(near, far):
    """An irradiance of 0.75 pi: with the dome's quarter a matte surface shows its own albedo. Lines between knots lie above a
    square by (step - 1)^2 / 4 of it at most."""
    lights = {}
    edit = SimpleNamespace(set_light=lambda path, **fields: lights.update({path: fields}))
    place = np.array([[0, 2, 0, 0], [2, 0, 0, 0], [0, 0, 2, 0], [1, 2, 3, 1]], float)  # turned, and twice as large
    headlight.emit(SimpleNamespace(edit=edit, notes=[]), cameras.Placed("/c", place, False, near, far))
    eye = lights[headlight.EYE]
    assert np.array_equal(eye["transform"], [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 2, 3, 1]])
    ramp = eye["filters"][0]
    distance = np.geomspace(ramp["rampKnots"][0], 1.0, 500) * ramp["endDistance"]
    intensity = 0.25 * eye["intensity"]  # of a normalized sphere that is a point
    irradiance = intensity / distance ** 2 * np.interp(distance / ramp["endDistance"], ramp["rampKnots"], ramp["rampFloats"])
    assert (irradiance > 0.75 * np.pi * (1.0 - 1e-6)).all()
    assert (irradiance < 0.75 * np.pi * (1.0 + 0.2 ** 2 / 4 + 1e-6)).all()


def test_hidden_lights_are_lights(read):
    """A stage whose lights go out is dark, as one whose intensities become 0."""
    for light in ('def SphereLight "l" { SHOWN }', 'def Xform "g" { SHOWN\ndef DistantLight "l" { } }',
                  'class "c" { def DomeLight "l" { } }  def Xform "a" (inherits = </c>  instanceable = true) { SHOWN }',
                  'def Mesh "m" (prepend apiSchemas = ["MeshLightAPI"]) { SHOWN }'):
        text = light.replace("SHOWN", 'token visibility.timeSamples = {1: "inherited", 2: "invisible"}')
        for frame in (1.0, 2.0):
            assert not read(text, frame=frame, headlight=True).info.headlight, (light, frame)
    assert read('def Sphere "s" { token visibility = "invisible" }', headlight=True).info.headlight


@pytest.mark.parametrize("first", ["a", "b"])
def test_prims_that_are_no_lights_by_their_type_are_told_each_for_itself(read, first):
    prims = {"a": 'def Xform "a" (prepend apiSchemas = ["LightAPI"]) { }  ', "b": 'def Xform "b" { }  def Xform "c" { }  '}
    text = prims.pop(first) + "".join(prims.values())
    mesh = 'def Mesh "{}" (prepend apiSchemas = ["{}"]) {{ }}  '
    reading = read(text + mesh.format("m", "LightAPI") + mesh.format("glow", "MeshLightAPI") + mesh.format("k", "MeshLightAPI")
                   .replace("Mesh ", "Cube ") + 'def Volume "v" (prepend apiSchemas = ["VolumeLightAPI"]) { }')
    told = [warning for warning in reading.warnings if "apiSchemas" in warning]
    assert told == [f"/{name} apiSchemas: is LightAPI on a prim of type {type_}, which is not evaluated"
                    for name, type_ in (("a", "Xform"), ("m", "Mesh"), ("k", "Cube"))]
    assert not any("are not drawn" in warning for warning in reading.warnings) and reading.has("/glow/light_of_mesh")


@pytest.mark.parametrize("how", ["true", "false"])
def test_portals_in_instances_are_used(read, how):
    reading = read(f"""class "lamp" {{
            def DomeLight "d" {{ rel portals = </lamp/used> }}
            def PortalLight "used" {{ }}
            def PortalLight "other" {{ }} }}
        def Xform "a" (inherits = </lamp>  instanceable = {how}) {{ }}""")
    assert reading.warnings == ["/a/other : prims of type PortalLight are not drawn"]


def test_links_of_filters_and_shapes_of_mesh_lights_are_told(read):
    shaping = "float inputs:shaping:cone:angle = {}  float inputs:shaping:focus = {}"
    mesh = 'def Mesh "{}" (prepend apiSchemas = ["MeshLightAPI", "ShapingAPI"]) {{ {} }}  '
    reading = read('def RectLight "l" (prepend apiSchemas = ["ShapingAPI"]) { rel light:filters = [</some>, </all>]  '
                   + shaping.format(20, 2) + " }  "
                   + mesh.format("shaped", shaping.format(20, 2) + "  asset inputs:shaping:ies:file = @a.ies@")
                   + mesh.format("plain", shaping.format(180, 0) + "  asset inputs:shaping:ies:file = @@")
                   + """def LightFilter "some" { uniform token lightFilter:shaderId = "PxrIntMultLightFilter"
                            rel collection:filterLink:excludes = </shaped> }
                        def LightFilter "all" { uniform token lightFilter:shaderId = "PxrIntMultLightFilter" }""")
    told = [warning.partition(": is")[0] for warning in reading.warnings if "not evaluated" in warning]
    assert sorted(told) == ["/shaped inputs:shaping:cone:angle", "/shaped inputs:shaping:focus",
                            "/shaped inputs:shaping:ies:file", "/some collection:filterLink"]
