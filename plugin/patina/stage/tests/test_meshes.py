# SPDX-License-Identifier: Apache-2.0
"""Meshes, primvars, subsets, purposes and visibility."""
import pytest

QUAD = """
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
"""


def test_every_field_of_a_subdivided_mesh(read):
    tokens = {"interpolateBoundary": "edgeOnly", "faceVaryingLinearInterpolation": "all", "triangleSubdivisionRule": "smooth"}
    arrays = {"int[] holeIndices": [0], "int[] creaseIndices": [0, 1], "int[] creaseLengths": [2],
              "float[] creaseSharpnesses": [3.5], "int[] cornerIndices": [2], "float[] cornerSharpnesses": [10]}
    mesh = read("""def Mesh "m" {
        uniform token subdivisionScheme = "loop"
        uniform token orientation = "leftHanded"
        uniform bool doubleSided = 1
        """ + "".join(f'uniform token {name} = "{value}"\n' for name, value in tokens.items())
                + "".join(f"{declared} = {value}\n" for declared, value in arrays.items()) + QUAD + "}",
                complexity="high").prim("/m")
    assert mesh["kind"] == "Mesh" and mesh["scheme"] == "loop" and mesh["refineLevel"] == "2"
    assert mesh["leftHanded"] == "true" and "doubleSided" not in mesh
    assert mesh["points"] == "0 0 0, 1 0 0, 1 1 0, 0 1 0"
    assert mesh["faceVertexCounts"] == "4" and mesh["faceVertexIndices"] == "0 1 2 3"
    assert {name: mesh[name].strip('"') for name in tokens} == tokens
    for declared, value in arrays.items():
        assert mesh[declared.split()[1]] == " ".join(map(str, value)), declared


PRIMVARS = {  # of a mesh -> what the scene has of it
    "float primvars:own = 2": "own constant = 2",
    'texCoord2f[] primvars:st = [(0, 0), (1, 1)] (interpolation = "faceVarying")': "st faceVarying x2 = 0 0, 1 1",
    "int[] primvars:st:indices = [0, 1, 1, 0]": "st indices = 0 1 1 0",
    'half3[] primvars:h = [(0.5, 0.25, 1)] (interpolation = "uniform")': "h uniform x3 = 0.5 0.25 1",
    'double[] primvars:d = [1, 2, 3, 4] (interpolation = "vertex")': "d vertex = 1 2 3 4",
    'float[] primvars:wide = [1, 2, 3, 4] (interpolation = "uniform"; elementSize = 4)': "wide uniform x4 = 1 2 3 4",
    "matrix4d[] primvars:m = [((1,0,0,0),(0,1,0,0),(0,0,1,0),(5,0,0,1))]": "m constant x16 = 1 0 0 0 0 1 0 0 0 0 1 0 5 0 0 1"}


def test_primvars_of_each_kind(read):
    mesh = read("""def Xform "x" {
        color3f[] primvars:displayColor = [(1, 0, 0)]
        float primvars:shade = 0.5
        float primvars:own = 1
        def Mesh "m" {
            string primvars:text = "left out"
            int[] primvars:skel:jointIndices = [1]
            """ + "\n".join(PRIMVARS) + QUAD + "} }").prim("/x/m")
    expected = {*PRIMVARS.values(), "displayColor constant x3 = 1 0 0", "shade constant = 0.5"}
    assert {f"{key[8:]} = {value}" for key, value in mesh.items() if key.startswith("primvar ")} == expected


def test_an_element_size_that_nothing_fits_is_ignored(read):
    """As old exporters write it: the size of their own tuples."""
    indexed = "int[] primvars:st:indices = [0, 1, 2, 3]\n"
    kind = '(interpolation = "faceVarying"; elementSize = 4)'
    corners = "[(0, 0), (1, 0), (1, 1), (0, 1)]"
    for own in (indexed, ""):
        scene = read(f'def Mesh "m" {{ texCoord2f[] primvars:st = {corners} {kind}\n{own}{QUAD} }}')
        assert scene.prim("/m")["primvar st faceVarying x2"] == "0 0, 1 0, 1 1, 0 1"
        assert not scene.warnings
    wide = ", ".join(["(0, 0), (1, 0), (1, 1), (0, 1)"] * 4)
    fits = read(f'def Mesh "m" {{ texCoord2f[] primvars:st = [{wide}] {kind}\n{indexed}{QUAD} }}')
    assert "primvar st faceVarying x8" in fits.prim("/m")


