# SPDX-License-Identifier: Apache-2.0
"""Colour spaces of primvars: in both hosts where the host tells them."""
import numpy as np
import pytest

import hydraBuild
import stages
from rendering import color
from test_oneTruth import MODES, SAMPLES, SEED, render_with_reader

MESH = """def Mesh "square"
{{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    {color}
}}
"""
INSTANCES = """def PointInstancer "instances"
{{
    int[] protoIndices = [0]
    point3f[] positions = [(0, 0, 0)]
    rel prototypes = </instances/square>
    {color}
    """ + MESH.replace("{color}", "") + "}}\n"
COLOR = "color3f[] primvars:displayColor = [%s] ( %s )"
SIGNAL = np.array([0.5, 0.5, 0.25])
LINEAR = ((SIGNAL + 0.055) / 1.055) ** 2.4  # IEC 61966-2-1


@MODES
@pytest.mark.parametrize("prim", [MESH, INSTANCES], ids=["mesh", "instances"])
def test_display_color(tmp_path, prim, scene_index):
    """A colour in a space shows as its linear value where the host tells spaces, and else as its signal."""
    told = scene_index and int(hydraBuild.folder("version")) >= 2603
    path = tmp_path / "colors.usda"

    def shot_of(values, space=""):
        authored = COLOR % (tuple(values.tolist()), space)
        path.write_text(stages.front(2, 2) + prim.format(color=authored), encoding="utf-8")
        return stages.Shot(str(path), tmp_path)

    wanted = render_with_reader(shot_of(LINEAR if told else SIGNAL))
    shot = shot_of(SIGNAL, 'colorSpace = "srgb_rec709_scene"')
    hydra = tmp_path / "hydra.exr"
    process = hydraBuild.run_host(shot.stage, hydra, *shot.host_flags(), "--set", f"samples={SAMPLES}",
                                  "--set", f"seed={SEED}", scene_index=scene_index)
    assert not hydraBuild.warnings_of(process) and not shot.scene.warnings()
    # To the rounding of floats, of a conversion and of a few bounces.
    np.testing.assert_allclose(color(hydra), wanted, rtol=1e-5)
