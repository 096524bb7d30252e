# SPDX-License-Identifier: Apache-2.0
"""`patina bake --in-place`: the material is replaced, everything else in the file stays."""
import os
import resource

import pytest
from pxr import Sdf, Usd, UsdShade

import _patina
import mtlx
from patina.cli import main, materials, tryStage
import usda

STAGE = usda.stage(
    usda.prim("Xform", "world",
        usda.prim("Sphere", "ball", "rel material:binding = </world/looks/one>"),
        usda.prim("Scope", "looks",
            usda.material("one", {
                "s": ("UsdPreviewSurface", {"color3f diffuseColor": "<t>", "roughness": 0.25}),
                "t": ("UsdUVTexture", {"file": "./paint.png", "float2 st": "<uv>"}),
                "uv": ("UsdPrimvarReader_float2", {"varname": "st"})}, inside="/world/looks", surface="s"),
            usda.prim("Material", "two", meta=("references = </world/looks/one>",))),
        meta=('customData = { string note = "kept" }',)),
    up="", defaultPrim="world", subLayers="[@./below.usda@]")
BELOW = '#usda 1.0\nover "world"\n{\n    over "looks"\n    {\n        over "one"\n        {\n        }\n    }\n}\n'


@pytest.fixture
def stage(tmp_path):
    (tmp_path / "stage.usda").write_text(STAGE)
    (tmp_path / "below.usda").write_text(BELOW)
    _patina.write_image(str(tmp_path / "paint.png"), [[[0.5, 0.2, 0.1], [0.1, 0.2, 0.5]]] * 2)
    return str(tmp_path / "stage.usda")


def bake(stage, path, out=None, *more, to="gltf_pbr"):
    Sdf.Layer.FindOrOpen(stage).Reload(True)
    return main.main(["bake", f"{stage}:{path}", out or stage, "--to", to, "--resolution", "4", "--in-place", *more])


def surface(stage, path):
    found = UsdShade.Material(stage.GetPrimAtPath(path)).ComputeSurfaceSource("mtlx")[0]
    return found.GetIdAttr().Get() if found else None


def reopened(path):
    layer = Sdf.Layer.FindOrOpen(path)
    layer.Reload(True)
    return Usd.Stage.Open(layer)


def test_all_other_prims_stay(stage, tmp_path):
    assert bake(stage, "/world/looks/one") == 0
    found = reopened(stage)
    assert surface(found, "/world/looks/one") == "ND_gltf_pbr_surfaceshader"
    assert found.GetDefaultPrim().GetPath() == "/world" and found.GetDefaultPrim().GetCustomDataByKey("note") == "kept"
    assert found.GetRootLayer().subLayerPaths == ["./below.usda"]
    ball = found.GetPrimAtPath("/world/ball")
    assert UsdShade.MaterialBindingAPI(ball).ComputeBoundMaterial()[0].GetPath() == "/world/looks/one"
    assert not found.GetPrimAtPath("/world/looks/one/t"), "what the material was made of is gone"
    (_, network), = materials.load(stage + ":/world/looks/one")[0]
    assert "gltf_pbr" in " ".join(node["id"] for node in network.nodes())
    assert sorted(os.listdir(tmp_path)) == ["below.usda", "paint.png", "stage.usda", "stage_world_looks_one_base_color.png"]


def test_textures_of_other_materials_of_the_file_stay(stage, tmp_path):
    """The second one is a reference to the first; both are baked after each other, and the first once more."""
    assert bake(stage, "/world/looks/two") == 0
    of_two = (tmp_path / "stage_world_looks_two_base_color.png").read_bytes()
    assert bake(stage, "/world/looks/one") == 0
    assert bake(stage, "/world/looks/one") == 0, "its own textures may be replaced"
    assert (tmp_path / "stage_world_looks_two_base_color.png").read_bytes() == of_two


