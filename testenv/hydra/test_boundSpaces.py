# SPDX-License-Identifier: Apache-2.0
"""Spaces that materials name, through Hydra: the scene and the picture are those of the command line."""
import numpy as np
import pytest

import hydraBuild
import stages
from rendering import color
from test_coordSystems import APPLIED, HEAD, NAMED, NEW, OLD, PLACES, projector, wall
from test_marks import block
from test_oneTruth import MODES, compare, render_with_hydra
import usda


@MODES
@pytest.mark.parametrize("binding, applied", [(NEW, APPLIED), (OLD, ())], ids=["applied", "old"])
def test_spaces_are_read(tmp_path, binding, applied, scene_index):
    if scene_index and binding == OLD:
        pytest.skip("scene indices know bindings of the applied schema alone")
    group = usda.prim("Xform", "set", binding % "/projector", wall(), apis=applied)  # inherited
    shot = stages.shot_of(HEAD + projector(PLACES["turned"]) + group + NAMED, tmp_path, width=24)
    picture, dump = render_with_hydra(shot, tmp_path, scene_index)
    said = [line for line in block(shot.scene.dump(), "/set/wall") if "<space" in line]
    assert len(said) >= 4 and all(line in block(dump, "/set/wall") for line in said), dump
    compare(shot, picture, scene_index)


@MODES
@pytest.mark.skipif(not hydraBuild.missing() and not hydraBuild.has_usdrecord(), reason="this OpenUSD has no usdrecord")
def test_a_space_that_moves_is_read_again(tmp_path, scene_index):
    """The second frame of a projector that moves, and nothing else does, is as the first frame of a host."""
    stage = tmp_path / "moves.usda"
    moves = projector(dict(enumerate(PLACES.values(), 1)))
    stage.write_text(HEAD + moves + wall(NEW % "/projector", schemas=APPLIED) + NAMED)
    for name, frames in (("both", "1:2"), ("alone", "2:2")):
        hydraBuild.run_usdrecord(stage, tmp_path / f"{name}.#.exr", "--imageWidth", 24, "--frames", frames,
                                 "--camera", "/camera", scene_index=scene_index)
    first, second, alone = (color(tmp_path / name) for name in ("both.1.exr", "both.2.exr", "alone.2.exr"))
    assert np.array_equal(second, alone) and not np.array_equal(first, second)
