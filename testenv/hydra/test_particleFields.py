# SPDX-License-Identifier: Apache-2.0
"""Gaussian splats through Hydra, which hands them on as rprims since OpenUSD 26.08."""
import pytest

import hydraBuild
import stages
from test_oneTruth import MODES, compare, render_with_hydra

SPLATS = """def Xform "Prototype"
{
    double3 xformOp:translate = (1, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def ParticleField3DGaussianSplat "splats"
    {
        %(point)s positions%(h)s = [(0, 0, 0), (0.5, 0.25, 1), (-0.5, -0.5, 0.5)]
        %(quat)s orientations%(h)s = [(1, 0, 0, 0), (0.5, 0.5, 0.5, 0.5), (0, 1, 0, 0)]
        %(vector)s scales%(h)s = [(0.5, 0.25, 0.125), (0.5, 0.5, 0.125), (0.25, 1, 1)]
        %(scalar)s opacities%(h)s = [1, 0.75, 0.5]
        uniform int radiance:sphericalHarmonicsDegree = 1
        %(vector)s radiance:sphericalHarmonicsCoefficients%(h)s = [(1, 0, 0), (0.5, 0, 0), (0, 0.5, 0), (0, 0, 0.5),
            (0, 1, 0), (0, 0.5, 0), (0, 0, 0.5), (0.5, 0, 0), (0, 0, 1), (0, 0, 0.5), (0.5, 0, 0), (0, 0.5, 0)]
    }
}
"""
FLOATS = {"point": "point3f[]", "quat": "quatf[]", "vector": "float3[]", "scalar": "float[]", "h": ""}
HALVES = {"point": "point3h[]", "quat": "quath[]", "vector": "half3[]", "scalar": "half[]", "h": "h"}
COPY = """def Xform "copy" ( instanceable = true
    prepend references = </Prototype> )
{
    double3 xformOp:translate = (-1, 0.5, -1)
    float3 xformOp:rotateXYZ = (10, 20, 30)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
}
"""


@MODES
@pytest.mark.parametrize("kind, instance", [(FLOATS, ""), (HALVES, ""), (FLOATS, COPY)], ids=["floats", "halves", "instance"])
def test_hosts_agree(tmp_path, kind, instance, scene_index):
    hydraBuild.skip_before(2608, "Hydra has no adapter of particle fields that is complete")
    path = tmp_path / "splats.usda"
    path.write_text(stages.front(4, 4) + SPLATS % kind + instance)
    shot = stages.Shot(str(path), tmp_path)
    image, text = render_with_hydra(shot, tmp_path, scene_index)
    assert text.count("\nSplats ") == shot.scene.dump().count("\nSplats ") == 1 + bool(instance)
    # Hydra multiplies instances' transforms in another order.
    compare(shot, image, scene_index, 1e-4 if instance else 0.0, "rounding of instances' transforms")
    assert image.std() > 0.01
