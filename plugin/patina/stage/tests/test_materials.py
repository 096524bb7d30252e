# SPDX-License-Identifier: Apache-2.0
"""Material networks, textures, and what can be wrong with them."""
import os
import zipfile

import pytest

import _patina


def material(body, name="m"):
    return (f'def Material "{name}" {{ {body} }}\n'
            f'def Sphere "ball{name}" (prepend apiSchemas = ["MaterialBindingAPI"]) {{ rel material:binding = </{name}> }}\n')


SHADER = """
    token outputs:surface.connect = </m/s.outputs:out>
    color3f inputs:tint = (0.1, 0.2, 0.3)
    def Shader "s" {
        uniform token info:id = "UsdPreviewSurface"
        %s
        token outputs:out }
"""


TYPED = {  # input of a shader -> what the scene has of it
    "float inputs:roughness = 0.25": "float roughness = 0.25",
    "int inputs:useSpecularWorkflow = 1": "integer useSpecularWorkflow = 1",
    'color3f inputs:diffuseColor = (1, 0.5, 0) (colorSpace = "lin_rec709")': "color3 diffuseColor = 1 0.5 0",
    "normal3f inputs:normal = (0, 0, 1)": "vector3 normal = 0 0 1",
    'token inputs:mode = "word"': 'string mode = "word"',
    "bool inputs:flag = 1": "boolean flag = 1",
    "matrix4d inputs:m = ((1,0,0,0),(0,1,0,0),(0,0,1,0),(2,0,0,1))": "matrix44 m = 1 0 0 0 0 1 0 0 0 0 1 0 2 0 0 1",
    "double inputs:d = 0.5": "float d = 0.5"}


def test_values_of_each_type(read):
    m = read(material(SHADER % "\n".join([*TYPED, "float inputs:unset"]))).prim("/m")
    assert m["terminal surface"] == "/m/s.surface" and m["node /m/s"] == "UsdPreviewSurface"
    assert not set(TYPED.values()) - {f"{name} = {value}" for name, value in m.items()}, m
    assert m["colorSpace diffuseColor"] == "lin_rec709" and not any("unset" in key for key in m)


def test_frame_and_time_come_from_the_stage(read):
    text = material("""
        token outputs:mtlx:surface.connect = </m/s.outputs:out>
        def Shader "frame" { uniform token info:id = "ND_frame_float"
            float outputs:out }
        def Shader "time" { uniform token info:id = "ND_time_float"
            float outputs:out }
        def Shader "film" { uniform token info:id = "ND_time_float"
            float inputs:fps = 12
            float outputs:out }
        def Shader "s" {
            uniform token info:id = "ND_surface_unlit"
            float inputs:emission.connect = </m/frame.outputs:out>
            float inputs:opacity.connect = </m/time.outputs:out>
            float inputs:transmission.connect = </m/film.outputs:out>
            token outputs:out }""")
    dump = read(text, frame=30.0).text
    assert dump.count("float frame = 30") == 3
    assert dump.count("float fps = 24") == 1 and dump.count("float fps = 12") == 1
    assert "float frame" not in read(text).text


def test_connections_and_interfaces(read):
    m = read(material(SHADER % """
        color3f inputs:diffuseColor.connect = </m/graph.outputs:result>
        color3f inputs:emissiveColor.connect = </m.inputs:tint>
    """ + """
    def NodeGraph "graph" {
        float inputs:gain = 0.75
        color3f outputs:result.connect = </m/graph/tex.outputs:rgb>
        def Shader "tex" { uniform token info:id = "UsdUVTexture"
            float inputs:fallback.connect = </m/graph.inputs:gain>
            color3f outputs:rgb } }""")).prim("/m")
    assert m["connect diffuseColor"] == "/m/graph/tex.rgb"
    assert m["color3 emissiveColor"] == "0.1 0.2 0.3"
    assert m["node /m/graph/tex"] == "UsdUVTexture" and m["float fallback"] == "0.75"


def test_mtlx_context_is_preferred(read):
    m = read(material("""
        token outputs:surface.connect = </m/plain.outputs:out>
        token outputs:mtlx:surface.connect = </m/x.outputs:out>
        token outputs:displacement.connect = </m/plain.outputs:out>
        def Shader "plain" { uniform token info:id = "UsdPreviewSurface"  token outputs:out }
        def Shader "x" { uniform token info:id = "ND_standard_surface_surfaceshader"  token outputs:out }""")).prim("/m")
    assert m["terminal surface"] == "/m/x.out" and m["terminal displacement"] == "/m/plain.displacement"


