# SPDX-License-Identifier: Apache-2.0
"""Outputs of `patina record` besides the pixels: frames, AOVs, statistics, checkpoints."""
import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import _patina
from patina.cli import main, recordFlags
from patina.farm import identity
import usda

STAGE = usda.stage(
    usda.camera(horizontalAperture=20, verticalAperture=10, at=(0, 0, 10)),
    usda.prim("Sphere", "ball", at={1: (0, 0, 0), 3: (100, 0, 0)}),
    usda.prim("DomeLight", "dome"),
    up="", startTimeCode=1, endTimeCode=3)


@pytest.fixture
def stage(tmp_path):
    path = tmp_path / "stage.usda"
    path.write_text(STAGE)
    return str(path)


def record(*arguments):
    return main.main(["record", *map(str, arguments), "--quiet"])


def pixels(path):
    return np.array(_patina.read_image(str(path)).pixels)


@pytest.mark.parametrize("width, aspect, height", [(960, 20.955 / 15.2908, 700), (640, 16 / 9, 360), (100, 3, 33), (2, 5, 1)])
def test_heights_are_cut_as_usdrecord_cuts_them(width, aspect, height):
    from patina.cli import shot, shots

    made = shot.Shot(None, [], None, (width, None), {})
    assert shots.size_of(made, {"image_aspect": aspect}, 1.0) == (width, height)


def test_height_follows_from_the_aperture(stage, tmp_path):
    assert record(stage, tmp_path / "a.exr", "--imageWidth", 32, "--samples", 1) == 0
    assert pixels(tmp_path / "a.exr").shape == (16, 32, 4)
    assert record(stage, tmp_path / "a.exr", "--imageHeight", 10, "--samples", 1) == 0
    assert pixels(tmp_path / "a.exr").shape == (10, 20, 4)


def test_each_frame_has_its_image(stage, tmp_path):
    statistics = tmp_path / "s.json"
    assert record(stage, tmp_path / "a.##.exr", "--frames", "STARTTIME:ENDTIMEx2", "-w", 16, "--samples", 4,
                  f"--json={statistics}") == 0
    first, last = pixels(tmp_path / "a.01.exr"), pixels(tmp_path / "a.03.exr")
    assert not np.array_equal(first, last)  # the ball has left
    numbers = json.loads(statistics.read_text())
    assert [frame["frame"] for frame in numbers["frames"]] == [1.0, 3.0]
    assert numbers["samples"] == 2 * 16 * 8 * 4


def test_the_last_line_tells_what_was_made(stage, tmp_path, capsys):
    image = tmp_path / "a.exr"
    assert main.main(["record", stage, str(image), "-w", "16", "--samples", "2", "--json"]) == 0
    said = capsys.readouterr()
    last = said.err.splitlines()[-1]
    assert last.startswith(f"{image}: 2 samples in ") and " s, noise " in last
    numbers = json.loads(said.out)["frames"][0]  # standard output is JSON alone
    assert f"noise {100 * numbers['estimatedError']:.2g} %" in last and "left out" in numbers["estimatedErrorIs"]
    assert record(stage, image, "-w", 16, "--samples", 1) == 0 and capsys.readouterr().err == ""  # --quiet


def test_outliers_are_spread_unless_they_are_asked_for():
    parser = main._Parser(prog="patina record")
    recordFlags.add_arguments(parser)
    for words, expected in (([], "spread"), (["--outliers", "keep"], "keep")):
        arguments = parser.parse_args(["a.usda", "a.png", *words])
        assert recordFlags.image_options_of(arguments)["outliers"] == expected


def test_folders_are_made_when_asked(stage, tmp_path, capsys):
    image = tmp_path / "new" / "folder" / "a.exr"
    assert record(stage, image, "-w", 16, "--samples", 1) == 1
    assert "--makeOutputPath" in capsys.readouterr().err and not image.parent.exists()
    assert record(stage, image, "-w", 16, "--samples", 1, "--make-output-path", f"--json={tmp_path / 'j' / 'a.json'}") == 0
    assert image.exists() and (tmp_path / "j" / "a.json").exists()


def test_statistics(stage, tmp_path, capsys):
    assert record(stage, tmp_path / "a.png", "-w", 16, "--samples", 2, "--json") == 0
    numbers = json.loads(capsys.readouterr().out)
    assert set(numbers["seconds"]) == {"open", "translate", "build", "render", "write", "total"}
    assert numbers["seconds"]["total"] >= max(numbers["seconds"].values())
    assert numbers["samples"] == 16 * 8 * 2 and numbers["rays"] > 0
    assert numbers["peakMemoryBytes"] > 1 << 20 and numbers["warnings"] == []
    assert numbers["frames"][0]["converged"] is True


def test_all_aovs_and_metadata(stage, tmp_path):
    assert record(stage, tmp_path / "a.exr", "-w", 16, "--samples", 2, "--aov", "all", "--seed", 7) == 0
    image = _patina.read_image(str(tmp_path / "a.exr"))
    layers = {channel.rpartition(".")[0] or channel for channel in image.channels}
    assert {"R", "G", "B", "A", "depth", "normal", "albedo", "primId", "variance"} <= layers
    assert image.metadata["patina:seed"] == 7 and image.metadata["patina:stage"] == stage