def test_a_layer_that_is_too_weak_is_left_alone(stage, tmp_path, capsys):
    assert bake(stage, "/world/looks/one", str(tmp_path / "below.usda"), to="UsdPreviewSurface") == 1
    assert "other layers hide" in capsys.readouterr().err
    assert (tmp_path / "below.usda").read_text() == BELOW
    assert sorted(os.listdir(tmp_path)) == ["below.usda", "paint.png", "stage.usda"]


@pytest.mark.parametrize("name", ["binary.usdc", "text.usd", "new.usda"])
def test_any_format_and_files_that_are_new(name, stage, tmp_path):
    out = str(tmp_path / name)
    if name != "new.usda":
        layer = Sdf.Layer.CreateNew(out, args={"format": "usda"} if name.endswith(".usd") else {})
        Sdf.CreatePrimInLayer(layer, "/other").specifier = Sdf.SpecifierDef
        layer.Save()
    assert bake(stage, "/world/looks/one", out) == 0, "it is no layer of the stage, and none hides it"
    assert surface(reopened(out), "/one" if name == "new.usda" else "/world/looks/one") == "ND_gltf_pbr_surfaceshader"
    document = tmp_path / "m.mtlx"
    document.write_text(mtlx.document(mtlx.shader("m", inputs={"base": 0.5})))
    assert main.main(["bake", str(document), out, "--to", "gltf_pbr", "--in-place"]) == 0
    found = reopened(out)
    assert surface(found, "/m") == "ND_gltf_pbr_surfaceshader"
    assert bool(found.GetPrimAtPath("/other")) == (name != "new.usda")


def test_a_full_disk_keeps_stage_and_textures(stage, tmp_path):
    assert bake(stage, "/world/looks/one") == 0
    before = {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)}
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    texture = len(before["stage_world_looks_one_base_color.png"])
    assert texture < len(before["stage.usda"])
    resource.setrlimit(resource.RLIMIT_FSIZE, (texture + 64, limits[1]))  # textures fit, the stage does not
    try:
        assert bake(stage, "/world/looks/one", None, "--set", "/world/looks/one.baseColor=1,0,0") == 1
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)} == before


def test_a_disk_that_is_full_for_textures_names_the_texture(stage, tmp_path, capsys):
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (16, limits[1]))
    try:
        assert bake(stage, "/world/looks/one", str(tmp_path / "out.usda")) == 1
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    said = capsys.readouterr().err
    assert f"cannot write '{tmp_path / 'out_world_looks_one_base_color.png'}'" in said and len(said.splitlines()) == 1


def _of_materials(folder, paths, file="paint.png"):
    """:returns: a stage of such materials; the second one's texture is darker"""
    scopes = {}
    for i, path in enumerate(paths):
        scope, name = path.strip("/").split("/")
        scopes.setdefault(scope, []).append(usda.material(name, {
            "s": ("UsdPreviewSurface", {"color3f diffuseColor": "<t>"}), "t": ("UsdUVTexture", {"file": f"./{i}{file}"})},
            inside=f"/{scope}", surface="s"))
        _patina.write_image(str(folder / f"{i}{file}"), [[[0.5 - 0.2 * i, 0.2, 0.1], [0.1, 0.2, 0.5]]] * 2)
    (folder / "pair.usda").write_text(usda.stage(*(usda.prim("Scope", scope, *held) for scope, held in scopes.items()), up=""))
    return str(folder / "pair.usda")


def _textures(folder):
    return {name: (folder / name).read_bytes() for name in os.listdir(folder) if name.endswith("_base_color.png")}


