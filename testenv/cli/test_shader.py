# SPDX-License-Identifier: Apache-2.0
"""`patina shader`: its own text compiles, documents read back as the same material, MaterialX's generators take them."""
import json
import os
import shutil
import subprocess
import xml.etree.ElementTree as tree

import numpy as np
import pytest

import _patina
import mtlx
import inProcess
from patina.cli import materials
from patina.shader import document, generators

VALIDATOR = shutil.which("glslangValidator") or shutil.which("glslang")
STAGES = ("shaderball", "roughGlass", "instanceValues")
# Directions above the surface, and wide of the normal.
WO = np.array([[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.3, -0.9, 0.3162278]], np.float32)
WI = np.array([[0.1, 0.2, 0.9746794], [-0.6, 0.1, 0.7937254], [-0.2, 0.8, 0.5656854]], np.float32)
HOSTILE = mtlx.document({"i": ("image color3", {"filename file": r"a&quot;); evil(&quot;\b.png"})},
                        mtlx.shader("m", inputs={"base_color": "<i>"}))
# A colour space that ends the string literal that it comes to stand in, and a name that no document can hold as it is.
SPACE = "colorspace='x&quot;}, int evil = 1, string z = &quot;&#10;#include &quot;/etc/passwd&quot;&#10;'"
HOSTILE_SPACE = HOSTILE.replace('type="filename"', f'type="filename" {SPACE}')
HOSTILE_NAME = HOSTILE.replace('</image>', '<input name="a&#1;b" type="float" value="1"/></image>')
INPUT = '<materialx><image name="i"><input name="{}" type="string" value="{}" {}/></image></materialx>'


def _materials():
    return [(name, network) for stage in STAGES for name, network in materials.load(inProcess.scene(stage), every=True)[0]]


@pytest.mark.parametrize("target, extension", [("glsl", "frag"), ("essl", "frag")])
def test_own_text_compiles(target, extension, tmp_path):
    if VALIDATOR is None:
        pytest.skip("there is no glslangValidator")
    shader = tmp_path / f"m.{extension}"
    for name, _ in _materials()[:6]:
        stage = next(s for s in STAGES if any(n == name for n, _ in materials.load(inProcess.scene(s), every=True)[0]))
        inProcess.patina("shader", f"{inProcess.scene(stage)}:{name}", "--target", target, "--output", shader)
        said = subprocess.run([VALIDATOR, str(shader)], capture_output=True, text=True)
        assert said.returncode == 0, said.stdout
        text = shader.read_text()
        assert "materialSample(" in text and "materialEval(" in text and "#include" not in text


def test_documents_read_back_as_the_same_material(tmp_path):
    file = tmp_path / "m.mtlx"
    compared = 0
    for name, network in _materials():
        warnings = []
        file.write_text(document.document(_patina.expand_material(network)[0], "m", warnings))
        found = []
        (back,) = _patina.read_mtlx(str(file), found)
        assert not found, (name, found)
        if warnings:
            continue  # a plain layer stands for a coat
        first, second = (_patina.MaterialProbe(n) for n in (network, back))
        if first.stochastic:
            continue
        compared += 1
        for a, b in zip(first.eval(WO, WI), second.eval(WO, WI)):
            # Numbers are written so that they read back as the same floats; sums may be taken in another order.
            np.testing.assert_allclose(b, a, rtol=1e-5, atol=1e-6, err_msg=name)
        np.testing.assert_allclose(second.albedo(WO), first.albedo(WO), rtol=1e-5, atol=1e-6, err_msg=name)
    assert compared >= 8


def test_authored_nodes_are_kept(tmp_path):
    file = tmp_path / "m.mtlx"
    stage = inProcess.scene("instanceValues") + ":/World/materials/painted"
    inProcess.patina("shader", stage, "--target", "mtlx", "--form", "authored", "--output", file)
    text = file.read_text()
    assert "<UsdPreviewSurface " in text and "generalized_schlick" not in text
    assert 'name="painted"' in text


@pytest.mark.parametrize("target", ["osl", "mdl", "msl"])
def test_generators_of_materialx(target, tmp_path):
    if not generators.installed():
        pytest.skip("PyPI's materialx is not installed")
    out = tmp_path / "shader"
    inProcess.patina("shader", inProcess.scene("instanceValues") + ":/World/materials/painted", "--target", target,
                     "--output", out)
    text = out.read_text()
    assert {"osl": "shader ", "mdl": "export material", "msl": "fragment "}[target] in text
    assert text.count("{") == text.count("}")


def test_documents_are_valid_materialx():
    if not generators.installed():
        pytest.skip("PyPI's materialx is not installed")
    for name, network in _materials():
        assert generators.problems(document.document(_patina.expand_material(network)[0], "m")) == [], name


