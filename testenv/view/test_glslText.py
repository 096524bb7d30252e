# SPDX-License-Identifier: Apache-2.0
"""The texts of pages are GLSL ES 3.00 that a validator takes, for materials of every lobe and many patterns."""
import glob
import os
import re
import shutil
import subprocess

import pytest

from patina.cli import compiled, materials
from patina.view import glslText, live

ROOT = os.path.join(os.path.dirname(__file__), "..", "..")
FILES = sorted(glob.glob(os.path.join(ROOT, "testenv", "scenes", "**", "*.usda"), recursive=True)
               + glob.glob(os.path.join(ROOT, "plugin", "patina", "view", "demos", "*.usda")))
VALIDATOR = shutil.which("glslangValidator") or shutil.which("glslang")


def validated(text, stage, folder):
    """:returns: what the validator complains about"""
    file = folder / f"text.{stage}"
    file.write_text("#version 300 es\n" + text)
    done = subprocess.run([VALIDATOR, "-S", stage, str(file)], capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else done.stdout[:2000]


@pytest.fixture(scope="module")
def library():
    if not VALIDATOR:
        pytest.skip("there is no glslangValidator")
    return glslText.library()


def test_the_parts_of_a_page(library, tmp_path):
    assert not validated(library["surface"], "vert", tmp_path)
    assert not validated(library["backdropVertex"], "vert", tmp_path)
    assert not validated(library["backdrop"], "frag", tmp_path)


@pytest.mark.parametrize("file", FILES, ids=os.path.basename)
def test_materials_of_scenes(library, file, tmp_path):
    module = compiled.load()
    texts = {}
    try:
        found, _ = materials.load(file, every=True)
    except materials.CommandError:
        pytest.skip("it has no materials")
    for name, network in found:
        inputs, _ = live.live_inputs(network)
        for chosen in ([], range(len(inputs))):
            made = module.web_material(live.with_live(network, inputs, chosen), {}, 1)
            flags = "#define PRESENCE\n" if made["presence"] else ""
            texts[flags + library["head"] + glslText.material_text(made, len(inputs)) + library["page"]] = name
            assert "parameters[" not in made["text"] and "layout(" not in made["text"]
    assert texts
    for text, name in list(texts.items())[:12]:
        assert not validated(text, "frag", tmp_path), name


def test_numbers_that_are_none_become_literals():
    module = compiled.load()
    network = module.Network("/m")
    network.add_node("/m/b", "ND_oren_nayar_diffuse_bsdf")
    network.set_input("/m/b", "color", "color3", [float("inf"), float("nan"), -1e38])
    network.add_node("/m/s", "ND_surface")
    network.connect("/m/s", "bsdf", "/m/b", "out")
    network.set_terminal("surface", "/m/s", "out")
    made = module.web_material(network)
    text = made["text"]
    assert [warning["input"] for warning in made["warnings"]] == ["color"]
    assert not re.search(r"\b(inf|nan)\b", text) and "vec4(" in text