@pytest.mark.parametrize("pair", [("/looks/a_b", "/looks_a/b"), ("/looks/é", "/looks/ü")])
@pytest.mark.parametrize("name", ["pair.usda", "new.usda"])
def test_materials_whose_textures_have_one_name_keep_theirs(pair, name, tmp_path):
    if not Sdf.Path.IsValidPathString(pair[0]):
        pytest.skip("this OpenUSD has ASCII names alone")
    stage, out = _of_materials(tmp_path, pair), str(tmp_path / name)
    assert bake(stage, pair[0], out) == 0
    first = _textures(tmp_path)
    assert len(first) == 1
    assert bake(stage, pair[1], out) == 0
    both = _textures(tmp_path)
    assert len(both) == 2 and len(set(both.values())) == 2 and both.items() >= first.items()
    assert bake(stage, pair[1], out) == 0 and _textures(tmp_path) == both, "it takes its own name once more"
    if name == "pair.usda":
        assert bake(stage, pair[0], out) == 0 and _textures(tmp_path).keys() == both.keys()


def test_a_texture_that_another_material_reads_is_not_replaced(stage, tmp_path, capsys):
    """By whatever name: the material was moved, and both names that the texture could have are taken."""
    assert bake(stage, "/world/looks/one") == 0
    plain = "stage_world_looks_one"
    layer = Sdf.Layer.FindOrOpen(stage)
    Sdf.CopySpec(layer, "/world/looks/one", layer, "/world/looks/moved")
    layer.Save()
    before = (tmp_path / f"{plain}_base_color.png").read_bytes()
    assert bake(stage, "/world/looks/one") == 0
    (second,) = set(_textures(tmp_path)) - {f"{plain}_base_color.png"}
    assert second.startswith(plain + "_") and len(second) == len(f"{plain}_12345678_base_color.png")
    layer.Reload(True)
    shader = layer.GetPrimAtPath("/world/looks/moved/base_color_texture")
    more = Sdf.AttributeSpec(shader, "inputs:more", Sdf.ValueTypeNames.AssetArray)
    more.default = Sdf.AssetPathArray([Sdf.AssetPath("./" + second)])
    layer.Save()
    assert bake(stage, "/world/looks/one") == 1
    assert f"{second}': /world/looks/moved of {stage} reads it" in capsys.readouterr().err
    assert (tmp_path / f"{plain}_base_color.png").read_bytes() == before


def test_a_texture_that_the_material_reads_from_elsewhere_is_not_replaced(stage, tmp_path, capsys):
    """OUT is another file, whose texture would have the name of what the material of the stage reads."""
    texture = tmp_path / "out_world_looks_one_base_color.png"
    (tmp_path / "paint.png").rename(texture)
    (tmp_path / "stage.usda").write_text(STAGE.replace("paint.png", texture.name))
    before = texture.read_bytes()
    (tmp_path / "out.usda").write_text("#usda 1.0\n")
    assert bake(stage, "/world/looks/one", str(tmp_path / "out.usda")) == 1
    assert "this command reads" in capsys.readouterr().err and texture.read_bytes() == before


def test_a_pipe_is_not_waited_for(stage, tmp_path, capsys):
    os.mkfifo(tmp_path / "out.usda")
    assert bake(stage, "/world/looks/one", str(tmp_path / "out.usda")) == 1
    assert "out.usda'" in capsys.readouterr().err
    assert sorted(os.listdir(tmp_path)) == ["below.usda", "out.usda", "paint.png", "stage.usda"]


def test_a_file_that_kills_its_reader_is_refused(stage, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(tryStage, "_READ",
                        "import os, sys\nif sys.argv[1].endswith('out.usda'):\n    os.kill(os.getpid(), 11)")
    out = tmp_path / "out.usda"
    out.write_text("#usda 1.0\n")
    assert bake(stage, "/world/looks/one", str(out), "--limit", "untriedBytes=0") == 1
    assert f"{out} makes OpenUSD fail (Segmentation fault): the file is damaged" in capsys.readouterr().err
    assert out.read_text() == "#usda 1.0\n"


def test_a_file_that_is_no_stage_is_told_in_one_line(stage, tmp_path, capsys):
    out = tmp_path / "out.usda"
    out.write_text("no stage")
    assert bake(stage, "/world/looks/one", str(out)) == 1
    said = capsys.readouterr().err
    assert f"{out} cannot be opened: " in said and len(said.splitlines()) == 1 and out.read_text() == "no stage"