def test_texts_of_a_material_do_not_reach_code(tmp_path):
    file = tmp_path / "hostile.mtlx"
    file.write_text(HOSTILE)
    for target in ("glsl", "essl"):
        assert "evil" not in inProcess.patina("shader", file, "--target", target).stdout
    told = inProcess.patina("shader", file, "--target", "mtlx")
    assert "a&quot;); evil(&quot;" in told.stdout  # whole, as a value of the document
    if generators.installed():
        text = inProcess.patina("shader", file, "--target", "osl").stdout
        assert '_); evil(__b.png"' in text and 'evil("' not in text


def test_colour_spaces_of_a_material_do_not_reach_code(tmp_path):
    if not generators.installed():
        pytest.skip("PyPI's materialx is not installed")
    file = tmp_path / "hostile.mtlx"
    file.write_text(HOSTILE_SPACE)
    for target in ("osl", "mdl", "msl"):
        told = inProcess.patina("shader", file, "--target", target)
        assert "int evil" not in told.stdout and "/etc/passwd" not in told.stdout
        assert ".file: the colour space has characters that no such name has; it is left out" in told.stderr


@pytest.mark.parametrize("name, value, more, gone, said", [
    ("file", "a.png", SPACE, "evil", "the colour space has"),
    ("file", "a.png", "colorspace='x&#10;y'", "colorspace", "the colour space has"),
    ("geomprop", "x; } evil() {", "", "evil()", "the primvar's name has more than"),
    ("a&quot;b", "1", "", "&quot;", "a text has quotes"),
    ("file", "a.png", "nodename='b&#10;c'", "b&#10;c", "a text has quotes")])
def test_every_text_of_a_document_is_made_harmless(name, value, more, gone, said):
    warnings = []
    assert gone not in generators.harmless(INPUT.format(name, value, more), warnings)
    (warning,) = warnings
    assert warning["prim"] == "i" and warning["message"].startswith(said) and '"' not in warning["input"]


@pytest.mark.parametrize("name, more", [
    ("file", ""), ("file", "colorspace='srgb_texture'"), ("file", "colorspace='Utility - Linear (v1.0) Rec.709/a:b+c'"),
    ("geomprop", "")])
def test_harmless_texts_stay(name, more):
    warnings = []
    text = INPUT.format(name, "primvars:st", more)
    made = generators.harmless(text, warnings)
    assert not warnings and "primvars:st" in made and ("colorspace" in made) == bool(more)


def test_names_with_control_characters_give_a_document_that_can_be_read(tmp_path):
    file = tmp_path / "hostile.mtlx"
    file.write_text(HOSTILE_NAME)
    told = inProcess.patina("shader", file, "--target", "mtlx", "--form", "authored")
    assert [e.get("name") for e in tree.fromstring(told.stdout).iter("input")].count("a?b") == 1


def test_json_says_what_the_text_reads(tmp_path):
    table = tmp_path / "table.exr"
    told = inProcess.patina("shader", inProcess.scene("texturedDiffuse") + ":checker", "--target", "essl", "--json",
                            "--albedoTable", table)
    report = json.loads(told.stdout)
    assert report["text"].startswith("#version 300 es\n")
    assert len(report["textures"]) == 1 and os.path.isfile(report["textures"][0]["file"])
    values = np.array(_patina.read_image(str(table)).pixels).reshape(-1)
    expected = np.asarray(_patina.albedo_table())
    np.testing.assert_allclose(values[:expected.size], expected, atol=1e-3)  # half floats


@pytest.mark.parametrize("arguments, part", [
    (("--target", "osl", "--method", "diffuse=lambert"), "methods of their own"),
    (("--target", "glsl", "--form", "authored"), "--form authored is for mtlx"),
    (("--target", "glsl", "--stage", "vertex"), "glsl has one stage"),
    (("--target", "basic",), "invalid choice"),
    (("--target", "glsl", "--largestTexture", "0"), "1 to 16384"),
])
def test_wrong_usage(arguments, part):
    told = inProcess.patina("shader", inProcess.scene("texturedDiffuse"), *arguments, check=False)
    assert told.returncode == 2 and part in told.stderr and told.stderr.count("\n") == 1


def test_the_document_that_is_read_is_not_replaced(tmp_path):
    file = tmp_path / "m.mtlx"
    file.write_text(HOSTILE)
    told = inProcess.patina("shader", file, "--target", "mtlx", "--output", file, check=False)
    assert told.returncode == 1 and "this command reads" in told.stderr
    assert file.read_text() == HOSTILE
