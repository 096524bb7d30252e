# SPDX-License-Identifier: Apache-2.0
"""Messages of `patina farm` before anything is sent; job templates stand for the sending."""
import json
import shutil

import pytest

import _patina
import movie
from inProcess import patina, scene
from patina.farm import jobFiles
from usda import prim


SETTINGS = prim("RenderSettings", "main", "int patina:samples = %d", "bool patina:denoise = 0")


def told(folder, *arguments):
    """:returns: the process that writes a job template"""
    return patina("farm", *arguments, "--write-job", folder / "job.json", check=False)


def test_negative_frames(tmp_path):
    stage = movie.write_stage(tmp_path)
    result = told(tmp_path, stage, tmp_path / "a.####.exr", "--frames", "-5:5")
    assert result.returncode == 0, result.stderr
    parameters = json.loads((tmp_path / "job.json").read_text())["parameterDefinitions"]
    assert next(one for one in parameters if one["name"] == "Frames")["default"] == "-5-5"


@pytest.mark.parametrize("flag", ["--verbose", "-v"])
def test_verbose_is_refused(tmp_path, flag):
    result = told(tmp_path, movie.write_stage(tmp_path), tmp_path / "a.exr", flag)
    assert result.returncode == 2 and "--verbose describes one render" in result.stderr


def test_settings_prims_are_heard(tmp_path):
    stage = tmp_path / "stage.usda"
    stage.write_text(movie.STAGE + SETTINGS % 256)
    result = told(tmp_path, stage, tmp_path / "a.exr", "--settings=/main", "--cut=1x16")
    assert result.returncode == 0, result.stderr
    stage = tmp_path / "few.usda"
    stage.write_text(movie.STAGE + SETTINGS % 8)
    result = told(tmp_path, stage, tmp_path / "a.exr", "--settings=/main", "--cut=1x16")
    assert result.returncode == 1 and "8 samples can be cut into 4 ranges" in result.stderr
    stage = tmp_path / "limit.usda"
    stage.write_text(movie.STAGE + SETTINGS.replace("bool patina:denoise = 0", "double patina:seconds = 3") % 8)
    for command in ((lambda: told(tmp_path, stage, tmp_path / "a.exr", "--settings=/main", "--cut=2")),
                    (lambda: patina("record", stage, tmp_path / "a.exr", "--settings=/main", "--part=1/2",
                                    f"--partial={tmp_path / 'p'}", check=False))):
        result = command()
        assert result.returncode == 2 and "--part with --seconds" in result.stderr


def textured(folder):
    """:returns: a stage with a texture of its own, whose name has a bracket, and the texture"""
    texture = folder / "wall[a].png"
    shutil.copy(scene("texturedDiffuse").rpartition("/")[0] + "/textures/" + "checker.png", texture)
    stage = folder / "walls.usda"
    stage.write_text(movie.STAGE + prim("Scope", "looks",
        prim("Shader", "image", 'uniform token info:id = "UsdUVTexture"', "asset inputs:file = @./wall[a].png@")))
    return stage, texture


def test_names_with_brackets_and_images_over_textures(tmp_path):
    stage, texture = textured(tmp_path)
    record = type("Record", (), {"stage": str(stage), "sessionLayer": None, "layer": []})
    assert str(texture) in jobFiles.of(_patina, record)[0]
    before = texture.read_bytes()
    result = told(tmp_path, stage, texture)
    assert result.returncode == 1 and "this command reads" in result.stderr and texture.read_bytes() == before


DOCUMENT = '''<materialx version="1.38" fileprefix="maps/">
  <tiledimage name="map" type="color3"><input name="file" type="filename" value="%s"/></tiledimage>
  <standard_surface name="s" type="surfaceshader"><input name="base_color" type="color3" nodename="map"/></standard_surface>
  <surfacematerial name="m" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
</materialx>
'''


def with_document(folder):
    """:returns: a stage with a sphere whose material is of a document, and the document's texture"""
    (folder / "maps").mkdir()
    texture = folder / "maps" / "wall.png"
    shutil.copy(scene("texturedDiffuse").rpartition("/")[0] + "/textures/checker.png", texture)
    (folder / "wall.mtlx").write_text(DOCUMENT % "wall.png")
    stage = folder / "document.usda"
    bound = movie.STAGE.replace('def Sphere "ball"\n{', '''def "library" (references = @./wall.mtlx@</MaterialX>)
{
}
def Sphere "ball" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    rel material:binding = </library/Materials/m>''')
    stage.write_text(bound)
    return stage, texture


def test_files_of_layers_and_documents_count(tmp_path, monkeypatch):
    stage, texture = with_document(tmp_path)
    (tmp_path / "above").mkdir()
    layer, own = textured(tmp_path / "above")
    models = tmp_path / "models"
    models.mkdir()
    (models / "own.mtlx").write_text("<materialx version='1.38'/>")
    monkeypatch.setenv("PATINA_MODEL_PATH", str(models))
    record = type("Record", (), {"stage": str(stage), "sessionLayer": None, "layer": [str(layer)]})
    found, missing = jobFiles.of(_patina, record)
    wanted = {str(path) for path in (stage, texture, tmp_path / "wall.mtlx", layer, own, models / "own.mtlx")}
    assert wanted <= set(found) and not missing


def test_parts_know_the_textures_of_documents(tmp_path):
    stage, texture = with_document(tmp_path)
    files = [tmp_path / "1.part", tmp_path / "2.part"]
    for number, file in enumerate(files, 1):
        patina("record", stage, tmp_path / "a.exr", "-w", "48", "--samples", "1", f"--part={number}/2", f"--partial={file}",
               "-q")
        if number == 1:
            texture.write_bytes(texture.read_bytes() + b"more")
    result = patina("merge", *files, tmp_path / "a.exr", check=False)
    assert result.returncode == 1 and "maps/wall.png is another" in result.stderr


def test_what_is_not_there_is_told_in_one_line(tmp_path):
    stage, _ = with_document(tmp_path)
    (tmp_path / "wall.mtlx").write_text(DOCUMENT % "none.png")
    with open(stage, "a", encoding="utf-8") as file:
        file.write('def Scope "more"\n{\n    asset map = @./gone.png@\n}\n')
    result = told(tmp_path, stage, tmp_path / "a.exr")
    assert result.returncode == 0 and result.stderr.count("\n") == 1
    assert "which is not there, and 1 more such files" in result.stderr
    assert told(tmp_path, stage, tmp_path / "a.exr", "--quiet").stderr == ""


def test_limits_hold_for_the_sender_too(tmp_path, monkeypatch):
    from patina import limits
    from patina.cli import errors, main, openStage

    held = []

    def opened(*_):
        held.append(limits.value("untriedBytes"))
        raise errors.CommandError("seen")

    monkeypatch.setattr(openStage, "open_stage", opened)
    before = limits.value("untriedBytes")
    assert main.main(["farm", "a.usda", str(tmp_path / "a.####.exr"), "--frames", "1:2", "--limit", "untriedBytes=0"]) == 1
    assert held == [0] and before != 0 and limits.value("untriedBytes") == before
