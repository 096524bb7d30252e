# SPDX-License-Identifier: Apache-2.0
"""The extension in a real Blender, which exports the scene as USD as well: both hosts show the same."""
import functools
import glob
import os
import subprocess

import numpy as np
import pytest

import hydraBuild
import inProcess
from patina.cli import blenderAddOn
import usda

SIZE, FRAME, DEPTH, SAMPLES = (160, 120), 2, 1, 64
EVEN = 0.1  # of a value's size: neighbours that differ by no more lie on one surface
CAMERA = "/root/camera/camera"


@functools.lru_cache(maxsize=None)
def blender():
    """:returns: (Python that imports bpy, Blender's folder), or why there is none"""
    python = hydraBuild.folder("python")
    if not os.path.exists(python):
        return "this OpenUSD has no Python"
    program = "import bpy, os; print(os.path.dirname(bpy.utils.resource_path('LOCAL')))"
    found = subprocess.run([python, "-c", program], capture_output=True, text=True, check=False)
    return (python, found.stdout.split("\n")[-2]) if found.returncode == 0 else "the OpenUSD of this build is not that of a bpy"


def run(made, *words):
    """Runs blenderScene.py in a folder."""
    if isinstance(blender(), str):
        pytest.skip(blender())
    python, folder = blender()
    extension = made / "patina.zip"
    version = divmod(int(hydraBuild.folder("version")), 100)
    blenderAddOn.pack(folder, hydraBuild.folder("plugin"), version, str(extension))
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "blenderScene.py")
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    done = subprocess.run([python, script, str(extension), str(made), *words],
                          env={**environment, "BLENDER_USER_RESOURCES": str(made / "home")}, capture_output=True, text=True,
                          timeout=hydraBuild.TIMEOUT, check=False)
    assert done.returncode == 0 and os.path.exists(made / "scene.usda"), done.stdout[-2000:] + done.stderr[-4000:]


def tiles(image, side):
    """:returns: means of tiles of so many pixels along a side"""
    height, width = (n // side for n in image.shape[:2])
    return image[:height * side, :width * side].reshape(height, side, width, side, 3).mean(axis=(1, 3))


def test_blender_shows_what_the_exported_stage_is(tmp_path):
    import _patina

    run(tmp_path, "PATINA", f"maxDepth={DEPTH}", f"samples={SAMPLES}")
    stage = inProcess.Stage(str(tmp_path / "scene.usda"), "--camera", CAMERA, "--frames", str(FRAME), "-w", str(SIZE[0]),
                            "--samples", str(SAMPLES), "--maxDepth", str(DEPTH), image_height=SIZE[1])
    own = np.array(_patina.read_image(str(tmp_path / "PATINA.exr")).pixels)[..., :3]
    assert own.shape == (SIZE[1], SIZE[0], 3) and own.mean() > 0.1
    check_tiles(own, stage)
    compare_passes(np.load(tmp_path / "passes.npz"), stage)


def test_the_viewport_shows_what_the_exported_stage_is(tmp_path):
    run(tmp_path, "VIEWPORT", f"maxDepth={DEPTH}", "samples=4")
    if not os.path.exists(tmp_path / "viewport.npz"):
        pytest.skip("this Blender draws nothing without a window")
    found = np.load(tmp_path / "viewport.npz")
    own, place, window = found["pixels"][::-1, :, :3], np.linalg.inv(found["view"].astype(np.float64)).T, found["window"]
    (tmp_path / "view.usda").write_text(usda.stage(
        usda.camera(lens=(50, 100 / window[0, 0], 100 / window[1, 1]), name="view", clippingRange=(0.01, 10000),
                    matrix=tuple(tuple(map(float, row)) for row in place)),
        up="Z", subLayers="[@scene.usda@]", metersPerUnit=1), encoding="utf-8")
    height, width = own.shape[:2]
    stage = inProcess.Stage(str(tmp_path / "view.usda"), "--camera", "/view", "--frames", str(FRAME), "-w", str(width),
                            "--samples", "2", "--maxDepth", str(DEPTH), image_height=height)
    check_tiles(own, stage, 32)


def check_tiles(own, stage, side=8):
    """Asserts that an image has the means of the stage's, tile by tile."""
    seeds = [tiles(stage.image(seed), side) for seed in (11, 12, 13, 14)]
    mean, error = np.mean(seeds, axis=0), np.std(seeds, axis=0, ddof=1)
    # A tile's own error is known from four seeds alone: that of all tiles stands beside it. Six of them, which one tile in
    # 1e9 exceeds.
    bound = 6.0 * np.sqrt(1.25) * np.sqrt(error**2 + np.median(error) ** 2) + 0.002 * mean
    off = np.abs(tiles(own, side) - mean) > bound
    assert off.mean() < 0.01, np.argwhere(off.any(axis=2))[:20].tolist()


def spread(values):
    """:returns: how far the values of a pixel and of its eight neighbours differ, of the channel that differs most"""
    padded = np.pad(values, ((1, 1), (1, 1), (0, 0)), mode="edge")
    around = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(0, 1))
    return np.ptp(around, axis=(-2, -1)).max(axis=-1)


def compare_passes(passes, stage):
    """Depth along the axis, world-space normals and places, albedo. Blender clears all to 0."""
    film = stage.module.Film()
    settings = {**stage.settings, "aovs": ["color", "depth", "normal", "position", "albedo"]}
    stage.renderer.start(stage.scene, stage.camera, settings, film)
    stage.renderer.wait()
    nothing = np.array(film.resolve("depth")).reshape(SIZE[1], SIZE[0]) >= 1e10
    assert 0.05 < nothing.mean() < 0.5
    for name, channels, aov in (("Depth", "Z", "depth"), ("Normal", "XYZ", "normal"), ("Position", "XYZ", "position"),
                                ("Albedo", "RGB", "albedo")):
        own = np.stack([passes[f"{name}.{channel}"] for channel in channels], axis=-1)
        truth = np.array(film.resolve(aov), np.float64).reshape(own.shape)
        assert np.ptp(truth) > 0.1, aov
        truth[nothing] = 0.0
        size = 1.0 + np.abs(truth).max(axis=-1)
        even = spread(truth) <= EVEN * size  # neither edges nor hair
        # Values that far apart have half of it as their largest deviation. Six standard errors of the difference of two means.
        bound = 6.0 * EVEN / 2.0 * np.sqrt(2.0 / SAMPLES) * size
        off = even & (np.abs(own - truth).max(axis=-1) > bound)
        assert even.mean() > 0.5 and not off.any(), (aov, even.mean(), np.argwhere(off)[:20].tolist())


def test_the_extension_needs_its_blender(tmp_path):
    """Another Blender's says so, in place of a crash."""
    run(tmp_path)
    python, _ = blender()
    home = glob.glob(str(tmp_path / "home/extensions/*/patina/host.json"))
    assert len(home) == 1
    with open(home[0], "w", encoding="utf-8") as file:
        file.write('{"version": [23, 11]}')
    program = ("import bpy, addon_utils; addon_utils.enable('bl_ext.user_default.patina'); "
               "bpy.context.scene.render.engine = 'PATINA'\n"
               "try:\n    bpy.ops.render.render()\nexcept RuntimeError as error:\n    print(error)")
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    done = subprocess.run([python, "-c", program], env={**environment, "BLENDER_USER_RESOURCES": str(tmp_path / "home")},
                          capture_output=True, text=True, timeout=hydraBuild.TIMEOUT, check=False)
    assert "the plugin is built for OpenUSD 23.11" in done.stdout + done.stderr, done.stdout + done.stderr
