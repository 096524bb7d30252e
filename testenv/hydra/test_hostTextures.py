# SPDX-License-Identifier: Apache-2.0
"""The rasterizer's image as a texture of a host's own context (HdRenderBuffer::GetResource), in UsdImagingGLEngine: it is the
image that goes by way of memory, and nothing comes back to memory for it."""
import json
import os

import numpy as np
import pytest

import hydraBuild
import stages

def engine(stage, image, *arguments, context="egl", **more):
    """:returns: engineHost's report"""
    before = []
    if context == "glx":
        before = hydraBuild.xvfb()
        if not before:
            pytest.skip("Xvfb not found: GLX needs a screen")
    process = hydraBuild.run_engine(stage, image, "--camera", "/World/camera", "--size", "48x32", "--context", context,
                                    *arguments, before=before, **more)
    if "GLX was not found when this was built" in process.stderr:
        pytest.skip("engineHost was built without GLX")
    assert process.returncode == 0, process.stderr
    return json.loads(process.stdout)


def pixels(path):
    import _patina

    return np.array(_patina.read_image(str(path)).pixels, np.float64)


@pytest.fixture(autouse=True)
def needs_an_engine():
    if hydraBuild.missing_engine():
        pytest.skip(hydraBuild.missing_engine())


@pytest.mark.parametrize("backend, aov, context", (("raster", "color", "egl"), ("raster", "depth", "egl"),
                                                   ("raster", "color", "glx"), ("interactive", "color", "egl")))
def test_shows_what_is_in_memory(tmp_path, backend, aov, context):
    stage = os.path.join(stages.SCENES, "depthOfField.usda")
    same = ("--aov", aov, "--set", f"backend={backend}", "--set", "samples=3", "--set", "denoise=false", "--repeats", "2")
    texture, memory, before = (tmp_path / name for name in ("texture.exr", "memory.exr", "before.exr"))
    report = engine(stage, texture, *same, context=context)
    engine(stage, memory, *same, "--image", "mapped", context=context)
    by_memory = engine(stage, before, *same, context=context, PATINA_GL_FAULT="sharing:1")
    assert by_memory["statistics"]["patina:imagesOnDevice"] == 0
    if backend == "raster":  # a pair shows no such image where the path tracer is the quicker one: see testBackends
        assert report["statistics"]["patina:imagesOnDevice"] == report["statistics"]["patina:imagesShown"] >= 1
    assert len(np.unique(pixels(texture))) > 100
    # The last image of a pair is the path tracer's, whose samples do not depend on what is shown before.
    assert np.array_equal(pixels(texture), pixels(memory)) and np.array_equal(pixels(texture), pixels(before))


def test_hosts_may_draw_over_it(tmp_path):
    """Colour over what is selected, say: each draw begins with the image itself."""
    stage = os.path.join(stages.SCENES, "diffuseBox.usda")
    plain, once, often = (tmp_path / name for name in ("plain.exr", "once.exr", "often.exr"))
    for image, more in ((plain, ()), (once, ("--select", "/World")), (often, ("--select", "/World", "--times", "4"))):
        engine(stage, image, "--set", "backend=raster", "--set", "samples=2", *more)
    assert np.abs(pixels(once) - pixels(plain)).max() > 0.1
    assert np.array_equal(pixels(once), pixels(often))
