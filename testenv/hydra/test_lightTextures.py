# SPDX-License-Identifier: Apache-2.0
"""Textures of lights through Hydra: their colour space is the one that the stage says."""
import os

import pytest

import stages
from test_marks import block
from test_oneTruth import MODES, compare, render_with_hydra
import usda

STAGE = usda.stage(
    usda.camera(at=(0, 0, 6)),
    usda.mesh("wall", [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]),
    usda.prim("LIGHT", "light", "float inputs:height = 4", "float inputs:width = 4",
              f"asset inputs:texture:file = @{os.path.join(stages.SCENES, 'textures', 'checker.png')}@ (colorSpace = "
              f"\"SPACE\")",
              at=(0, 0, 3)),
    up="")


@MODES
@pytest.mark.parametrize("light, space", [("DomeLight", "raw"), ("RectLight", "raw"), ("RectLight", "auto")])
def test_the_colour_space_is_the_stages(tmp_path, light, space, scene_index):
    shot = stages.shot_of(STAGE.replace("LIGHT", light).replace("SPACE", space), tmp_path, width=16)
    picture, dump = render_with_hydra(shot, tmp_path, scene_index)
    assert f'textureColorSpace = "{space}"' in block(dump, "/light"), dump
    compare(shot, picture, scene_index)
