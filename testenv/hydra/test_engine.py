# SPDX-License-Identifier: Apache-2.0
"""The host with OpenGL, in which benchmarks run any renderer."""
import json

import numpy as np
import pytest

import hydraBuild
import inProcess

WHY = hydraBuild.missing() or hydraBuild.missing_engine()
pytestmark = pytest.mark.skipif(bool(WHY), reason=str(WHY))
FLAGS = ("--camera", "/World/camera", "--size", "32x18", "--set", "samples=1")


def test_it_draws_and_times_moves_and_edits(tmp_path):
    image = tmp_path / "image.exr"
    process = hydraBuild.run_engine(inProcess.scene("diffuseBox"), image, *FLAGS, "--set", "backend=embree", "--repeats", 2,
                                    "--edit", "/World/materials/red/diffuse.color=0.65,0.05,0.05")
    assert process.returncode == 0, process.stderr
    report = json.loads(process.stdout[process.stdout.index("{"):])
    seconds = report["seconds"]
    assert seconds["first"] > 0.0 and len(seconds["moved"]) == len(seconds["edited"]) == 2 and report["peakMemory"] > 1e6
    assert report["device"] and report["statistics"]["fractionDone"] == 1.0
    drawn = inProcess.pixels(image)
    assert drawn.shape == (18, 32, 3) and np.isfinite(drawn).all() and drawn.mean() > 0.0


@pytest.mark.parametrize("size, images", [(8, range(2, 5)), (1, range(1, 2))])
def test_a_slow_pass_shows_blocks_before_it_ends(size, images):
    process = hydraBuild.run_engine(inProcess.scene("diffuseBox"), "--camera", "/World/camera", "--size", "64x64",
                                    "--set", "backend=embree", "--set", "samples=1", "--set", "integrator=ambientOcclusion",
                                    "--set", "ambientOcclusionSamples=8192", "--set", "threads=1",
                                    "--set", f"firstBlockSize={size}")
    assert process.returncode == 0, process.stderr
    report = json.loads(process.stdout[process.stdout.index("{"):])
    assert report["statistics"]["patina:imagesShown"] in images
    assert 0.0 < report["seen"]["first"] <= report["seconds"]["first"]


@pytest.mark.parametrize("flags, word", [(("--repeats", "few"), "'few' is no number"),
                                         (("--edit", "/World/none.color=1"), "there is no input /World/none.color"),
                                         (("--renderer", "NoSuchPlugin"), "NoSuchPlugin")])
def test_it_says_what_is_wrong(flags, word):
    process = hydraBuild.run_engine(inProcess.scene("diffuseBox"), *FLAGS, *flags)
    assert process.returncode == 1 and word in process.stderr
