# SPDX-License-Identifier: Apache-2.0
"""The stage that the README opens with renders by its command, without a warning, and every piece is seen."""
import os

import numpy as np

import inProcess
from patina.cli import openStage

CHESS = os.path.join(os.path.dirname(os.path.dirname(inProcess.SCENES)), "docs", "examples", "chess.usda")


def test_every_prim_of_the_chess_board_is_seen(tmp_path):
    image = tmp_path / "chess.exr"
    inProcess.record(CHESS, image, "-w", 160, "--samples", 1, "--aov", "primId", "--strict")
    ids = set(np.unique(inProcess.pixels(image, ["primId"])))
    stage = openStage.open_stage(CHESS, None, None)
    drawn = [prim for prim in stage.Traverse() if prim.GetTypeName() in ("Mesh", "Cube")]
    assert len(drawn) == 18
    assert len(ids - {-1}) == len(drawn)
