# SPDX-License-Identifier: Apache-2.0
"""Skinned meshes through Hydra, which has their points computed: still, and moving while the shutter is open."""
import re

import numpy as np
import pytest

import hydraBuild
import stages
from test_marks import block
from test_oneTruth import MODES, render_with_hydra
import usda

STRAIGHT, BENT = [(1, 0, 0, 0), (1, 0, 0, 0)], [(1, 0, 0, 0), (0.8, 0, 0, -0.6)]
BENDING = {1: STRAIGHT, 2: BENT}
REST = "[((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)), ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 1, 0, 1))]"


def leg(bend, shutter=0.0):
    """:param bend: rotations of both joints"""
    joints = 'uniform token[] joints = ["foot", "foot/knee"]'
    vertex = '(elementSize = 1; interpolation = "vertex")'
    skeleton = usda.prim(
        "Skeleton", "skeleton", joints, f"uniform matrix4d[] bindTransforms = {REST}",
        f"uniform matrix4d[] restTransforms = {REST}", "rel skel:animationSource = </root/skeleton/bend>",
        usda.prim("SkelAnimation", "bend", joints, "float3[] translations = [(0, 0, 0), (0, 1, 0)]",
                  usda.attribute("quatf[] rotations", bend), "half3[] scales = [(1, 1, 1), (1, 1, 1)]"),
        apis=("SkelBindingAPI",))
    skinned = usda.mesh("leg", [(-0.5, 0, 0), (0.5, 0, 0), (-0.5, 2, 0), (0.5, 2, 0)],
                        f"int[] primvars:skel:jointIndices = [0, 0, 1, 1] {vertex}",
                        f"float[] primvars:skel:jointWeights = [1, 1, 1, 1] {vertex}",
                        faces=[(0, 1, 3, 2)], apis=("SkelBindingAPI",))
    return usda.stage(
        usda.camera("double shutter:open = 0", f"double shutter:close = {shutter}", at=(0, 1, 6)),
        usda.prim("SkelRoot", "root", "rel skel:skeleton = </root/skeleton>", skeleton, skinned, apis=("SkelBindingAPI",)),
        up="", timeCodesPerSecond=24, startTimeCode=1, endTimeCode=2)


def points_of(text, path="/root/leg"):
    """:returns: array (samples, points, 3) of what a dump says of a mesh"""
    lines = [line for line in block(text, path) if line.startswith("points")]
    return np.array([[float(x) for x in re.findall(r"[-+.\de]+", line.split(" = ", 1)[1])] for line in lines]).reshape(
        len(lines), -1, 3)


@MODES
@pytest.mark.parametrize("bend, shutter, samples", [(BENT, 0.0, 1), (BENT, 0.5, 1), (BENDING, 0.0, 1), (BENDING, 1.0, 2)],
                         ids=["still", "stillWithShutter", "animated", "moving"])
def test_a_leg_bends(tmp_path, scene_index, bend, shutter, samples):
    if scene_index:
        hydraBuild.skip_before(2505, "scene indices skin nothing")
    shot = stages.shot_of(leg(bend, shutter), tmp_path, width=8)
    _, dump = render_with_hydra(shot, tmp_path, scene_index)
    # The reader samples also what does not move, and between the ends of the shutter what turns.
    found, wanted = points_of(dump), points_of(shot.scene.dump())[[0, -1]]
    assert len(found) == samples, dump
    # Some ten operations on numbers below 4, each rounded to 24 bits.
    assert np.abs(found - wanted).max() <= 10 * 4 * 2.0 ** -24


@MODES
@pytest.mark.parametrize("bend", [BENT, BENDING], ids=["still", "animated"])
def test_bones_are_guides(tmp_path, scene_index, bend):
    """Both hosts show the same pyramid for the one bone, where guides are asked for."""
    shot = stages.shot_of(leg(bend), tmp_path, width=8, purposes=("default", "render", "guide"))
    dump = tmp_path / "hydra.txt"
    hydraBuild.run_host(shot.stage, tmp_path / "hydra.exr", *shot.host_flags(), "--purposes", "default,render,guide",
                        "--dump", dump, scene_index=scene_index)
    found, wanted = (points_of(text, "/root/skeleton") for text in (dump.read_text(), shot.scene.dump()))
    assert found.shape == wanted.shape == (1, 5, 3)
    assert np.abs(found - wanted).max() <= 10 * 4 * 2.0 ** -24  # as of the leg
