# SPDX-License-Identifier: Apache-2.0
"""Colour spaces of values and textures: on attributes, inherited from prims, defined by the stage."""
import ast
import os
import subprocess
import sys

import numpy as np
import pytest
from pxr import Usd

import _patina
from patina.stage import read_materials

DEFINED = """(prepend apiSchemas = ["ColorSpaceAPI", "ColorSpaceDefinitionAPI:mine"]) {
    uniform token colorSpace:name = "lin_ap1_scene"
    uniform token colorSpaceDefinition:mine:name = "camera"
    float2 colorSpaceDefinition:mine:redChroma = (0.64, 0.33)
    float2 colorSpaceDefinition:mine:greenChroma = (0.3, 0.6)
    float2 colorSpaceDefinition:mine:blueChroma = (0.15, 0.06)
    float2 colorSpaceDefinition:mine:whitePoint = (0.3127, 0.329)
    float colorSpaceDefinition:mine:gamma = 2.4
    float colorSpaceDefinition:mine:linearBias = 0.055"""
CAMERA = '"chromaticities(0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329 2.4 0.055)"'


def stage_of(inputs, world="{", shader="", identifier="UsdPreviewSurface"):
    """A material /w/m whose shader has these inputs, bound to a sphere."""
    return f"""def Scope "w" {world}
        def Material "m" {{
            token outputs:surface.connect = </w/m/s.outputs:surface>
            def Shader "s" {shader} {{
                uniform token info:id = "{identifier}"
                {inputs}
                token outputs:surface
            }}
        }}
        def Sphere "ball" (prepend apiSchemas = ["MaterialBindingAPI"]) {{
            rel material:binding = </w/m>
        }}
    }}"""


def test_a_prim_above_says_the_space_of_colours(read):
    m = read(stage_of("""color3f inputs:diffuseColor = (1, 0, 0)
        color3f inputs:emissiveColor = (1, 0, 0) (colorSpace = "srgb_texture")
        color3f inputs:specularColor = (1, 0, 0) (colorSpace = "camera")
        float inputs:roughness = 0.5
        float3 inputs:vector = (1, 0, 0)""", DEFINED)).prim("/w/m")
    assert m["colorSpace diffuseColor"] == "lin_ap1_scene"
    assert m["colorSpace emissiveColor"] == "srgb_texture"
    assert m["colorSpace specularColor"] == CAMERA.strip('"')
    assert "colorSpace roughness" not in m and "colorSpace vector" not in m


def test_the_nearest_prim_counts(read):
    nearer = """(prepend apiSchemas = ["ColorSpaceAPI"])"""
    space = """uniform token colorSpace:name = "camera"
        """
    m = read(stage_of(space + "color3f inputs:diffuseColor = (1, 0, 0)", DEFINED, nearer)).prim("/w/m")
    assert m["colorSpace diffuseColor"] == CAMERA.strip('"')
    # An attribute of that name alone is no schema.
    m = read(stage_of(space + "color3f inputs:diffuseColor = (1, 0, 0)", DEFINED)).prim("/w/m")
    assert m["colorSpace diffuseColor"] == "lin_ap1_scene"
    m = read(stage_of("color3f inputs:diffuseColor = (1, 0, 0)")).prim("/w/m")
    assert "colorSpace diffuseColor" not in m


def test_images_have_it_where_materialx_reads_colours(read, tmp_path):
    (tmp_path / "a.png").write_bytes(b"png")
    for identifier, output, inherits in (("ND_image_color3", "color3f outputs:rgb", True),
                                         ("ND_image_vector3", "float3 outputs:v", False),
                                         ("UsdUVTexture", "color3f outputs:rgb", False)):
        text = stage_of(f"asset inputs:file = @a.png@\n{output}", DEFINED, identifier=identifier)
        assert ("colorSpace file" in read(text).prim("/w/m")) == inherits, identifier