BROKEN = {
    "in a cycle": ("color3f inputs:diffuseColor.connect = </m/a.outputs:o>", """
        def NodeGraph "a" { color3f outputs:o.connect = </m/b.outputs:o> }
        def NodeGraph "b" { color3f outputs:o.connect = </m/a.outputs:o> }"""),
    "does not exist": ("color3f inputs:diffuseColor.connect = </m/nowhere.outputs:o>", ""),
    "info:id: is not authored": ("color3f inputs:diffuseColor.connect = </m/x.outputs:o>", """
        def Shader "x" { color3f outputs:o }"""),
    "values of type float[] cannot be used": ("float[] inputs:many = [1, 2]", ""),
}


@pytest.mark.parametrize("said", BROKEN)
def test_broken_networks_are_warned_of(read, said):
    inputs, rest = BROKEN[said]
    reading = read(material(SHADER % inputs + rest))
    assert any(said in w for w in reading.warnings), reading.warnings
    assert reading.prim("/m")["node /m/s"] == "UsdPreviewSurface"


def test_nodes_in_a_cycle_end(read):
    reading = read(material(SHADER % "color3f inputs:diffuseColor.connect = </m/a.outputs:o>" + """
    def Shader "a" { uniform token info:id = "UsdUVTexture"
        color3f inputs:x.connect = </m/b.outputs:o>  color3f outputs:o }
    def Shader "b" { uniform token info:id = "UsdUVTexture"
        color3f inputs:x.connect = </m/a.outputs:o>  color3f outputs:o }"""))
    assert reading.text.count("connect x = ") == 2  # the network keeps the cycle; its expansion cuts it


def test_materials_of_other_renderers_are_named(read):
    reading = read(material("""token outputs:ri:surface.connect = </m/s.outputs:out>
        def Shader "s" { uniform token info:id = "PxrSurface"  token outputs:out }"""))
    assert any("outputs:ri:surface" in w for w in reading.warnings)


def test_textures_are_resolved(read, tmp_path):
    (tmp_path / "a.png").write_bytes(b"png")
    (tmp_path / "t.1001.png").write_bytes(b"png")
    m = read(material(SHADER % """
        asset inputs:file = @./a.png@ (colorSpace = "srgb_texture")
        asset inputs:tiles = @./t.<UDIM>.png@
        asset inputs:missing = @./none.png@
    """)).prim("/m")
    assert m["filename file"] == f'"{tmp_path}/a.png"' and m["colorSpace file"] == "srgb_texture"
    assert m["filename tiles"] == f'"{tmp_path}/t.<UDIM>.png"'
    assert m["filename missing"] == f'"{tmp_path}/none.png"'


def test_textures_inside_a_package(read, statements, tmp_path):
    inner = tmp_path / "inner.usda"
    textures = "".join(f"asset inputs:{name} = @{path}@\n" for name, path in (
        ("file", "tex/a.png"), ("tiles", "tex/t.<UDIM>.png"), ("beside", "out/b.<UDIM>.png")))
    (tmp_path / "out").mkdir()
    (tmp_path / "out/b.1003.png").write_bytes(b"beside")
    inner.write_text("#usda 1.0\n" + statements(material(SHADER % textures)))
    package = tmp_path / "p.usdz"
    with zipfile.ZipFile(package, "w", zipfile.ZIP_STORED) as z:
        for name, data in (("inner.usda", inner.read_bytes()), ("tex/a.png", b"first"), ("tex/t.1002.png", b"tile")):
            info = zipfile.ZipInfo(name)
            offset = z.fp.tell() + 30 + len(name)
            pad = (64 - (offset + 4) % 64) % 64
            info.extra = b"\x86\x19" + pad.to_bytes(2, "little") + b"\0" * pad
            z.writestr(info, data)
    m = read(package).prim("/m")
    with open(m["filename file"].strip('"'), "rb") as file:
        assert file.read() == b"first"
    tiles = m["filename tiles"].strip('"')
    assert "<UDIM>" in tiles and os.path.exists(tiles.replace("<UDIM>", "1002"))
    assert m["filename beside"] == f'"{tmp_path}/out/b.<UDIM>.png"'