def test_aovs_need_a_format_that_holds_them(stage, tmp_path, capsys):
    assert record(stage, tmp_path / "a.png", "--aov", "depth") == 1
    assert not os.path.exists(tmp_path / "a.png")
    assert record(stage, tmp_path / "a.exr", "--aov", "nonsense") == 1
    assert "nonsense" in capsys.readouterr().err


def test_crop_has_the_pixels_of_the_whole(stage, tmp_path):
    assert record(stage, tmp_path / "whole.exr", "-w", 32, "--samples", 2) == 0
    assert record(stage, tmp_path / "crop.exr", "-w", 32, "--samples", 2, "--dataWindow", "8,4,15,9") == 0
    assert np.array_equal(pixels(tmp_path / "crop.exr"), pixels(tmp_path / "whole.exr")[4:10, 8:16])


def test_dome_can_be_hidden(stage, tmp_path):
    assert record(stage, tmp_path / "a.exr", "-w", 16, "--samples", 1, "--disableDomeLightVisibility") == 0
    corner = pixels(tmp_path / "a.exr")[0, 0]
    assert corner.tolist() == [0, 0, 0, 0]


def test_set_changes_the_picture(stage, tmp_path):
    assert record(stage, tmp_path / "a.exr", "-w", 16, "--samples", 1, "--set", "/dome.intensity=3") == 0
    assert pixels(tmp_path / "a.exr")[0, 0, :3] == pytest.approx([3, 3, 3])


def test_strict_is_quiet_without_warnings(stage, tmp_path):
    assert record(stage, tmp_path / "a.exr", "-w", 16, "--samples", 1, "--strict") == 0


def test_checkpoint_goes_with_success_and_stays_when_asked(stage, tmp_path):
    checkpoint = tmp_path / "a.exr.checkpoint"
    assert record(stage, tmp_path / "a.exr", "-w", 16, "--samples", 2, "--keepCheckpoint") == 0
    assert checkpoint.exists()
    assert record(stage, tmp_path / "a.exr", "-w", 16, "--samples", 4, "--resume") == 0
    assert not checkpoint.exists()
    resumed = pixels(tmp_path / "a.exr")
    assert record(stage, tmp_path / "a.exr", "-w", 16, "--samples", 4) == 0
    assert np.array_equal(resumed, pixels(tmp_path / "a.exr"))


def test_without_checkpoints_what_has_their_name_is_left_alone(stage, tmp_path):
    other = tmp_path / "a.exr.checkpoint"
    other.write_text("mine")
    assert record(stage, tmp_path / "a.exr", "-w", 16, "--samples", 1, "--checkpointSeconds", 0) == 0
    assert other.read_text() == "mine"


@pytest.mark.parametrize("spoil", ["garbage", "other seed", "other build"])
def test_a_checkpoint_that_does_not_fit_is_named_and_not_used(stage, tmp_path, monkeypatch, spoil):
    image, checkpoint, out = tmp_path / "a.exr", tmp_path / "a.exr.checkpoint", tmp_path / "s.json"
    assert record(stage, image, "-w", 16, "--samples", 8) == 0
    expected = pixels(image)
    if spoil == "garbage":
        checkpoint.write_bytes(b"no checkpoint")
    elif spoil == "other build":
        assert record(stage, image, "-w", 16, "--samples", 2, "--keepCheckpoint") == 0
        made = dict(identity.of_process(), build="another")
        monkeypatch.setattr(identity, "of_process", lambda: made)
    else:
        assert record(stage, image, "-w", 16, "--samples", 2, "--seed", 5, "--keepCheckpoint") == 0
    assert record(stage, image, "-w", 16, "--samples", 8, "--resume", f"--json={out}") == 0
    assert "starting anew" in json.dumps(json.loads(out.read_text())["warnings"])
    assert np.array_equal(pixels(image), expected)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_render_leaves_image_and_checkpoint(stage, tmp_path, number):
    image = tmp_path / "a.exr"
    arguments = [stage, str(image), "-w", "64", "--quiet"]
    process = subprocess.Popen([sys.executable, "-m", "patina", "record", *arguments, "--samples", "65536",
                                "--checkpointSeconds", "0.01"], stderr=subprocess.PIPE, text=True)
    checkpoint = tmp_path / "a.exr.checkpoint"
    deadline = time.monotonic() + 120
    while not checkpoint.exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    process.send_signal(number)
    _, errors = process.communicate(timeout=120)
    assert process.returncode == 75 and "interrupted" in errors and "Traceback" not in errors
    assert checkpoint.exists() and np.isfinite(pixels(image)).all()


def test_files_that_are_no_stages(tmp_path, capsys):
    assert record(tmp_path, tmp_path / "a.exr") == 1
    assert record(tmp_path / "absent.usda", tmp_path / "a.exr") == 1
    assert "absent.usda" in capsys.readouterr().err
