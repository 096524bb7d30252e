# SPDX-License-Identifier: Apache-2.0
"""Shading models that a user adds as files."""
import os
import subprocess
import sys

import pytest

from usda import material, stage

pytest.importorskip("_patina")

MODEL = """<materialx version="1.39">
  <nodedef name="ND_plaster" node="plaster">
    <input name="shade" type="float" value="0.25"/>
    <output name="out" type="surfaceshader"/>
  </nodedef>
  <nodegraph name="NG_plaster" nodedef="ND_plaster">
    <convert name="color" type="color3"><input name="in" type="float" interfacename="shade"/></convert>
    <oren_nayar_diffuse_bsdf name="d" type="BSDF"><input name="color" type="color3" nodename="color"/>
    </oren_nayar_diffuse_bsdf>
    <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="d"/></surface>
    <output name="out" type="surfaceshader" nodename="s"/>
  </nodegraph>
  <nodedef name="ND_plaster_to_standard_surface" node="plaster_to_standard_surface">
    <input name="shade" type="float" value="0.25"/>
    <output name="base_color_out" type="color3"/>
  </nodedef>
  <nodegraph name="NG_plaster_to_standard_surface" nodedef="ND_plaster_to_standard_surface">
    <convert name="color" type="color3"><input name="in" type="float" interfacename="shade"/></convert>
    <output name="base_color_out" type="color3" nodename="color"/>
  </nodegraph>
</materialx>"""
WALL = """<materialx version="1.39">
  <plaster name="p" type="surfaceshader"><input name="shade" type="float" value="0.75"/></plaster>
  <surfacematerial name="wall" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="p"/></surfacematerial>
</materialx>"""
STAGE = stage(material("wall", {"p": ("ND_plaster", {"shade": 0.75})}, surface="p"), up="")


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
PRODUCT = """<multiply name="m" type="float"><input name="in1" type="float" value="2"/>
  <input name="in2" type="float" value="%g"/></multiply>"""


@pytest.mark.parametrize("node, source, warned", [
    ("", 'value="0.5"', True), ("", 'value="0"', False),
    (PRODUCT % 0.25, 'nodename="m"', True), (PRODUCT % 0.0, 'nodename="m"', False), ("", 'nodename="p"', True),
], ids=("value", "default", "product", "zero", "circle"))
def test_an_input_that_a_model_does_not_serve_is_told_where_it_would_change_something(models, tmp_path, node, source, warned):
    (models / "plaster.mtlx").write_text(MODEL.replace("<nodedef name=\"ND_plaster\" node=\"plaster\">",
                                                       "<nodedef name=\"ND_plaster\" node=\"plaster\">" + GRAIN))
    file = tmp_path / "wall.mtlx"
    shade = '<input name="shade" type="float" value="0.75"/>'
    file.write_text(WALL.replace(shade, f'{shade}<input name="grain" type="float" {source}/>').replace(
        '"1.39">', f'"1.39">{node}', 1))
    process = patina("bsdf", "albedo", file, models=models)
    assert process.returncode == 0, process.stderr
    assert ("grain is not modelled; the input is ignored" in process.stderr) == warned, process.stderr


@pytest.mark.parametrize("name, text", [("wall.mtlx", WALL), ("wall.usda", STAGE)])
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
    file.write_text(WALL)
    process = patina("bsdf", "albedo", file, models=f"{models}:{tmp_path / 'nothing'}")
    assert process.returncode == 0
    assert "broken.mtlx" in process.stderr and "nothing" in process.stderr
