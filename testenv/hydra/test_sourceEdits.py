# SPDX-License-Identifier: Apache-2.0
"""Edits of attributes that Hydra has no place for: afterwards the picture is that of the stage as it is then."""
import os

import pytest

import hydraBuild
import stages
from test_oneTruth import HERE, color

EDITS = {  # name -> stage, prim, an opinion
    "knots": ("otherForms", "patch", "double[] vKnots = [0, 0, 1, 2, 3, 3]"),
    "range": ("otherForms", "patch", "double2 uRange = (0.25, 0.75)"),
    "trimCurves": ("otherForms", "trimmed", "int[] trimCurve:counts = [1]"),
    "side": ("otherForms", "trimmed", 'string primvars:ri:attributes:trimcurve:sense = "inside"'),
    "curves": ("otherForms", "circle", "double2[] ranges = [(0, 2)]"),
    "tetrahedra": ("otherForms", "tets", "int3[] surfaceFaceVertexIndices = [(0, 1, 3), (0, 2, 1)]"),
    "tangents": ("hermiteCurves", "curves", "vector3f[] tangents = [(1, 0, 0), (1, 0, 0), (1, 0, 0), (1, 0, 0), (1, 0, 0)]"),
    "widths": ("hermiteCurves", "curves", "float[] widths = [0.1, 0.1, 0.4, 0.1, 0.1]"),
}


@pytest.mark.parametrize("name", EDITS)
def test_an_edit_is_seen(tmp_path, name):
    """By scene indices: UsdImagingDelegate tells of no such edit."""
    hydraBuild.skip_before(2411, "as of the forms themselves")
    stage, prim, opinion = EDITS[name]
    stage = os.path.join(HERE, stage + ".usda")
    layer, edits, before, edited, fresh = (tmp_path / file for file in (
        "layer.usda", "edits.txt", "before.exr", "edited.exr", "fresh.exr"))
    layer.write_text(f'#usda 1.0\nover "{prim}"\n{{\n    {opinion}\n}}\n')
    edits.write_text(f"render\nwrite {before}\nsession {layer}\n")
    over = tmp_path / "over.usda"
    over.write_text(f"#usda 1.0\n(\n    subLayers = [@{layer}@, @{stage}@]\n)\n")
    shot = stages.Shot(stage, tmp_path)
    flags = [*shot.host_flags(), "--set", "samples=4"]
    hydraBuild.run_host(stage, edited, *flags, "--edits", edits, scene_index=True)
    hydraBuild.run_host(over, fresh, *flags, scene_index=True)
    before, edited, fresh = map(color, (before, edited, fresh))
    assert (edited == fresh).all() and (edited != before).any()