def test_primvar_normals_stand_above_normals(read):
    text = ('def Mesh "m" { uniform token subdivisionScheme = "none"\n'
            ' normal3f[] normals = [(0, 0, 1)] (interpolation = "uniform")\n%s' + QUAD + "}")
    assert read(text % "").prim("/m")["primvar normals uniform x3"] == "0 0 1"
    mesh = read(text % 'normal3f[] primvars:normals = [(0, 1, 0)] (interpolation = "constant")').prim("/m")
    assert mesh["primvar normals constant x3"] == "0 1 0"
    assert "primvar normals uniform x3" not in mesh


def test_what_has_an_unknown_interpolation_is_left_out_alone(read):
    reading = read('def Mesh "m" { uniform token subdivisionScheme = "none"\n'
                   ' float[] primvars:q = [1] (interpolation = "bogus")\n'
                   ' normal3f[] normals = [(0, 0, 1)] (interpolation = "face")\n' + QUAD + "}")
    assert reading.prim("/m") and not any(" q " in key or "normals" in key for key in reading.prim("/m"))
    said = "\n".join(reading.warnings)
    assert "/m primvars:q: has no interpolation 'bogus'" in said and "/m normals: has no interpolation 'face'" in said


def test_subsets_and_inherited_bindings(read):
    reading = read("""
    def Material "red" { token outputs:surface.connect = </red/s.outputs:out>
        def Shader "s" { uniform token info:id = "UsdPreviewSurface"  token outputs:out } }
    def Material "blue" { token outputs:surface.connect = </blue/s.outputs:out>
        def Shader "s" { uniform token info:id = "UsdPreviewSurface"  token outputs:out } }
    def Xform "x" (prepend apiSchemas = ["MaterialBindingAPI"]) {
        rel material:binding = </red>
        def Mesh "m" {""" + QUAD + """
            def GeomSubset "part" (prepend apiSchemas = ["MaterialBindingAPI"]) {
                uniform token elementType = "face"
                uniform token familyName = "materialBind"
                int[] indices = [0]
                rel material:binding = </blue>
            }
            def GeomSubset "other" { uniform token familyName = "selection"  int[] indices = [0] }
            def GeomSubset "points" (prepend apiSchemas = ["MaterialBindingAPI"]) {
                uniform token elementType = "point"
                uniform token familyName = "materialBind"
                int[] indices = [0]
                rel material:binding = </blue>
            }
        } }""")
    mesh = reading.prim("/x/m")
    assert mesh["material"] == '"/red"'
    assert mesh['subset /x/m/part material "/blue"'] == "0"
    assert not any("other" in key or "points" in key for key in mesh if key.startswith("subset"))
    assert [w for w in reading.warnings if w.startswith("/x/m/points elementType: is point, ")]
    assert reading.prim("/blue")["terminal surface"] == "/blue/s.surface"
    assert reading.info.counts["materials"] == 2


INSTANCED = """
    def Material "red" { token outputs:surface.connect = </red/s.outputs:out>
        def Shader "s" { uniform token info:id = "UsdPreviewSurface"  token outputs:out } }
    def Material "blue" { token outputs:surface.connect = </blue/s.outputs:out>
        def Shader "s" { uniform token info:id = "UsdPreviewSurface"  token outputs:out } }
    class Mesh "quad" {""" + QUAD + """
        def GeomSubset "part" (prepend apiSchemas = ["MaterialBindingAPI"]) {
            uniform token elementType = "face"
            uniform token familyName = "materialBind"
            int[] indices = [0]
            rel material:binding = </blue> } }
    class Xform "set" {
        def Mesh "m" (prepend apiSchemas = ["MaterialBindingAPI"]; inherits = </quad>; instanceable = HOW) {
            rel material:binding = </red> (bindMaterialAs = "RULE") } }
    def Mesh "m" (prepend apiSchemas = ["MaterialBindingAPI"]; inherits = </quad>; instanceable = HOW) {
        rel material:binding = </red> (bindMaterialAs = "RULE") }
    def Xform "one" (inherits = </set>; instanceable = true) { }
    def Xform "two" (inherits = </set>; instanceable = true) { }"""


