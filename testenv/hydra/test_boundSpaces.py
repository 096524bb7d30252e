# SPDX-License-Identifier: Apache-2.0
"""Spaces that materials name, through Hydra: the scene and the picture are those of the command line."""
import pytest

import stages
from test_coordSystems import APPLIED, HEAD, NAMED, NEW, OLD, PLACES, PROJECTOR, applying, wall
from test_marks import block
from test_oneTruth import MODES, compare, render_with_hydra


@MODES
@pytest.mark.parametrize("binding, applied", [(NEW, APPLIED), (OLD, ())], ids=["applied", "old"])
def test_spaces_are_read(tmp_path, binding, applied, scene_index):
    if scene_index and binding == OLD:
        pytest.skip("scene indices know bindings of the applied schema alone")
    stage = tmp_path / "spaces.usda"
    group = f'def Xform "set" {applying(applied)}\n{{\n{binding % "/projector"}\n{wall()}}}\n'  # inherited
    stage.write_text(HEAD + PROJECTOR % PLACES["turned"] + group + NAMED)
    shot = stages.Shot(str(stage), tmp_path, width=24)
    picture, dump = render_with_hydra(shot, tmp_path, scene_index)
    said = [line for line in block(shot.scene.dump(), "/set/wall") if "<space" in line]
    assert len(said) >= 4 and all(line in block(dump, "/set/wall") for line in said), dump
    compare(shot, picture, scene_index)
