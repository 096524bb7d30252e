# SPDX-License-Identifier: Apache-2.0
"""usdrecord with our renderer: every test scene and every stage of the assets becomes an image, with and
without a GL context, from UsdImagingDelegate and from scene indices."""
import json
import os
import shlex
import shutil
import subprocess
import sys

import numpy as np
import pytest

import hydraBuild
import stages
from rendering import color
import usda

pytestmark = pytest.mark.skipif(not hydraBuild.missing() and not hydraBuild.has_usdrecord(),
                                reason="this OpenUSD has no usdrecord")
WIDTH = 48
# Stages that show nothing from the camera that usdrecord takes, and why.
EMPTY = {
    "StandardShaderBall/layers/camera.usda": "a camera alone",
    "StandardShaderBall/layers/example_materials.usda": "materials alone",
    "StandardShaderBall/material_surface_geo/subdiv.usda": "a shape below a prim that only overs speak of",
    "SubdivisionSurfaces/Pyramid/mtl.usda": "materials alone",
    "test_assets/schemaTests/usdGeom/extent/inverse_extent.usda": "usdrecord frames by an extent that is inside out",
    "test_assets/schemaTests/usdGeom/meshes/empty_mesh/empty.usda": "a mesh without faces",
}
# Stages that OpenUSD does not open.
REFUSED = {
    "test_assets/foundation/stage_configuration/framesPerSecond/framesPerSecond_-1.usda",
    "test_assets/foundation/stage_configuration/framesPerSecond/framesPerSecond_0.usda",
}


def shown(image):
    """:returns: whether an image has finite pixels that are not all the same"""
    pixels = color(image)
    return bool(np.isfinite(pixels).all()) and float(np.ptp(pixels)) > 0.0


def record(stage, image, correction="sRGB", **keywords):
    process = hydraBuild.run_usdrecord(stage, image, "--imageWidth", WIDTH, "--purposes", "render",
                                       "--colorCorrectionMode", correction, **keywords)
    warnings = hydraBuild.warnings_of(process)
    assert not [line for line in warnings if line.startswith("Coding Error")], warnings
    return warnings


@pytest.mark.parametrize("scene_index", [False, True], ids=["delegate", "sceneIndex"])
@pytest.mark.parametrize("stage", stages.scenes(), ids=stages.name_of)
def test_scene_without_gpu(tmp_path, stage, scene_index):
    image = tmp_path / "image.exr"
    warnings = record(stage, image, scene_index=scene_index)
    assert not warnings
    assert shown(image)


@pytest.mark.parametrize("scene_index", [False, True], ids=["delegate", "sceneIndex"])
def test_scene_with_gl_context(tmp_path, scene_index):
    if not hydraBuild.xvfb() or not hydraBuild.has_qt():
        pytest.skip("Xvfb or PySide not found: usdrecord needs both for a GL context")
    plain, image = tmp_path / "plain.exr", tmp_path / "image.exr"
    stage = os.path.join(stages.SCENES, "shaderball.usda")
    record(stage, plain, scene_index=scene_index)
    record(stage, image, scene_index=scene_index, gl=True, correction="disabled")
    assert shown(image)
    # The colour goes through the host's half-float textures.
    assert np.abs(color(image) - color(plain)).mean() < 0.01 * color(plain).mean()


@pytest.mark.slow
@pytest.mark.parametrize("stage", stages.assets(), ids=stages.name_of)
def test_asset(tmp_path, stage):
    image = tmp_path / "image.exr"
    if stages.name_of(stage) in REFUSED:
        process = hydraBuild.run_usdrecord(stage, image, check=False)
        assert process.returncode > 0 and "framesPerSecond" in process.stderr
        return
    if int(hydraBuild.folder("version")) < 2505:
        process = hydraBuild.run_usdrecord(stage, image, "--imageWidth", WIDTH, check=False)
        if "Unsupported type VtDictionary" in process.stderr:
            pytest.skip("this OpenUSD cannot pass on MaterialXConfigAPI, to any renderer, and its usdrecord ends")
    record(stage, image)
    assert shown(image) != (stages.name_of(stage) in EMPTY)


# What others read: scene -> how it changes from frame 1 to frame 2.
CHANGES = {
    "lightFilters.usda": usda.prim("", "gobo", "float inputs:ri:lightFilter:width.timeSamples = { 1: 0.5, 2: 1.5 }",
                                   specifier="over"),
    "volume.usda": usda.prim("", "puff",
        usda.prim("", "density", 'token fieldName.timeSamples = { 1: "density", 2: "heat" }', specifier="over"),
        specifier="over"),
    "motionBlur.usda": usda.prim("", "camera", "double shutter:open.timeSamples = { 1: 0, 2: -1 }",
                                 "double shutter:close.timeSamples = { 1: 0, 2: 1 }", specifier="over"),
}


