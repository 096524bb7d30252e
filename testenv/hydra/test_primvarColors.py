# SPDX-License-Identifier: Apache-2.0
"""Colour spaces of primvars: in both hosts where the host tells them."""
import numpy as np
import pytest

import hydraBuild
import stages
from rendering import color
from test_oneTruth import MODES, SAMPLES, SEED, render_with_reader
import usda


def mesh(*lines):
    return usda.card("square", 1, *lines, scheme="")


def instances(*lines):
    return usda.prim("PointInstancer", "instances", "rel prototypes = [</instances/square>]", *lines, mesh(),
                     protoIndices=[0], positions=[(0, 0, 0)])


SIGNAL = np.array([0.5, 0.5, 0.25])
LINEAR = ((SIGNAL + 0.055) / 1.055) ** 2.4  # IEC 61966-2-1


@MODES
@pytest.mark.parametrize("prim", [mesh, instances])
def test_display_color(tmp_path, prim, scene_index):
    """A colour in a space shows as its linear value where the host tells spaces, and else as its signal."""
    told = scene_index and int(hydraBuild.folder("version")) >= 2603

    def shot_of(values, space=""):
        authored = f"color3f[] primvars:displayColor = [{tuple(values.tolist())}] ({space})"
        return stages.shot_of(stages.front(2, 2, prim(authored)), tmp_path)

    wanted = render_with_reader(shot_of(LINEAR if told else SIGNAL))
    shot = shot_of(SIGNAL, 'colorSpace = "srgb_rec709_scene"')
    hydra = tmp_path / "hydra.exr"
    process = hydraBuild.run_host(shot.stage, hydra, *shot.host_flags(), "--set", f"samples={SAMPLES}",
                                  "--set", f"seed={SEED}", scene_index=scene_index)
    assert not hydraBuild.warnings_of(process) and not shot.scene.warnings()
    # To the rounding of floats, of a conversion and of a few bounces.
    np.testing.assert_allclose(color(hydra), wanted, rtol=1e-5)
