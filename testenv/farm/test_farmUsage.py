# SPDX-License-Identifier: Apache-2.0
"""What `patina farm` says before anything is sent; job templates stand for the sending."""
import json
import shutil

import pytest

import movie
from inProcess import patina, scene
from patina.cli import farm

SETTINGS = '''
def RenderSettings "main"
{
    int patina:samples = %d
    bool patina:denoise = 0
}
'''


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
    assert result.returncode == 2 and "--verbose is of one render" in result.stderr


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
    stage.write_text(movie.STAGE + '''
def Scope "looks"
{
    def Shader "image"
    {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @./wall[a].png@
    }
}
''')
    return stage, texture


def test_names_with_brackets_and_images_over_textures(tmp_path):
    stage, texture = textured(tmp_path)
    record = type("Record", (), {"stage": str(stage), "sessionLayer": None, "layer": []})
    assert str(texture) in farm._files(record)
    before = texture.read_bytes()
    result = told(tmp_path, stage, texture)
    assert result.returncode == 1 and "this command reads" in result.stderr and texture.read_bytes() == before