@pytest.mark.parametrize("scene_index", [False, True], ids=["delegate", "sceneIndex"])
@pytest.mark.parametrize("scene", CHANGES)
def test_next_frame_is_as_a_first_one(tmp_path, scene, scene_index):
    stage = tmp_path / "changes.usda"
    stage.write_text(usda.stage(f"( subLayers = [@{os.path.join(stages.SCENES, scene)}@] )",
        usda.prim("", "World", f"{CHANGES[scene]}", specifier="over"),
        up=""), encoding="utf-8")
    for name, frames in (("both", "1:2"), ("alone", "2:2")):
        process = hydraBuild.run_usdrecord(stage, tmp_path / f"{name}.#.exr", "--imageWidth", WIDTH, "--frames", frames,
                                           "--camera", "/World/camera", scene_index=scene_index)
        assert not hydraBuild.warnings_of(process)
    first, second, alone = (color(tmp_path / name) for name in ("both.1.exr", "both.2.exr", "alone.2.exr"))
    assert np.array_equal(second, alone) and not np.array_equal(first, second)


def test_camera_that_is_not_there(tmp_path):
    process = hydraBuild.run_usdrecord(os.path.join(stages.SCENES, "furnace.usda"), tmp_path / "image.exr",
                                       "--camera", "/nowhere", "--imageWidth", WIDTH, check=False)
    assert process.returncode >= 0  # a message or the framing camera, but no crash


@pytest.mark.parametrize("scene_index", [False, True], ids=["delegate", "sceneIndex"])
def test_products_are_written(tmp_path, scene_index):
    stage, product = tmp_path / "stage.usda", tmp_path / "product.exr"
    stage.write_text(usda.stage(
        usda.prim("Scope", "Render",
            usda.prim("RenderSettings", "settings", "rel camera = </World/camera>", "rel products = </Render/product>",
                      "custom int patina:samples = 3"),
            usda.prim("RenderProduct", "product", "rel camera = </World/camera>", "uniform int2 resolution = (40, 30)",
                      "rel orderedVars = [</Render/color>, </Render/depth>]", productName=str(product)),
            *(usda.prim("RenderVar", name, f'uniform token dataType = "{kind}"', f'uniform string sourceName = "{source}"')
              for name, kind, source in (("color", "color3f", "color"), ("depth", "float", "cameraDepth")))),
        up="", subLayers=f"[@{os.path.join(stages.SCENES, 'diffuseBox.usda')}@]", renderSettingsPrimPath="/Render/settings"))
    process = hydraBuild.run_usdrecord(stage, tmp_path / "view.png", "--imageWidth", WIDTH,
                                       "--renderSettingsPrimPath", "/Render/settings", scene_index=scene_index)
    assert product.exists(), process.stderr
    assert "Missing generated" not in process.stderr
    assert color(product).shape == (30, 40, 3) and shown(product)


def test_a_delegate_is_held_to_golden_images_of_the_command_line(tmp_path):
    """`pytest --patina-scenes --renderer`: this plugin through usdrecord shows what `patina record` does."""
    shutil.copy(os.path.join(stages.SCENES, "lightSphere.usda"), tmp_path)
    # The delegate repeats its noise, which counts as a difference: the margin is for that.
    how = {"arguments": ["-w", "32", "--samples", "256"], "renders": 4, "margin": 0.03, "sees": 0.1}
    (tmp_path / "scenes.json").write_text(json.dumps({"*": how}))
    command = [sys.executable, "-m", "pytest", "-p", "patina.regression.plugin", "-p", "no:cacheprovider", "--patina-scenes",
               str(tmp_path)]
    environment = dict(os.environ, PYTEST_DISABLE_PLUGIN_AUTOLOAD="1")
    made = subprocess.run([*command, "--patina-update"], cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert made.returncode == 0, made.stdout + made.stderr
    values = hydraBuild.environment(True)
    own = [f"{name}={value}" for name, value in values.items() if os.environ.get(name) != value]
    script = os.path.join(hydraBuild.folder("root"), "bin", "usdrecord")
    usdrecord = shlex.join(["env", *own, hydraBuild.folder("python"), script, "--disableGpu"])
    done = subprocess.run([*command, "--renderer", "HdPatinaRendererPlugin", "--usdrecord", usdrecord], cwd=tmp_path,
                          env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
