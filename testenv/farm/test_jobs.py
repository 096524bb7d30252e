# SPDX-License-Identifier: Apache-2.0
"""Open Job Descriptions, checked and run by its own command line."""
import json
import os
import subprocess
import sys

import pytest

import movie
from inProcess import patina
from patina.farm import identity, jobs

FLAGS = ["--imageWidth=40", "--samples=4"]


def openjd(*arguments):
    pytest.importorskip("openjd.cli", reason="openjd-cli is not installed")
    return subprocess.run([sys.executable, "-m", "openjd", *map(str, arguments)], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=300)


@pytest.mark.parametrize("numbers, text", [([1, 2, 3, 4], "1-4"), ([7], "7"), ([3, 1, 2, 10], "1-3,10"),
                                           ([1, 3, 5, 7], "1-7:2"), ([1, 5], "1,5"), ([1, 2, 4, 8], "1-2,4,8")])
def test_ranges_of_frames(numbers, text):
    assert jobs._range(numbers) == text


@pytest.mark.parametrize("extension", ["yaml", "json"])
@pytest.mark.parametrize("flags", [["--frames=1:4", "--cut=2x2"], ["--frames=1:2x0.5"], ["--cut=3"], []])
def test_templates_are_valid(tmp_path, flags, extension):
    stage, job = movie.write_stage(tmp_path), tmp_path / f"job.{extension}"
    image = tmp_path / ("movie.###.##.exr" if any("frames" in flag for flag in flags) else "movie.exr")
    patina("farm", stage, image, *flags, *FLAGS, "--write-job", job)
    result = openjd("check", job)
    assert result.returncode == 0, result.stdout


def test_a_job_makes_the_bits_of_one_process(tmp_path):
    stage, job, out = movie.write_stage(tmp_path), tmp_path / "job.json", tmp_path / "out"
    out.mkdir()
    patina("farm", stage, out / "movie.####.exr", "--frames=2", "--cut=2", *FLAGS, "--write-job", job)
    # The launcher would build; what it hands over to is there.
    command = tmp_path / "patina"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m patina "$@"\n')
    command.chmod(0o755)
    value = json.loads(job.read_text())
    value["parameterDefinitions"][0]["default"] = str(command)
    job.write_text(json.dumps(value))
    result = openjd("run", job, "--step", "Merge", "--run-dependencies")
    assert result.returncode == 0, result.stdout[-3000:]
    names = movie.at_once(stage, str(tmp_path / "once"), "2", FLAGS)
    assert not movie.different(names, tmp_path / "once", out)
    assert os.path.isdir(str(out / "movie.####.exr.parts"))


def template(folder, *arguments, check=True):
    """:returns: the template, or what is said where there is none"""
    job = folder / "job.json"
    result = patina("farm", *arguments, "--write-job", job, check=check)
    return json.loads(job.read_text()) if result.returncode == 0 else result.stderr


def record_words(job):
    return job["steps"][0]["script"]["actions"]["onRun"]["args"]


def test_files_of_flags_are_absolute_and_their_values_stay(tmp_path, monkeypatch):
    movie.write_stage(tmp_path)
    for name in ("over.usda", "session.usda"):
        (tmp_path / name).write_text("#usda 1.0\n")
    monkeypatch.chdir(tmp_path)
    # The camera's value is also the image's name.
    words = record_words(template(tmp_path, "--camera", "a.exr", "--layer", "over.usda", "--sessionLayer=session.usda",
                                  "movie.usda", "a.exr", *FLAGS))
    assert words[words.index("--camera") + 1] == "a.exr"
    assert words[words.index("--layer") + 1] == str(tmp_path / "over.usda")
    assert f"--sessionLayer={tmp_path / 'session.usda'}" in words
    assert "movie.usda" not in words and words.count("a.exr") == 1


def test_whole_frames_leave_no_image_of_fewer_samples(tmp_path):
    stage = movie.write_stage(tmp_path)
    words = record_words(template(tmp_path, stage, tmp_path / "a.exr"))
    assert "--onlyWhole" in words and "--resume" not in words
    assert {"--onlyWhole", "--resume"} <= set(record_words(template(tmp_path, stage, tmp_path / "a.exr", "--resume")))
    words = record_words(template(tmp_path, stage, tmp_path / "a.exr", "--cut=2", "--resume"))
    assert not {"--onlyWhole", "--resume"} & set(words), "a part is whole or not there"


def test_what_a_template_cannot_hold_is_said(tmp_path):
    stage = movie.write_stage(tmp_path)
    assert "takes double braces for" in template(tmp_path, stage, tmp_path / "a.exr", "--camera=/a{{b", check=False)
    frames = ",".join(str(frame * frame) for frame in range(400))
    assert "longer than" in template(tmp_path, stage, tmp_path / "a.######.exr", f"--frames={frames}", check=False)
    braces = tmp_path / "{{a}}.usda"
    braces.write_text(movie.STAGE)
    template(tmp_path, braces, tmp_path / "a.exr")
    assert openjd("check", tmp_path / "job.json").returncode == 0


def test_a_template_may_lie_elsewhere(tmp_path):
    stage, other = movie.write_stage(tmp_path), tmp_path / "jobs"
    other.mkdir()
    job = template(other, stage, tmp_path / "a.exr", *FLAGS)
    job["parameterDefinitions"][0]["default"] = "/bin/true"
    (other / "job.json").write_text(json.dumps(job))
    result = openjd("run", other / "job.json")
    assert result.returncode == 0, result.stdout[-3000:]


def test_variables_that_images_depend_on_go_with_the_job(tmp_path, monkeypatch):
    stage = movie.write_stage(tmp_path)
    for name in identity.ENVIRONMENT:
        monkeypatch.delenv(name, raising=False)
    assert "jobEnvironments" not in template(tmp_path, stage, tmp_path / "a.exr")
    monkeypatch.setenv("PATINA_MODEL_PATH", str(tmp_path))
    job = template(tmp_path, stage, tmp_path / "a.exr")
    assert job["jobEnvironments"][0]["variables"] == {"PATINA_MODEL_PATH": str(tmp_path)}
    result = openjd("check", tmp_path / "job.json")
    assert result.returncode == 0, result.stdout
    monkeypatch.setenv("PATINA_MODEL_PATH", "/{{a}}")
    assert "$PATINA_MODEL_PATH" in template(tmp_path, stage, tmp_path / "a.exr", check=False)