@pytest.mark.parametrize("space, expected", [
    ("lin_rec709_scene", (0.8, 0.1, 0.05)), ("data", (0.8, 0.1, 0.05)), ("identity", (0.8, 0.1, 0.05)),
    ("g22_rec709_scene", tuple(v ** 2.2 for v in (0.8, 0.1, 0.05))),
    ("gamma24", tuple(v ** 2.4 for v in (0.8, 0.1, 0.05))),
    # AP1 to Rec.709 as the ACES reference implementation gives it, of (0.5, 0.5, 0.25)
    ("lin_ap1_scene", (0.520815, 0.502637, 0.211757)),
])
def test_values_reach_the_surface_converted(tmp_path, space, expected):
    value = (0.5, 0.5, 0.25) if space == "lin_ap1_scene" else (0.8, 0.1, 0.05)
    for inherited in (False, True):
        here = "" if inherited else f'(colorSpace = "{space}")'
        world = DEFINED.replace("lin_ap1_scene", space) if inherited else "{"
        stage = Usd.Stage.CreateInMemory()
        stage.GetRootLayer().ImportFromString("#usda 1.0\n" + stage_of(
            f"color3f inputs:diffuseColor = {value} {here}\nfloat inputs:ior = 1", world))
        warnings = []
        (_, network), = read_materials(stage, warnings)
        probe = _patina.MaterialProbe(network)
        assert not warnings and not probe.warnings
        assert probe.albedo(np.array([[0, 0, 1]], np.float32))[0] == pytest.approx(expected, abs=2e-4)


def test_colours_of_lights_are_converted_too(read, numbers):
    reading = read(f"""def Scope "w" {DEFINED}
        def SphereLight "inherits" {{ color3f inputs:color = (0.5, 0.5, 0.25) }}
        def SphereLight "says" {{ color3f inputs:color = (0.5, 0.5, 0.25) (colorSpace = "g22_rec709_scene") }}
        def SphereLight "unknown" {{ color3f inputs:color = (0.5, 0.5, 0.25) (colorSpace = "nobody knows") }}
        def SphereLight "outside" {{ color3f inputs:color = (1, 0, 0) }}
        def SphereLight "white" {{ }}
    }}""")
    assert numbers(reading.prim("/w/inherits")["color"]) == pytest.approx((0.520815, 0.502637, 0.211757), abs=2e-4)
    assert numbers(reading.prim("/w/says")["color"]) == pytest.approx([v ** 2.2 for v in (0.5, 0.5, 0.25)], abs=1e-5)
    assert numbers(reading.prim("/w/unknown")["color"]) == [0.5, 0.5, 0.25]
    assert numbers(reading.prim("/w/outside")["color"]) == pytest.approx((1.70505, 0, 0), abs=2e-4)
    assert "color" not in reading.prim("/w/white")
    assert [w for w in reading.warnings if "colour space" in w] == [
        "/w/unknown inputs:color: unknown colour space 'nobody knows'; the value is used as it is"]


def test_values_know_the_spaces_of_the_users_configuration(tmp_path):
    """In a process of its own: the configuration is read once."""
    (tmp_path / "config.ocio").write_text("""ocio_profile_version: 2
roles: {aces_interchange: AP0, scene_linear: AP0, default: AP0}
file_rules: [!<Rule> {name: Default, colorspace: AP0}]
displays: {Mine: [!<View> {name: Plain, colorspace: AP0}]}
colorspaces:
  - !<ColorSpace> {name: AP0}
  - !<ColorSpace>
    name: half of AP0
    to_scene_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
""")
    program = ("import _patina\nfor s in ('half of AP0', 'lin_ap0_scene', 'gamma22', 'nobody knows'):\n"
               "    print(_patina.color_to_rendering([0.5, 0.5, 0.25], s))")
    reported = subprocess.run([sys.executable, "-c", program], env={**os.environ, "OCIO": str(tmp_path / "config.ocio")},
                          capture_output=True, text=True, check=True).stdout.splitlines()
    half, whole, gamma, unknown = (ast.literal_eval(line) for line in reported)
    assert whole != pytest.approx([0.5, 0.5, 0.25], abs=0.01)
    assert half == pytest.approx([0.5 * x for x in whole], abs=1e-4)
    assert gamma == pytest.approx([v ** 2.2 for v in (0.5, 0.5, 0.25)], abs=1e-6)
    assert unknown is None


TRIANGLE = """point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
            int[] faceVertexCounts = [3]
            int[] faceVertexIndices = [0, 1, 2]"""


