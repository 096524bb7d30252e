# SPDX-License-Identifier: Apache-2.0
"""The radiance of a white Lambertian floor under each light, through Hydra, against closed forms."""
import math

import pytest

import hydraBuild
import lightStages
from rendering import color

# Scene indices take every light; UsdImagingDelegate too. Both are asked.
MODES = pytest.mark.parametrize("scene_index", [False, True], ids=["delegate", "sceneIndex"])


@MODES
@pytest.mark.parametrize("name", lightStages.CASES)
def test_floor_under_a_light(tmp_path, name, scene_index):
    if scene_index and name == "cylinder":
        hydraBuild.skip_before(2411, "scene indices leave cylinder lights out")
    text, irradiance = lightStages.CASES[name]
    stage, image = tmp_path / "stage.usda", tmp_path / "image.exr"
    stage.write_text(lightStages.stage(text))
    hydraBuild.run_host(stage, image, "--camera", "/camera", "--size", "16x16", "--set", "samples=1024",
                        scene_index=scene_index)
    # As in testenv/render: the camera sees 0.02 units of the floor, and nothing varies.
    assert color(image).mean() == pytest.approx(0.5 * irradiance / math.pi, rel=5e-3, abs=1e-7)
