# SPDX-License-Identifier: Apache-2.0
"""Text of a document that reaches a page, and the layer that the page saves: it stays text."""
import base64
import gzip
import json
import os
import re
import shutil
import subprocess

import pytest
from pxr import Sdf

import _patina
import mtlx
from patina.cli import main
from patina.view import bundle, layers, live, page

LAYER_SCRIPT = os.path.join(os.path.dirname(bundle.__file__), "web", "src", "layer.js")
EVIL = 'out>\n    }\n}\ndef "evil" (references = @/etc/passwd@) {}\ndef "rest" { token a = "'


def save(layer, material, tmp_path):
    """The file that the page saves: layer.js with the page's own state.

    :returns: the layer, as pxr reads it"""
    if not shutil.which("node"):
        pytest.skip("there is no Node")
    state = {"current": {**material, "layer": layer}, "material": 0, "values": [[i["value"] for i in material["inputs"]]],
             "choices": [[c["at"] for c in material["choices"]]]}
    script = tmp_path / "layer.mjs"
    shutil.copy(LAYER_SCRIPT, script)
    program = (f'import {{ layerText }} from "{script}"; '
               'let text = ""; for await (const part of process.stdin) text += part; '
               "process.stdout.write(layerText(JSON.parse(text))); "
               'if (Object.keys(Object.prototype).length) process.exit(3);')
    done = subprocess.run(["node", "--input-type=module", "-e", program], input=json.dumps(state), capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stderr
    made = Sdf.Layer.CreateAnonymous("saved.usda")
    assert made.ImportFromString(done.stdout), done.stdout
    return made


def document(names=("m",), inputs=None):
    """Materials of one surface."""
    return mtlx.document(*(mtlx.shader(name, inputs=inputs) for name in names))


def of_page(tmp_path, monkeypatch, names=("m",), inputs=None):
    """:returns: the materials of a page as the page has them, each with its layer"""
    monkeypatch.setattr(bundle, "script", lambda: "")
    (tmp_path / "m.mtlx").write_text(document(names, inputs))
    out = tmp_path / "m.html"
    assert main.main(["view", str(tmp_path / "m.mtlx"), "-o", str(out)]) == 0
    text = out.read_text()
    data = json.loads(re.search(r'id="patina-data"[^>]*>(.*?)</script>', text, re.DOTALL)[1],
                      parse_constant=lambda word: pytest.fail(f"{word} is no JSON"))
    texts = json.loads(gzip.decompress(base64.b64decode(data["texts"])))
    return list(zip(data["materials"], texts["layers"]))


def test_materials_of_any_name_are_saved(tmp_path, monkeypatch):
    names = ["__proto__", "constructor", "1 with blanks", "\u00dcberzug"]
    found = of_page(tmp_path, monkeypatch, names, inputs={"base": 0.5})
    assert len(found) == len(names)
    for material, layer in found:
        made = save(layer, material, tmp_path)
        (root,) = made.rootPrims
        assert root.typeName == "Material" and made.defaultPrim == root.name
        assert [child.typeName for child in root.nameChildren] == ["Shader"]
        assert root.nameChildren["n0"].attributes["inputs:base"].default == 0.5


class _Network:
    """A network whose every name holds a line break and more."""

    def nodes(self):
        value = {"type": "float", "value": 0.5, "color_space": ""}
        return [{"path": "/" + EVIL, "id": EVIL, "inputs": {EVIL: value, "good": value,
                                                            "text": {"type": "string", "value": EVIL}},
                 "connections": {EVIL: ("/" + EVIL, EVIL), "in": ("/" + EVIL, EVIL)}},
                {"path": "/b", "id": "ND_b", "inputs": {}, "connections": {"in": ("/" + EVIL, EVIL)}}]

    def terminals(self):
        return {"surface": ("/" + EVIL, EVIL)}


def test_names_with_line_breaks_add_nothing(tmp_path):
    layer = layers.whole_material(EVIL, _Network(), [], str(tmp_path))
    assert not [line for prim in layer["prims"] for line in prim["lines"] if "\n" in line]
    made = save(layer, {"inputs": [], "choices": []}, tmp_path)
    (root,) = made.rootPrims
    assert not made.GetPrimAtPath("/evil") and not made.GetCompositionAssetDependencies()
    assert sorted(child.name for child in root.nameChildren) == ["n0", "n1"]
    assert root.nameChildren["n0"].attributes["inputs:good"].default == 0.5
    assert root.nameChildren["n0"].attributes["inputs:text"].default == EVIL.replace("\n", " ")


def test_a_document_cannot_add_prims(tmp_path):
    evil = EVIL.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;").replace("\n", "&#10;")
    text = document().replace('nodename="s"', f'nodename="s" output="{evil}"')
    (tmp_path / "evil.mtlx").write_text(text)
    networks = _patina.read_mtlx(str(tmp_path / "evil.mtlx"), [])
    layer = layers.whole_material("m", networks[0], [], str(tmp_path))
    assert not [line for prim in layer["prims"] for line in prim["lines"] if "\n" in line or "evil" in line]


@pytest.mark.parametrize("value", ["nan", "-inf", "1e999", "words", "0.5, nan, words"])
def test_values_that_are_no_numbers(value, tmp_path, monkeypatch):
    kinds = (("float", "base"), ("color3", "base_color"), ("boolean", "thin_walled"), ("vector3", "normal"),
             ("float", "metalness"))
    inputs = {f"{kind} {name}": value for kind, name in kinds}
    ((material, layer),) = of_page(tmp_path, monkeypatch, inputs=inputs)
    assert all(isinstance(x, (int, float)) for i in material["inputs"] for x in i["value"])
    made = save(layer, material, tmp_path)
    for attribute in made.GetPrimAtPath("/m/n0").attributes:
        assert not any(word in str(attribute.default).lower() for word in ("nan", "inf", "words")), attribute.name


@pytest.mark.parametrize("kind", ["integer", "float", "color3", "boolean", "matrix44", "string", "filename"])
@pytest.mark.parametrize("value", [float("nan"), [float("inf")] * 3, "words", ["a", "b", "c"], [], "", [0.5, "x"]])
def test_what_is_written_of_any_value_can_be_read(value, kind):
    if kind in ("string", "filename") and not isinstance(value, str):
        value = str(value)
    text = layers._value(kind, value, "/")
    line = f"{layers.TYPES[kind]} inputs:x = {text}" if text else ""
    assert "\n" not in text
    assert Sdf.Layer.CreateAnonymous(".usda").ImportFromString(f'#usda 1.0\ndef "a"\n{{\n    {line}\n}}\n'), text


def test_numbers_of_live_inputs():
    assert live._numbers(0.1) == [0.1] and live._numbers((1, 2)) == [1.0, 2.0]
    for value in (float("nan"), [1.0, float("inf")], "words", ["a"], None, [None], 1e39 * 1e300):
        assert live._numbers(value) == []


def test_numbers_of_a_page_are_finite():
    data, count = page.finite({"a": [1.0, float("nan"), {"b": (float("inf"), "nan", 2)}], "c": -float("inf"), "d": None})
    assert data == {"a": [1.0, 0.0, {"b": [0.0, "nan", 2]}], "c": 0.0, "d": None} and count == 3
    json.loads(page.as_json(data))
