# SPDX-License-Identifier: Apache-2.0
"""Colour spaces of primvars: in both hosts where the host tells them."""
import numpy as np
import pytest

import hydraBuild
import stages
from rendering import color
from test_oneTruth import MODES, SAMPLES, SEED, render_with_reader

STAGE = """#usda 1.0
def Camera "camera"
{{
    token projection = "orthographic"
    float horizontalAperture = 20
    float verticalAperture = 20
    float2 clippingRange = (1, 100)
    double3 xformOp:translate = (0, 0, 20)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
def DomeLight "dome"
{{
}}
def Mesh "square"
{{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    color3f[] primvars:displayColor = [{values}] ( {space} )
}}
"""
SIGNAL = np.array([0.5, 0.5, 0.25])
LINEAR = ((SIGNAL + 0.055) / 1.055) ** 2.4  # IEC 61966-2-1


@MODES
def test_display_color(tmp_path, scene_index):
    """A colour in a space shows as its linear value where the host tells spaces, and else as its signal."""
    told = scene_index and int(hydraBuild.folder("version")) >= 2603
    path = tmp_path / "colors.usda"

    def shot_of(values, space=""):
        path.write_text(STAGE.format(values=tuple(values.tolist()), space=space), encoding="utf-8")
        return stages.Shot(str(path), tmp_path)

    wanted = render_with_reader(shot_of(LINEAR if told else SIGNAL))
    shot = shot_of(SIGNAL, 'colorSpace = "srgb_rec709_scene"')
    hydra = tmp_path / "hydra.exr"
    process = hydraBuild.run_host(shot.stage, hydra, *shot.host_flags(), "--set", f"samples={SAMPLES}",
                                  "--set", f"seed={SEED}", scene_index=scene_index)
    assert not hydraBuild.warnings_of(process) and not shot.scene.warnings()
    np.testing.assert_allclose(color(hydra), wanted, rtol=1e-4)
    linear = render_with_reader(shot_of(LINEAR))
    np.testing.assert_allclose(render_with_reader(shot_of(SIGNAL, 'colorSpace = "srgb_rec709_scene"')), linear, rtol=1e-4)
