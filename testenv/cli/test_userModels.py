# SPDX-License-Identifier: Apache-2.0
"""Shading models that a user adds as files."""
import os
import subprocess
import sys

import pytest

import mtlx
from usda import material, stage


MODEL = mtlx.document(
    mtlx.model("plaster", {"shade": 0.25}, {
        "color": ("convert color3", {"in": "<shade>"}),
        "d": ("oren_nayar_diffuse_bsdf", {"color": "<color>"}),
        "s": ("surface", {"bsdf": "<d>"})}, out="s"),
    mtlx.model("plaster_to_standard_surface", {"shade": 0.25}, {"color": ("convert color3", {"in": "<shade>"})},
               base_color_out="color"))
STAGE = stage(material("wall", {"p": ("ND_plaster", {"shade": 0.75})}, surface="p"), up="")


def wall(nodes=None, **inputs):
    return mtlx.document(nodes or {}, mtlx.shader("wall", "plaster surfaceshader", {"shade": 0.75, **inputs}, node="p"))


def product(factor):
    return {"m": ("multiply float", {"in1": 2, "in2": factor})}


def patina(*arguments, models):
    return subprocess.run([sys.executable, "-m", "patina", *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, "PATINA_MODEL_PATH": str(models)})


@pytest.fixture
def models(tmp_path):
    folder = tmp_path / "models"
    folder.mkdir()
    (folder / "plaster.mtlx").write_text(MODEL)
    return folder


GRAIN = '<input name="grain" type="float" value="0" patina-not-modelled="grain is not modelled; the input is ignored"/>'


@pytest.mark.parametrize("nodes, grain, warned", [
    ({}, 0.5, True), ({}, 0, False), (product(0.25), "<m>", True), (product(0), "<m>", False), ({}, "<p>", True),
], ids=("value", "default", "product", "zero", "circle"))
def test_an_input_that_a_model_does_not_serve_is_told_where_it_would_change_something(models, tmp_path, nodes, grain, warned):
    (models / "plaster.mtlx").write_text(MODEL.replace('node="plaster">', 'node="plaster">' + GRAIN))
    file = tmp_path / "wall.mtlx"
    file.write_text(wall(nodes, **{"float grain": grain}))
    process = patina("bsdf", "albedo", file, models=models)
    assert process.returncode == 0, process.stderr
    assert ("grain is not modelled; the input is ignored" in process.stderr) == warned, process.stderr


@pytest.mark.parametrize("name, text", [("wall.mtlx", wall()), ("wall.usda", STAGE)])
def test_a_model_is_a_file_in_a_folder(models, tmp_path, name, text):
    file = tmp_path / name
    file.write_text(text)
    process = patina("bsdf", "albedo", file, models=models)
    assert process.returncode == 0 and not process.stderr, process.stderr
    assert [float(x) for x in process.stdout.split()[1:]] == pytest.approx([0.75] * 3, abs=1e-5)
    baked = tmp_path / "baked.usda"
    assert patina("bake", file, baked, "--to", "UsdPreviewSurface", models=models).returncode == 0
    assert "inputs:diffuseColor = (0.75, 0.75, 0.75)" in baked.read_text()


def test_broken_models_are_named(models, tmp_path):
    (models / "broken.mtlx").write_text("<materialx>")
    file = tmp_path / "wall.mtlx"
    file.write_text(wall())
    process = patina("bsdf", "albedo", file, models=f"{models}:{tmp_path / 'nothing'}")
    assert process.returncode == 0
    assert "broken.mtlx" in process.stderr and "nothing" in process.stderr
