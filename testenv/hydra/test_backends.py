# SPDX-License-Identifier: Apache-2.0
"""The rasterizer in Hydra: the render setting `backend`, the renderer "Patina GL", images that change over from one to
the other, and what is shown where OpenGL fails."""
import json
import os

import numpy as np
import pytest

import hydraBuild
import stages
from rendering import color

SCENE = os.path.join(stages.SCENES, "lightRect.usda")
HOST = ["--size", "48x32", "--camera", "/World/camera", "--set", "samples=4"]


def render(folder, name, *arguments, **more):
    """:returns: pixels, statistics and warnings of what hydraHost renders"""
    image, report = folder / (name + ".exr"), folder / (name + ".json")
    process = hydraBuild.run_host(SCENE, image, *HOST, "--json", report, *arguments, **more)
    with open(report, encoding="utf-8") as file:
        statistics = json.load(file)["stats"]
    return color(image), statistics, hydraBuild.warnings_of(process)


@pytest.fixture(scope="module")
def traced(tmp_path_factory):
    pixels, statistics, warnings = render(tmp_path_factory.mktemp("traced"), "image", "--set", "backend=embree")
    assert statistics["patina:backend"] == "embree" and not warnings
    return pixels


@pytest.mark.parametrize("name, settings, noise", [
    ("diffuseBox", ("method:indirectLight=paths", "method:indirectLight=shared"), 0.12),
    ("diffuseBox", ("method:pixelFilter=sampled", "method:pixelFilter=splatted"), 0.12),
    ("plastic", ("indirectRoughness=0", "indirectRoughness=0.3"), 0.05)])
def test_what_the_path_tracer_shares_or_blurs_is_a_setting(tmp_path, name, settings, noise):
    """Another image of the same mean. :param noise: root of the relative variance of a pixel"""
    images = []
    for setting in settings:
        image = tmp_path / (setting.replace(":", "_") + ".exr")
        process = hydraBuild.run_host(os.path.join(stages.SCENES, name + ".usda"), image, "--size", "48x48", "--camera",
                                      "/World/camera", "--set", "samples=16", "--set", "backend=embree", "--set", setting)
        assert not hydraBuild.warnings_of(process)
        images.append(color(image))
    assert not np.array_equal(*images)
    # 2304 pixels: five standard errors of the difference.
    assert images[1].mean() == pytest.approx(images[0].mean(), rel=5 * noise * (2 / 2304) ** 0.5)


@pytest.mark.parametrize("scene_index", [False, True], ids=["delegate", "sceneIndex"])
@pytest.mark.parametrize("how", [["--set", "backend=raster"], ["--renderer", "HdPatinaRasterRendererPlugin"]],
                         ids=["setting", "renderer"])
def test_the_rasterizer_is_a_setting_and_a_renderer(opengl, traced, tmp_path, how, scene_index):
    pixels, statistics, warnings = render(tmp_path, "image", *how, scene_index=scene_index)
    assert statistics["patina:backend"] == "raster" and not warnings
    assert 0.0 < abs(pixels - traced).max()  # another image, of the same scene
    assert abs(pixels.mean() - traced.mean()) < 0.15 * traced.mean()


def test_what_begins_rasterized_ends_path_traced(traced, tmp_path):
    pixels, statistics, _ = render(tmp_path, "image", "--set", "backend=interactive")
    assert statistics["patina:backend"] == "embree"
    np.testing.assert_array_equal(pixels, traced)


