# SPDX-License-Identifier: Apache-2.0
"""Nodes that inputs of lights are connected to, through Hydra."""
import os

import pytest

import stages
from test_lightTextures import STAGE
from test_marks import block
from test_oneTruth import MODES, compare, render_with_hydra
from usda import prim

TEXTURE = os.path.join(stages.SCENES, "textures", "checker.png")
NODES = prim("Scope", "rig",
    prim("Shader", "double", 'uniform token info:id = "ND_multiply_float"', "float inputs:in1 = 1.5", "float inputs:in2 = 2",
         "float outputs:out"),
    prim("Shader", "image", 'uniform token info:id = "ND_image_color3"', f"asset inputs:file = @{TEXTURE}@",
         "color3f outputs:out"))


@MODES
@pytest.mark.parametrize("light", ["DomeLight", "RectLight"])
def test_nodes_are_evaluated_as_on_the_command_line(tmp_path, light, scene_index):
    stage = tmp_path / "light.usda"
    head, tail = STAGE.replace("LIGHT", light).split("    asset inputs:texture:file")
    connected = """    color3f inputs:color.connect = </rig/image.outputs:out>
    float inputs:exposure.connect = </rig/double.outputs:out>
"""
    stage.write_text(head + connected + tail.partition("\n")[2] + NODES)
    shot = stages.Shot(str(stage), tmp_path, width=16)
    picture, dump = render_with_hydra(shot, tmp_path, scene_index)
    text = block(dump, "/light")
    assert "exposure = 3" in text and "connect displacement = /rig/image.out" in text, dump
    compare(shot, picture, scene_index)
