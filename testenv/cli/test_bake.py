# SPDX-License-Identifier: Apache-2.0
"""`patina bake`: what is written says the same as the material translated on the fly."""
import os

import numpy as np
import pytest

import _patina
import inProcess
import mtlx
from patina.cli import bake, bakeOutput, main, materials
import usda

RAMP = {
    "uv": ("texcoord vector2", {}),
    "paint": ("ramp4 color3", {"valuetl": (0.9, 0.2, 0.1), "valuetr": (0.02, 0.3, 0.8), "valuebl": (0.5, 0.5, 0.0)})}
PATTERNS = mtlx.document(RAMP, {
    "large": ("place2d vector2", {"texcoord": "<uv>", "scale": (0.25, 0.25)}),
    "worn": ("noise2d float", {"amplitude": 0.3, "pivot": 0.5, "texcoord": "<large>"}),
    "bumps": ("bump vector3", {"height": "<worn>"}),
    **mtlx.shader("patterns", inputs={
        "base_color": "<paint>", "specular_roughness": "<worn>", "metalness": 0.25, "coat": 0.5, "emission": 3,
        "emission_color": "<paint>", "normal": "<bumps>"})})


@pytest.fixture
def document(tmp_path):
    path = tmp_path / "patterns.mtlx"
    path.write_text(PATTERNS)
    return str(path)


def _inputs(file, target, size=64):
    """Inputs of a file's material in the words of the target, at the centres of texels."""
    warnings = []
    (_, network), = materials.load(file)[0]
    return bake.evaluate(_patina.translate_material(network, target, warnings), target, size, warnings), warnings


@pytest.mark.parametrize("target", bake.TARGETS)
@pytest.mark.parametrize("kind", ["png", "exr"])
def test_textures_hold_what_the_translation_gives(document, tmp_path, target, kind, capsys):
    out = str(tmp_path / f"{target}.usda")
    assert main.main(["bake", document, out, "--to", target, "--resolution", "64", "--format", kind]) == 0
    direct, _ = _inputs(document, target)
    baked, warnings = _inputs(out, target)
    assert not warnings
    assert set(baked) == set(direct)
    varying = 0
    for name, (_, value) in direct.items():
        read = baked[name][1]
        if np.ndim(value) < 3:
            np.testing.assert_allclose(read, value, atol=1e-5, err_msg=name)
            continue
        varying += 1
        # PNG: half a step of 8 bits, which sRGB stretches most at white (slope 2.3); emission beyond 1
        # is cut off. EXR: 11 bits of half float, twice for normals.
        limit = 2.4 * 0.5 / 255 if kind == "png" else 1e-3
        expected = np.minimum(value, 1.0) if kind == "png" else value
        assert np.abs(read - expected).max() <= limit * max(1.0, np.abs(expected).max()), name
    assert varying >= 3
    assert ("cut off" in capsys.readouterr().err) == (kind == "png" and target == "UsdPreviewSurface")


def test_constant_inputs_stay_values(tmp_path):
    document = tmp_path / "plain.mtlx"
    document.write_text(mtlx.document({"s": ("standard_surface", {"base": 0.5, "metalness": 1})}))
    out = tmp_path / "plain.usda"
    assert main.main(["bake", str(document), str(out), "--to", "UsdPreviewSurface"]) == 0
    assert sorted(os.listdir(tmp_path)) == ["plain.mtlx", "plain.usda"]
    text = out.read_text()
    assert "inputs:metallic = 1" in text and "inputs:diffuseColor = (0.4, 0.4, 0.4)" in text


def test_renders_like_the_translation(document, tmp_path):
    """Both pictures use the same random numbers; what differs is the 8 bits of the textures and their filter."""
    out = str(tmp_path / "baked.usda")
    assert main.main(["bake", document, out, "--to", "gltf_pbr", "--resolution", "256", "--set", "/s.emission=0"]) == 0
    direct = _direct_network(document, tmp_path)
    images = [_render(tmp_path, name, file) for name, file in (("baked", out), ("direct", direct))]
    assert images[0].mean() > 0.02
    assert np.abs(images[0] - images[1]).mean() <= 0.02 * images[1].mean()