def test_colours_of_primvars_are_converted_too(read, numbers):
    """Those of prims, inherited from prims above, and of instances; what is no colour stays."""
    g22 = [v ** 2.2 for v in (0.5, 0.5, 0.25)]
    reading = read(f"""def Scope "w" {DEFINED}
        def Mesh "inherits" {{
            {TRIANGLE}
            color3f[] primvars:displayColor = [(0.5, 0.5, 0.25)]
            float[] primvars:displayOpacity = [0.5]
            float3[] primvars:vectors = [(0.5, 0.5, 0.25)]
        }}
        def Mesh "says" {{
            {TRIANGLE}
            color3f[] primvars:displayColor = [(0.5, 0.5, 0.25), (1, 1, 1)] (
                colorSpace = "g22_rec709_scene"
                interpolation = "vertex"
            )
            int[] primvars:displayColor:indices = [0, 1, 0]
            color4h[] primvars:paint = [(0.5, 0.5, 0.25, 0.5)] (colorSpace = "g22_rec709_scene")
            color3f[] primvars:plain = [(0.5, 0.5, 0.25)] (colorSpace = "raw")
            color3f[] primvars:unknown = [(0.5, 0.5, 0.25)] (colorSpace = "nobody knows")
        }}
        def Xform "above" {{
            color3f[] primvars:displayColor = [(0.5, 0.5, 0.25)] (
                colorSpace = "g22_rec709_scene"
                interpolation = "constant"
            )
            def Sphere "below" {{ }}
        }}
        def PointInstancer "many" {{
            rel prototypes = </w/many/one>
            int[] protoIndices = [0, 0]
            point3f[] positions = [(0, 0, 0), (1, 0, 0)]
            color3f[] primvars:displayColor = [(0.5, 0.5, 0.25), (1, 1, 1)] (
                colorSpace = "g22_rec709_scene"
                interpolation = "vertex"
            )
            def Sphere "one" {{ }}
        }}
    }}""")

    def primvar(path, name):
        prim = reading.prim(path)
        values, = [prim[key] for key in prim if key.startswith(f"primvar {name} ") and not key.endswith(" indices")]
        return numbers(values)

    assert primvar("/w/inherits", "displayColor") == pytest.approx((0.520815, 0.502637, 0.211757), abs=2e-4)
    assert primvar("/w/inherits", "displayOpacity") == [0.5]
    assert primvar("/w/inherits", "vectors") == [0.5, 0.5, 0.25]
    assert primvar("/w/says", "displayColor") == pytest.approx([*g22, 1, 1, 1], abs=1e-5)
    assert primvar("/w/says", "paint") == pytest.approx([*g22, 0.5], abs=1e-5)
    assert primvar("/w/says", "plain") == primvar("/w/says", "unknown") == [0.5, 0.5, 0.25]
    assert primvar("/w/above/below", "displayColor") == pytest.approx(g22, abs=1e-5)
    assert primvar("/w/many", "displayColor") == pytest.approx([*g22, 1, 1, 1], abs=1e-5)
    assert [w for w in reading.warnings if "colour space" in w] == [
        "/w/says primvars:unknown: unknown colour space 'nobody knows'; the values are used as they are"]


@pytest.mark.parametrize("field, value, message", [
    ("string {}:gamma", '"abc"', "is not as many finite numbers as the schema has; (1.0,) is used"),
    ("float {}:redChroma", "0.5", "is not as many finite numbers as the schema has; (1.0, 0.0) is used"),
    ("float {}:linearBias", "inf", "is not as many finite numbers as the schema has; (0.0,) is used"),
    ("int {}:name", "5", "is not the name of a colour space; it is left out")])
def test_definitions_with_wrong_values_are_told(read, field, value, message):
    field = field.format("colorSpaceDefinition:mine")
    world = f"""(prepend apiSchemas = ["ColorSpaceAPI", "ColorSpaceDefinitionAPI:mine"]) {{
        {field} = {value}"""
    reading = read(stage_of("color3f inputs:diffuseColor = (0.5, 0.5, 0.25)", world))
    assert f"/w {field.split()[1]}: {message}" in reading.warnings
    assert "terminal surface" in reading.prim("/w/m")