def steps(images):
    """:returns: the largest change of a 16x16 block's mean from image to image, as the change-over measures it"""
    seen = [np.where(x <= 1.0, np.sqrt(np.maximum(x, 0.0)), 1.5 - 0.5 / np.maximum(x, 1.0)) for x in images]
    height, width = seen[0].shape[:2]
    blocks = [x.reshape(height // 16, 16, width // 16, 16, 3).mean(axis=(1, 3)) for x in seen]
    return [float(abs(b - a).max()) for a, b in zip(blocks, blocks[1:])]


@pytest.mark.parametrize("pixel_filter", ["sampled", "splatted"])
def test_a_host_sees_no_jump_from_the_first_image_to_the_last(opengl, tmp_path, pixel_filter):
    script = tmp_path / "edits.txt"
    script.write_text(f"set backend interactive\nframes {tmp_path}/first\nset samples 3\nframes {tmp_path}/edited\n"
                      f"set backend embree\nrender\nwrite {tmp_path}/traced.exr\n", encoding="utf-8")
    box = os.path.join(stages.SCENES, "diffuseBox.usda")  # half of its light is that between surfaces
    hydraBuild.run_host(box, tmp_path / "image.exr", *HOST, "--set", f"method:pixelFilter={pixel_filter}", "--edits", script)
    first, edited = ([color(file) for file in sorted(tmp_path.glob(name + "*.exr"))] for name in ("first", "edited"))
    # At the beginning is what the buffers held before: nothing, and the image before the edit.
    for images in (first[1:], edited[1:]):
        assert len(images) > 4
        assert max(steps(images)) <= 0.041
    np.testing.assert_array_equal(edited[-1], color(tmp_path / "traced.exr"))


def test_without_opengl_one_warning_and_the_path_tracer(traced, tmp_path):
    for backend in ("raster", "interactive"):
        pixels, statistics, warnings = render(tmp_path, backend, "--set", "backend=" + backend,
                                              PATINA_EGL_PLATFORM="none")
        assert statistics["patina:backend"] == "embree"
        assert len(warnings) == 1 and "EGL" in warnings[0]
        np.testing.assert_array_equal(pixels, traced)


@pytest.mark.parametrize("backend", ["raster", "interactive"])
def test_a_context_that_is_lost_in_a_session_hands_over(opengl, traced, tmp_path, backend):
    script = tmp_path / "edits.txt"
    last = tmp_path / "last.exr"
    # 300 samples: the path tracer is at work for as long as the rasterizer takes to see its loss.
    script.write_text(f"set samples 3\nexecute 3\nset samples 300\nrender\nset samples 4\nrender\nwrite {last}\n",
                      encoding="utf-8")
    _, statistics, warnings = render(tmp_path, "image", "--set", "backend=" + backend, "--edits", script,
                                     PATINA_GL_FAULT="lost:2")
    assert statistics["patina:backend"] == "embree"
    assert len(warnings) == 1 and "has reset the OpenGL context" in warnings[0]
    np.testing.assert_array_equal(color(last), traced)


def test_the_setting_changes_the_back_end_of_a_running_session(opengl, traced, tmp_path):
    script = tmp_path / "edits.txt"
    files = [tmp_path / f"{i}.exr" for i in range(3)]
    script.write_text("".join(f"set backend {backend}\nrender\nwrite {file}\n"
                              for backend, file in zip(("raster", "embree", "raster"), files)), encoding="utf-8")
    _, statistics, warnings = render(tmp_path, "image", "--edits", script)
    assert statistics["patina:backend"] == "raster" and not warnings
    first, second, third = map(color, files)
    np.testing.assert_array_equal(first, third)
    np.testing.assert_array_equal(second, traced)
    assert abs(first - second).max() > 0.0


def test_usdrecord_with_the_second_renderer(tmp_path):
    if not hydraBuild.has_usdrecord():
        pytest.skip("this OpenUSD has no usdrecord")
    image = tmp_path / "image.exr"
    process = hydraBuild.run_usdrecord(SCENE, image, "--imageWidth", 48, "--camera", "/World/camera",
                                       renderer="Patina GL", PATINA_EGL_PLATFORM="none")
    warnings = hydraBuild.warnings_of(process)
    assert len(warnings) == 1 and "EGL" in warnings[0]
    assert color(image).mean() > 0.0