def _direct_network(document, tmp_path):
    """The translated network itself, as a stage of the same nodes."""
    from pxr import Sdf, Usd, UsdShade

    (_, network), = materials.load(document, ["/s.emission=0"])[0]
    translated = _patina.translate_material(network, "gltf_pbr", [])
    stage = Usd.Stage.CreateNew(str(tmp_path / "direct.usda"))
    material = UsdShade.Material.Define(stage, "/patterns")
    stage.SetDefaultPrim(material.GetPrim())
    names = {node["path"]: node["path"].strip("/").replace("/", "_") for node in translated.nodes()}
    shaders = {path: UsdShade.Shader.Define(stage, "/patterns/" + name) for path, name in names.items()}
    for node in translated.nodes():
        shader = shaders[node["path"]]
        shader.CreateIdAttr(node["id"])
        for name, value in node["inputs"].items():
            if value["type"] in ("float", "color3", "vector2", "vector3"):
                number = value["value"]
                shader.CreateInput(name, bakeOutput._sdf(value["type"])).Set(
                    number if isinstance(number, float) else tuple(number))
        for name, (source, output) in node["connections"].items():
            token = Sdf.ValueTypeNames.Token
            shaders[source].CreateOutput(output or "out", token)
            shader.CreateInput(name, token).ConnectToSource(shaders[source].ConnectableAPI(), output or "out")
    surface = translated.terminals()["surface"][0]
    shaders[surface].CreateOutput("out", Sdf.ValueTypeNames.Token)
    material.CreateSurfaceOutput("mtlx").ConnectToSource(shaders[surface].ConnectableAPI(), "out")
    stage.GetRootLayer().Save()
    return str(tmp_path / "direct.usda")


def _render(tmp_path, name, material):
    stage = tmp_path / f"scene_{name}.usda"
    stage.write_text(usda.stage(
        usda.camera(lens=(50, 20, 20), at=(0, 0, 5)),
        usda.prim("DomeLight", "sky", intensity=0.3),
        usda.mesh("quad", [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], bind="material", st=usda.ST),
        usda.prim("", "material", meta=(f"prepend references = @{material}@",)),
        up=""))
    image = tmp_path / f"{name}.exr"
    assert main.main(["record", str(stage), str(image), "--quiet", "--camera", "/camera", "--imageWidth", "48",
                      "--imageHeight", "48", "--samples", "16"]) == 0
    return inProcess.pixels(image)


RING = usda.stage(
    usda.prim("Material", "M", "token outputs:mtlx:surface.connect = </M/S.outputs:out>",
        usda.prim("Shader", "S", 'uniform token info:id = "ND_standard_surface_surfaceshader"',
                  "token inputs:surfaceshader.connect = </M/%s.outputs:out>", "token outputs:out"),
        usda.prim("Shader", "T", 'uniform token info:id = "ND_standard_surface_surfaceshader"',
                  "token inputs:surfaceshader.connect = </M/S.outputs:out>", "token outputs:out")),
    up="")


@pytest.mark.parametrize("source", ["S", "T"])
def test_a_surface_that_leads_back_to_itself_ends(tmp_path, source, capsys):
    stage = tmp_path / "ring.usda"
    stage.write_text(RING % source)
    assert main.main(["bake", str(stage), str(tmp_path / "out.usda"), "--to", "standard_surface"]) == 1
    assert "/M: more than 8 connections of surfaceshader follow each other" in capsys.readouterr().err
    assert not (tmp_path / "out.usda").exists()


@pytest.mark.parametrize("arguments, status", [
    (["--to", "nothing"], 2), (["--to", "gltf_pbr", "--resolution", "0"], 2), ([], 2)])
def test_wrong_usage(document, tmp_path, arguments, status, capsys):
    assert main.main(["bake", document, str(tmp_path / "out.usda"), *arguments]) == status
    assert capsys.readouterr().err


def test_what_cannot_be_baked(tmp_path, capsys):
    document = tmp_path / "bare.mtlx"
    document.write_text(mtlx.document({"s": ("surface", {})}))
    assert main.main(["bake", str(document), str(tmp_path / "out.usda"), "--to", "gltf_pbr"]) == 1
    assert "no shading model" in capsys.readouterr().err
    assert not (tmp_path / "out.usda").exists()


@pytest.mark.parametrize("inputs, mode, share", (
    ({"opacity": (0.25, 0.25, 0.25)}, "presence", 0.25), ({"opacity": "<paint>"}, "presence", None),
    ({"transmission": 0.5}, "", 1.0), ({}, "", 1.0)))
def test_glow_fades_with_the_opacity_of_standard_surface(tmp_path, inputs, mode, share):
    document = tmp_path / "glow.mtlx"
    document.write_text(mtlx.document(RAMP, {"s": ("standard_surface", {"emission": 0.5, **inputs})}))
    out = tmp_path / "glow.usda"
    assert main.main(["bake", str(document), str(out), "--to", "UsdPreviewSurface", "--resolution", "16"]) == 0
    assert (f'token inputs:opacityMode = "{mode}"' in out.read_text()) == bool(mode)
    up = np.array([[0.0, 0.0, 1.0]], np.float32)
    shown = []
    for file in (document, out):
        (_, network), = materials.load(str(file))[0]
        probe = _patina.MaterialProbe(network)
        probe.move_to(0.53125, 0.53125)  # the centre of a texel
        shown.append(probe.emission(up)[0, 0] * (probe.opacity() if mode else 1.0))
    assert shown[1] == pytest.approx(shown[0], abs=0.5 * 0.5 / 255 + 1e-5)  # half a step of a texture of 8 bits
    assert share is None or shown[0] == pytest.approx(0.5 * share, rel=1e-5)