def test_a_type_that_usd_does_not_know_is_told(read):
    reading = read("""
    def Material "look" { token outputs:mtlx:surface.connect = </look/s.outputs:out>
        def Shader "s" { uniform token info:id = "ND_standard_surface_surfaceshader"
            vector2f inputs:base = (0.5, 0.5)
            token outputs:out } }
    def Sphere "s" (prepend apiSchemas = ["MaterialBindingAPI"]) { rel material:binding = </look> }""")
    assert reading.has("/look")
    assert any("/look/s" in w and "vector2f cannot be used; the default is" in w for w in reading.warnings), reading.warnings


def test_references_to_materialx_documents(read, tmp_path):
    (tmp_path / "doc.mtlx").write_text("""<?xml version="1.0"?><materialx version="1.39">
        <standard_surface name="shader" type="surfaceshader"><input name="base" type="float" value="0.3"/></standard_surface>
        <surfacematerial name="Look" type="material">
            <input name="surfaceshader" type="surfaceshader" nodename="shader"/></surfacematerial>
        </materialx>""")
    reading = read("""
    def Scope "mtl" (references = @./doc.mtlx@</MaterialX/Materials>) { }
    def Sphere "s" (prepend apiSchemas = ["MaterialBindingAPI"]) { rel material:binding = </mtl/Look> }""")
    assert reading.prim("/s")["material"] == '"/mtl/Look"'
    assert reading.prim("/mtl/Look")["float base"] == "0.3"
    assert not reading.warnings


def test_materialx_documents_that_cannot_be_used(read, tmp_path):
    (tmp_path / "noise.mtlx").write_text("this is no document")
    (tmp_path / "empty.mtlx").write_text('<?xml version="1.0"?><materialx version="1.39"/>')
    reading = read("""(subLayers = [@./sub.mtlx@])
    def Scope "a" (references = @./none.mtlx@) { }
    def Scope "b" (references = @./noise.mtlx@) { }
    def Scope "c" (references = @./empty.mtlx@</MaterialX/Materials/Gold>) { }
    def Sphere "s" { }""")
    said = "\n".join(reading.warnings)
    for part in ("sub.mtlx", "/a references: there is no file", "noise.mtlx", "/c references:"):
        assert part in said, said
    assert reading.has("/s")


def test_materials_alone_are_read_past_broken_ones(tmp_path, statements, monkeypatch):
    from pxr import Usd

    from patina.stage import read_materials, readMaterials
    (tmp_path / "stage.usda").write_text("#usda 1.0\n" + statements(
        (material(SHADER % "") + material(SHADER.replace("/m/", "/n/") % "", "n")).replace(
            'def Material "n" {', 'def Material "n" (customData = { int patinaDocument = 5 }) {')))
    stage, warnings = Usd.Stage.Open(str(tmp_path / "stage.usda")), []
    assert [path for path, _ in read_materials(stage, warnings)] == ["/m", "/n"] and not warnings

    def fails(context, prim, path, own=readMaterials.network_of):
        return own(context, prim, path) if path == "/n" else {}["x"]

    monkeypatch.setattr(readMaterials, "network_of", fails)
    assert [path for path, _ in read_materials(stage, warnings)] == ["/n"]
    assert [(w["prim"], "cannot be read" in w["message"]) for w in warnings] == [("/m", True)]


CONNECTED = {  # what the shader's input is connected to -> (lines of the material, value)
    "an interface without a value": ("/m.inputs:none", "color3f inputs:none", "1 0 0"),
    "an interface with a value": ("/m.inputs:tint", "", "0.1 0.2 0.3"),
    "a graph's input whose own source is empty": ("/m/g.inputs:a", """color3f inputs:none
        def NodeGraph "g" { color3f inputs:a = (0, 0, 1)  color3f inputs:a.connect = </m.inputs:none> }""", "0 0 1"),
    "a graph's output with a value": ("/m/g.outputs:a", 'def NodeGraph "g" { color3f outputs:a = (0, 1, 0) }', "0 1 0"),
    "a cycle": ("/m/g.inputs:a", """def NodeGraph "g" { color3f inputs:a.connect = </m/g.inputs:b>
        color3f inputs:b.connect = </m/g.inputs:a> }""", "1 0 0"),
}


