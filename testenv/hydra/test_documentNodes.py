# SPDX-License-Identifier: Apache-2.0
"""Nodes that a MaterialX document of the stage defines, which Hydra names by identifiers that OpenUSD makes up."""
import numpy as np
import pytest

import hydraBuild
import mtlx
import stages
from rendering import color
from test_oneTruth import MODES, render_with_reader
from usda import mesh, prim


# Two documents give one name to nodes that differ: one tints, the other takes a fifth.
def change(factor):
    return mtlx.model("change", {"in": (0.5, 0.5, 0.5)}, {"product": ("multiply color3", {"in1": "<in>", "in2": factor})},
                      out="product")


# A surface that is a node of the document itself, made of the other one and of a model of MaterialX's library.
TINT = mtlx.document(
    change((1, 0.25, 0)),
    mtlx.model("paint", {"paintColor": (1, 1, 1)}, {
        "changed": ("change color3", {"in": "<paintColor>"}),
        "body": ("standard_surface", {"base": 1, "base_color": "<changed>", "specular": 0})}, out="body"),
    mtlx.shader("left", "paint surfaceshader", {"paintColor": (0.8, 0.8, 0.8)}, node="painted"))
FIFTH = mtlx.document(
    change((0.2, 0.2, 0.2)), {"changed": ("change color3", {"in": (0.5, 0.5, 1)})},
    mtlx.lobe("right", "oren_nayar_diffuse_bsdf", {"color": "<changed>"}))
# In a dome of light without shadows a diffuse surface shows its colour.
EXPECTED = {"left": (0.8, 0.2, 0.0), "right": (0.1, 0.1, 0.2)}


def stage_of():
    squares = "".join((
        mesh(f"{name}Square", [(x, -1, 0), (x + 2, -1, 0), (x + 2, 1, 0), (x, 1, 0)], scheme="",
             bind=f"{name}/Materials/{name}")
        + prim("Scope", name, meta=(f"references = @./{name}.mtlx@</MaterialX>",))) for name, x in (("left", -2), ("right", 0)))
    return stages.front(4, 2) + squares


@MODES
def test_each_document_has_its_own(tmp_path, scene_index):
    if not hydraBuild.reads("mtlx"):
        pytest.skip("this OpenUSD does not read MaterialX documents")
    hydraBuild.skip_before(2505, "the reader of MaterialX ends at definitions of the document itself (\"Used null prim\")")
    for name, text in (("left.mtlx", TINT), ("right.mtlx", FIFTH), ("stage.usda", stage_of())):
        (tmp_path / name).write_text(text, encoding="utf-8")
    shot = stages.Shot(str(tmp_path / "stage.usda"), tmp_path)
    hydra = tmp_path / "hydra.exr"
    process = hydraBuild.run_host(shot.stage, hydra, *shot.host_flags(), "--set", "samples=4", scene_index=scene_index)
    assert not hydraBuild.warnings_of(process) and not shot.scene.warnings()
    for host, image in (("reader", render_with_reader(shot)), ("hydra", color(hydra))):
        half = image.shape[1] // 2
        for name, part in (("left", image[:, :half]), ("right", image[:, half:])):
            # To the rounding of floats: each sample of a diffuse surface in a sky of 1 is its colour.
            np.testing.assert_allclose(part[8:-8, 8:-8].mean(axis=(0, 1)), EXPECTED[name], atol=1e-5,
                                       err_msg=f"{host}: {name}")
