# SPDX-License-Identifier: Apache-2.0
"""Fallbacks where the rasterizer cannot draw: one clear message, and the path tracer's image in its place; a smaller
texture or displayColor where that is enough.

Drivers are made worse by Mesa's own variables where those can, else by PATINA_GL_FAULT.
"""
import json
import os
import subprocess
import sys
from unittest import mock

import numpy as np
import pytest

import bothBackEnds
import inProcess

SCENE, TEXTURED = inProcess.scene("lightRect"), inProcess.scene("texturedDiffuse")
SIZE = ["-w", "32", "--samples", "4"]


def record(stage, image, *arguments, **environment):
    """:returns: the finished process, and what --json says"""
    report = str(image) + ".json"
    command = ["record", stage, str(image), *SIZE, "--json=" + report, *arguments]
    # Mesa reads its variables once, and the functions of OpenGL are loaded once.
    fault = environment.get("PATINA_GL_FAULT", "")
    if any(name.startswith("MESA_") for name in environment) or "lostAtCall" in fault or "singleDraws" in fault:
        process = subprocess.run([sys.executable, "-m", "patina", *command], capture_output=True, text=True,
                                 env=dict(os.environ, **environment), check=False)
    else:
        with mock.patch.dict(os.environ, environment):
            process = inProcess.patina(*command, check=False)
    with open(report, encoding="utf-8") as file:
        return process, json.load(file)


def drawn(stage, image, *arguments, by="raster", **environment):
    """:returns: the image that this back end drew, where the rasterizer was asked for, and the warnings"""
    process, statistics = record(stage, image, "--backend", "raster", *arguments, **environment)
    assert process.returncode == 0, process.stderr
    assert statistics["backend"] == by
    return bothBackEnds.pixels(image), statistics["warnings"]


@pytest.fixture(scope="module")
def traced(tmp_path_factory):
    """:returns: the path tracer's image of SCENE"""
    image = tmp_path_factory.mktemp("traced") / "image.exr"
    return drawn(SCENE, image, "--backend", "embree", by="embree")[0]


# The request, and a part of the message.
NO_START = {
    "noEgl": ({"PATINA_EGL_PLATFORM": "none"}, "EGL"),
    "oldDriver": ({"MESA_GL_VERSION_OVERRIDE": "3.3"}, "no OpenGL 4.5 core profile"),
}
FAILS = {
    "tooFewBuffers": ("storageBlocks:0", "0 storage buffers"),
    "smallBlocks": ("uniformBlock:16384", "16384 bytes in a uniform block, not the 63232"),
    "shaderRefused": ("program:background", "asked for by PATINA_GL_FAULT"),
    "lostBefore": ("lost:0", "has reset the OpenGL context"),
    "lostMidway": ("lost:2", "has reset the OpenGL context"),
    "outOfMemory": ("memory:1", "out of memory"),
    # At any call of OpenGL: while programs are compiled, buffers are filled, passes are drawn.
    **{f"lostAtCall{n}": (f"lostAtCall:{n}", "has reset the OpenGL context") for n in (20, 60, 100, 150, 200, 1000, 5000)},
}


def falls_back(traced, image, words, environment):
    process, statistics = record(SCENE, image, "--backend", "raster", **environment)
    assert process.returncode == 0, process.stderr
    assert statistics["requestedBackend"] == "raster"
    assert statistics["backend"] == statistics["frames"][0]["backend"] == "embree"
    (warning,) = statistics["warnings"]
    assert warning["count"] == 1 and warning["prim"] == ""
    assert words in warning["message"] and warning["message"].endswith("; the path tracer renders instead")
    assert "\n" not in warning["message"] and len(warning["message"]) < 500
    assert process.stderr.count("warning: the rasterizer") == 1  # another picture than was asked for is the worst cause
    np.testing.assert_array_equal(bothBackEnds.pixels(image), traced)


@pytest.mark.parametrize("name", sorted(NO_START))
def test_without_opengl_the_path_tracer_renders(traced, tmp_path, name):
    environment, words = NO_START[name]
    falls_back(traced, tmp_path / "image.exr", words, environment)


@pytest.mark.parametrize("name", sorted(FAILS))
def test_when_the_driver_fails_the_path_tracer_renders(opengl, traced, tmp_path, name):
    fault, words = FAILS[name]
    falls_back(traced, tmp_path / "image.exr", words, {"PATINA_GL_FAULT": fault})


def test_an_image_larger_than_the_drivers_textures(opengl, tmp_path):
    _, warnings = drawn(SCENE, tmp_path / "image.exr", "--imageWidth", "40000", "--imageHeight", "2", "--samples", "1",
                        by="embree")
    assert "no room for an image of 40000 x 2 pixels" in warnings[0]["message"]


def test_strict_makes_it_a_failure(tmp_path):
    image = tmp_path / "image.exr"
    process, _ = record(SCENE, image, "--backend", "raster", "--strict", PATINA_EGL_PLATFORM="none")
    assert process.returncode == 1
    assert "EGL" in process.stderr and not image.exists()


@pytest.fixture(scope="module")
def textured(opengl, tmp_path_factory):
    """:returns: what the rasterizer makes of TEXTURED"""
    image, warnings = drawn(TEXTURED, tmp_path_factory.mktemp("textured") / "image.exr")
    assert not warnings
    return image


def test_a_material_that_does_not_compile_shows_displaycolor(textured, tmp_path):
    material = "/World/materials/checker"
    plain, (warning,) = drawn(TEXTURED, tmp_path / "image.exr", PATINA_GL_FAULT="material:" + material)
    assert warning["prim"] == material and warning["count"] == 1
    assert "displayColor is shown" in warning["message"] and "\n" not in warning["message"]
    assert plain.mean() > 0.0 and abs(plain - textured).max() > 0.05


def test_textures_larger_than_the_driver_takes_are_shown_smaller(textured, tmp_path):
    smaller, (warning,) = drawn(TEXTURED, tmp_path / "image.exr", PATINA_GL_FAULT="textureSize:1")
    assert warning["prim"] and "checker.png' has 64 x 64 pixels" in warning["message"]
    assert "shown with 1 x 1" in warning["message"]
    assert abs(textured.mean() - smaller.mean()) < 0.05 * textured.mean()
    assert (textured != smaller).any()


def test_images_do_not_depend_on_how_draws_are_grouped(opengl, tmp_path):
    images = [drawn(inProcess.scene("instanceValues"), tmp_path / "image.exr", PATINA_GL_FAULT=fault)[0]
              for fault in ("", "singleDraws:1", "ownPages:1")]
    assert images[0].std() > 0.0 and (images[0] == images[1]).all() and (images[0] == images[2]).all()


def test_samples_of_two_back_ends_are_never_mixed(opengl, traced, tmp_path):
    image = tmp_path / "image.exr"
    drawn(SCENE, image, "--samples", "2", "--keepCheckpoint")
    resumed, warnings = drawn(SCENE, image, "--resume", by="embree", PATINA_EGL_PLATFORM="none")
    assert any("starting anew" in w["message"] for w in warnings)
    np.testing.assert_array_equal(resumed, traced)
    # A render that the path tracer has begun in the rasterizer's place, it also continues.
    for samples, more in (("2", "--keepCheckpoint"), ("4", "--resume")):
        resumed, warnings = drawn(SCENE, image, "--samples", samples, more, by="embree", PATINA_EGL_PLATFORM="none")
        assert len(warnings) == 1
    np.testing.assert_array_equal(resumed, traced)