@pytest.mark.parametrize("what", CONNECTED)
def test_values_come_from_where_usd_shade_finds_them(read, what):
    path, lines, value = CONNECTED[what]
    own = f"color3f inputs:diffuseColor = (1, 0, 0)\ncolor3f inputs:diffuseColor.connect = <{path}>"
    reading = read(material(SHADER % own + lines))
    assert reading.prim("/m")["color3 diffuseColor"] == value
    assert len(reading.warnings) == (what == "a cycle"), reading.warnings


@pytest.mark.parametrize("name, kind", [("UsdPreviewSurface", "surface"), ("UsdPreviewSurface", "displacement"),
                                        ("ND_standard_surface_surfaceshader", "surface"), ("Unknown", "surface")])
def test_outputs_of_terminals_may_have_any_name(read, name, kind):
    m = read(material(f"""token outputs:{kind}.connect = </m/s.outputs:mine>
        def Shader "s" {{ uniform token info:id = "{name}"  token outputs:mine }}""")).prim("/m")
    known = {"UsdPreviewSurface": kind, "Unknown": "mine"}.get(name, "out")
    assert m[f"terminal {kind}"] == f"/m/s.{known}"


def test_primvars_of_a_material_are_those_of_prims_without(read):
    reading = read(material(SHADER % "" + "float primvars:level = 3  color3f[] primvars:displayColor = [(1, 0, 0)]") + """
    def Sphere "own" (prepend apiSchemas = ["MaterialBindingAPI"]) { rel material:binding = </m>  float primvars:level = 1 }
    def Xform "above" { float primvars:level = 2
        def Sphere "s" (prepend apiSchemas = ["MaterialBindingAPI"]) { rel material:binding = </m> } }
    def Sphere "unbound" { }
    class Xform "ball" { def Sphere "s" (prepend apiSchemas = ["MaterialBindingAPI"]) { rel material:binding = </m> } }
    def Xform "i" (instanceable = true; inherits = </ball>) { float primvars:level = 4 }""")
    assert "primvar level constant" not in reading.prim("/i/s") and reading.prim("/i")["primvar level constant"] == "4"
    levels = {path: reading.prim(path).get("primvar level constant") for path in ("/ballm", "/own", "/above/s", "/unbound")}
    assert levels == {"/ballm": "3", "/own": "1", "/above/s": "2", "/unbound": None}
    assert reading.prim("/own")["primvar displayColor constant x3"] == "1 0 0"


def test_numbers_with_a_unit_are_those_of_the_scene(read):
    shader = """
        token outputs:mtlx:surface.connect = </m/s.outputs:out>
        def Shader "s" {
            uniform token info:id = "%s"
            float inputs:emission = 10 (%s)
            token outputs:out }"""
    for metadata, emission in (("displayUnit = in", 25.4), ('customData = { string unit = "inch" }', 25.4),
                               ('customData = { string unit = "radian" }', 572.9578), ("hidden = 1", 10)):
        m = read(material(shader % ("ND_surface_unlit", metadata))).prim("/m")  # in centimetres
        assert float(m["float emission"]) == pytest.approx(emission, rel=1e-5), metadata
    assert read(material(shader % ("Other", "displayUnit = in"))).prim("/m")["float emission"] == "10"
    odd = read(material(shader % ("ND_surface_unlit", 'customData = { string unit = "stone" }')))
    assert odd.prim("/m")["float emission"] == "10" and any("no unit 'stone'" in w for w in odd.warnings)


def test_networks_are_of_138_unless_they_say_otherwise(read):
    body = """
        %s
        token outputs:mtlx:surface.connect = </m/s.outputs:out>
        def Shader "s" { uniform token info:id = "ND_surface_unlit"
            color3f inputs:emission_color.connect = </m/w.outputs:out>
            token outputs:out }
        def Shader "w" { uniform token info:id = "ND_switch_color3"
            float inputs:which = 7
            color3f outputs:out }"""
    for version, which in (("", "0"), ('"1.38"', "0"), ('"1.39"', "7"), ('"1.40.2"', "7"), ('""', "0")):
        said = f"string config:mtlx:version = {version}" if version else ""
        assert read(material(body % said)).prim("/m")["float which"] == which, version


def test_a_shader_has_its_output_whatever_that_is_called():
    network = _patina.Network("/m")
    network.add_node("/m/s", "UsdPreviewSurface")
    for output in ("out", ""):
        network.set_terminal("surface", "/m/s", output)
        network.set_terminal("displacement", "/m/s", output)
        expanded, warnings = _patina.expand_material(network)
        assert "surface" in expanded.terminals() and not warnings
