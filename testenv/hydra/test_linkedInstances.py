# SPDX-License-Identifier: Apache-2.0
"""A light that is linked to a point instancer lights all of its instances, and one that is linked to another prim none."""
import pytest

import hydraBuild
import stages
from test_oneTruth import MODES, compare, render_with_hydra
from usda import card, prim

INSTANCER = (
    prim("PointInstancer", "tiles", "rel prototypes = [</tiles/tile>]",
        card("tile", 1),
        protoIndices=[0, 0], positions=[(-2, 0, 0), (2, 0, 0)])
    + prim("Xform", "other"))


@MODES
@pytest.mark.parametrize("path, lit", [("/tiles", True), ("/other", False)])
def test_link_to_a_point_instancer(tmp_path, path, lit, scene_index):
    if scene_index:
        hydraBuild.skip_before(2411, "scene indices link no lights")
    link = (f"rel collection:lightLink:includes = <{path}>", "uniform bool collection:lightLink:includeRoot = 0")
    shot = stages.shot_of(stages.front(8, 4, INSTANCER, dome=link), tmp_path)
    image, _ = render_with_hydra(shot, tmp_path, scene_index)
    compare(shot, image, scene_index)
    middle = image[image.shape[0] // 2]
    assert all((middle[int(at * len(middle))] > 0.1).all() == lit for at in (0.25, 0.75)), middle
