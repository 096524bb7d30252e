# SPDX-License-Identifier: Apache-2.0
"""Point instancers inside of native instances whose prototypes lie outside of these."""
import hydraBuild
import sceneText
import stages
from test_oneTruth import compare, render_with_hydra
from usda import mesh, prim, stage

STAGE = stage(
    prim("Xform", "library",
        prim("Xform", "ball", mesh("card", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]), at=(0, 1, 0)),
        color=(0, 1, 0)),
    prim("Xform", "asset",
        prim("PointInstancer", "pi", "rel prototypes = [</library/ball>]", positions=[(0, 0, 0), (2, 0, 0)],
             protoIndices=[0, 0]),
        specifier="class"),
    prim("Xform", "a", meta=("inherits = </asset>", "instanceable = true"), at=(0, 3, 0)),
    up="")


def shot_of(tmp_path):
    return stages.shot_of(STAGE, tmp_path)


def test_delegate_draws_them(tmp_path):
    shot = shot_of(tmp_path)
    image, text = render_with_hydra(shot, tmp_path, False)
    assert sceneText.difference(text, shot.scene.dump(), native_shapes=False) == ""
    compare(shot, image, False)


def test_scene_index_leaves_them_out_aloud(tmp_path):
    """Scene indices of some releases name an instancer for them that they do not hand on."""
    shot = shot_of(tmp_path)
    dump = tmp_path / "hydra.txt"
    process = hydraBuild.run_host(shot.stage, tmp_path / "hydra.exr", *shot.host_flags(), "--set", "samples=1", "--dump", dump,
                                  scene_index=True)
    drawn = "\nInstancer " in dump.read_text(encoding="utf-8")
    told = [line for line in hydraBuild.warnings_of(process) if "the host has no instancer" in line]
    assert len(told) == (0 if drawn else 1), process.stderr
