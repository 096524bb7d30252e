# SPDX-License-Identifier: Apache-2.0
"""usdview shows, picks and edits with our renderer, in both ways into Hydra."""
import json
import os
import subprocess

import pytest

import hydraBuild
import stages
from rendering import color

PICKED = "/World/tall"  # what the stage shows in the middle of its frame
DRIVER = os.path.join(os.path.dirname(__file__), "usdview", "drive.py")


# "Patina GL" draws with a context of its own beside those of usdview's view and of Storm's parts of it.
@pytest.mark.parametrize("renderer, plugin, scene_index", [
    ("Patina", "HdPatinaRendererPlugin", False),
    ("Patina", "HdPatinaRendererPlugin", True),
    ("Patina GL", "HdPatinaRasterRendererPlugin", False),
], ids=["delegate", "sceneIndex", "raster"])
def test_turn_pick_edit(tmp_path, renderer, plugin, scene_index):
    if not hydraBuild.xvfb() or not hydraBuild.has_usdview():
        pytest.skip("Xvfb, or an OpenUSD with usdview and PySide, not found")
    stage = os.path.join(stages.SCENES, "diffuseBox.usda")
    environment = hydraBuild.environment(
        scene_index, PATINA_DRIVE_SHADER="/World/materials/white/diffuse", PATINA_DRIVE_INPUT="color",
        PATINA_DRIVE_SIZE="160x120", QT_QPA_PLATFORM="xcb", LIBGL_ALWAYS_SOFTWARE="1")
    command = hydraBuild.xvfb() + [hydraBuild.folder("python"), DRIVER, str(tmp_path), stage, "--renderer", renderer,
                                   "--defaultsettings"]
    process = subprocess.run(command, env=environment, capture_output=True, text=True, errors="replace",
                             timeout=hydraBuild.TIMEOUT, check=False)
    assert process.returncode == 0, process.stdout[-2000:] + process.stderr[-4000:]
    with open(tmp_path / "result.json", encoding="utf-8") as file:
        result = json.load(file)
    assert result["renderer"] == plugin
    assert all(shot["converged"] for shot in result["shots"])
    assert result["picked"] == result["selected"] == PICKED
    start, turned, edited = (color(tmp_path / f"{shot['name']}.png") for shot in result["shots"])
    assert abs(turned - start).mean() > 0.02
    redder = edited - turned
    assert redder[..., 0].mean() > redder[..., 1].mean() + 0.02
