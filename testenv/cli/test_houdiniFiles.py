# SPDX-License-Identifier: Apache-2.0
"""What Houdini reads beside the plugin has the settings, in the form of its dialogue scripts."""
import json
import os
import re

import pytest

from patina.cli import hostSettings, houdiniFiles, rows

TEXTS = houdiniFiles.texts()


def test_files_are_written(tmp_path):
    houdiniFiles.main(tmp_path / "made")
    assert {str(path.relative_to(tmp_path / "made")): path.read_text("utf-8")
            for path in (tmp_path / "made").rglob("*.*")} == TEXTS


def test_renderers_are_those_of_the_plugin():
    with open(os.path.join(rows.ROOT, "plugin", "hydra", "plugInfo.json.in"), encoding="utf-8") as file:
        types = json.loads(re.sub("@[A-Z_]+@", "", file.read()))["Plugins"][0]["Info"]["Types"]
    known = {name: words["displayName"] for name, words in types.items() if words["bases"] == ["HdRendererPlugin"]}
    assert {name: words["menulabel"] for name, words in json.loads(TEXTS["UsdRenderers.json"]).items()} == known


WORD = re.compile(r'\s*(?:(?P<text>"(?:[^"\\]|\\.)*")|(?P<open>\{)|(?P<close>\})|(?P<word>[^\s{}"]+))')


def parsed(text):
    """:returns: nested lists of a dialogue script's words"""
    stack, at = [[]], 0
    for match in iter(lambda: WORD.match(text, at), None):
        at = match.end()
        if match["open"]:
            stack.append([])
        elif match["close"]:
            inner = stack.pop()
            stack[-1].append(inner)
        else:
            stack[-1].append(json.loads(match["text"]) if match["text"] else match["word"])
    assert len(stack) == 1 and not text[at:].strip()
    return stack[0]


def test_names_of_attributes_are_encoded_as_houdini_does():
    """Names that Solaris gives parameters of UsdLux's inputs."""
    assert houdiniFiles.encoded("inputs:intensity") == "xn__inputsintensity_i0a"
    assert houdiniFiles.encoded("inputs:color") == "xn__inputscolor_zta"


@pytest.mark.parametrize("name", [name for name in TEXTS if name.endswith(".ds")])
def test_dialogue_scripts_have_a_parameter_for_each_setting(name):
    (words,) = parsed(TEXTS[name])
    assert words[:2] == ["name", os.path.basename(name)[:-3]]
    parameters = [dict(zip(inner[::2], inner[1::2])) for key, inner in zip(words[::2], words[1::2]) if key == "parm"]
    shown = {s["key"]: s for s in hostSettings.shown() if s["key"] not in ("viewportBackend", "albedoPass")}
    if name.endswith("_Global.ds"):
        settings = {houdiniFiles.encoded("patina:" + key): s for key, s in shown.items()}
        controls = [p for p in parameters if p["name"].endswith("_control")]
        parameters = [p for p in parameters if p not in controls]
        assert [p["name"] + "_control" for p in parameters] == [p["name"] for p in controls]
        for p, control in zip(parameters, controls):
            assert control["menujoin"][::2] == ["set", "setexisting", "block", "none"] and control["default"] == ["none"]
            assert p["parmtag"] == ["usdvaluetype", settings[p["name"]]["type"]] and control["name"] in p["disablewhen"]
    else:
        settings = shown
    assert {p["name"] for p in parameters} == set(settings)
    for p in parameters:
        assert p["type"] in ("toggle", "integer", "float", "string") and p["label"]
        assert len(p["default"]) == 1
        if p["type"] in ("integer", "float"):
            float(p["default"][0])
        if settings[p["name"]]["choices"]:
            assert p["menu"][::2] == p["menu"][1::2] == settings[p["name"]]["choices"] and p["default"][0] in p["menu"]