@pytest.mark.parametrize("rule, wanted", [("weakerThanDescendants", "/blue"), ("strongerThanDescendants", "/red")])
def test_instanceable_meshes_keep_their_subsets(read, rule, wanted):
    """At the root, and in a prototype."""
    text = INSTANCED.replace("RULE", rule)
    plain, instanced = (read(text.replace("HOW", how)) for how in ("false", "true"))
    assert instanced.text == plain.text and plain.text.count("subset ") == 2
    assert instanced.prim("/m")[f'subset /m/part material "{wanted}"'] == "0"


def test_full_purpose_bindings_and_collections(read):
    reading = read("""
    def Material "a" { token outputs:surface.connect = </a/s.outputs:out>
        def Shader "s" { uniform token info:id = "UsdPreviewSurface"  token outputs:out } }
    def Material "b" { token outputs:surface.connect = </b/s.outputs:out>
        def Shader "s" { uniform token info:id = "UsdPreviewSurface"  token outputs:out } }
    def Xform "x" (prepend apiSchemas = ["MaterialBindingAPI", "CollectionAPI:some"]) {
        rel collection:some:includes = </x/c>
        rel material:binding:collection:some = [</x.collection:some>, </b>]
        def Sphere "f" (prepend apiSchemas = ["MaterialBindingAPI"]) {
            rel material:binding = </b>
            rel material:binding:full = </a> }
        def Sphere "c" { } }""")
    assert reading.prim("/x/f")["material"] == '"/a"'
    assert reading.prim("/x/c")["material"] == '"/b"'


def test_visibility_at_the_frame_and_purposes(read):
    text = """(startTimeCode = 1)
    def Sphere "s" { token visibility.timeSamples = { 1: "inherited", 2: "invisible" } }
    def Xform "h" { token visibility = "invisible"
        def Sphere "below" { }
        def Camera "cam" { } }
    def Xform "g" { uniform token purpose = "guide"
        def Sphere "guide" { }
        def Sphere "drawn" { uniform token purpose = "render" } }
    def Sphere "p" { uniform token purpose = "proxy" }"""
    first = read(text, frame=1.0)
    assert first.has("/s") and not first.has("/h/below")
    assert not first.has("/g/guide") and first.has("/g/drawn") and not first.has("/p")
    assert first.info.camera == "/h/cam"
    assert not read(text, frame=2.0).has("/s")
    assert read(text, frame=1.0, purposes=("proxy",)).has("/p")
    assert not read(text, frame=1.0, purposes=("proxy",)).has("/g/drawn")


def test_a_purpose_that_there_is_none_of_is_told(read):
    reading = read('def Sphere "s" { uniform token purpose = "rendr" }')
    assert not reading.has("/s")
    assert any("/s purpose: there is no purpose 'rendr'" in line for line in reading.warnings), reading.warnings


def test_wrong_types_and_unknown_tokens_are_warned_of(read):
    reading = read("""
    def Mesh "ints" { int[] faceVertexCounts = [3]  int[] faceVertexIndices = [0, 1, 2]  int[] points = [0, 1, 2] }
    def Mesh "token" { uniform token subdivisionScheme = "nonsense" """ + QUAD + """ }
    def PortalLight "portal" { }
    def Sphere "fine" { }""")
    assert any(w.startswith("/ints points:") for w in reading.warnings)
    assert any(w.startswith("/token subdivisionScheme: 'nonsense' is unknown") for w in reading.warnings)
    assert any(w.startswith("/portal : prims of type PortalLight") for w in reading.warnings)
    assert reading.has("/fine") and "scheme" in reading.prim("/token")


def test_times_that_are_one_to_the_renderer(read, numbers):
    """Velocities give points at both ends of the shutter, which may be the same as 32-bit floats."""
    mesh = read("""def Mesh "m" { int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points.timeSamples = { 10: [(0,0,0), (1,0,0), (0,1,0)] }
        vector3f[] velocities.timeSamples = { 10: [(24,0,0), (24,0,0), (24,0,0)] } }""",
                frame=10.0, shutter=(0.5, 0.50000000001)).prim("/m")
    assert numbers(mesh["points"])[0] == pytest.approx(0.5)
