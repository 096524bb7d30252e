# SPDX-License-Identifier: Apache-2.0
"""Gaussian splats through Hydra, which hands them on as rprims since OpenUSD 26.08."""
import numpy as np
import pytest

import _patina
import hydraBuild
import stages
from patina import experiment
from rendering import color
from test_oneTruth import MODES, compare, render_with_hydra
from usda import prim

SPLATS = prim("Xform", "Prototype",
    prim("ParticleField3DGaussianSplat", "splats",
         "%(point)s positions%(h)s = [(0, 0, 0), (0.5, 0.25, 1), (-0.5, -0.5, 0.5)]",
         "%(quat)s orientations%(h)s = [(1, 0, 0, 0), (0.5, 0.5, 0.5, 0.5), (0, 1, 0, 0)]",
         "%(vector)s scales%(h)s = [(0.5, 0.25, 0.125), (0.5, 0.5, 0.125), (0.25, 1, 1)]",
         "%(scalar)s opacities%(h)s = [1, 0.75, 0.5]", "uniform int radiance:sphericalHarmonicsDegree = 1",
         "%(vector)s radiance:sphericalHarmonicsCoefficients%(h)s = [(1, 0, 0), (0.5, 0, 0), (0, 0.5, 0), (0, 0, 0.5), (0, "
         "1, 0), (0, 0.5, 0), (0, 0, 0.5), (0.5, 0, 0), (0, 0, 1), (0, 0, 0.5), (0.5, 0, 0), (0, 0.5, 0)]"),
    at=(1, 0, 0))
FLOATS = {"point": "point3f[]", "quat": "quatf[]", "vector": "float3[]", "scalar": "float[]", "h": ""}
HALVES = {"point": "point3h[]", "quat": "quath[]", "vector": "half3[]", "scalar": "half[]", "h": "h"}
COPY = prim("Xform", "copy", meta=("instanceable = true", "prepend references = </Prototype>"), at=(-1, 0.5, -1),
            turn=(10, 20, 30))


@MODES
@pytest.mark.parametrize("kind, instance", [(FLOATS, ""), (HALVES, ""), (FLOATS, COPY)], ids=["floats", "halves", "instance"])
def test_hosts_agree(tmp_path, kind, instance, scene_index):
    hydraBuild.skip_before(2608, "Hydra has no adapter of particle fields that is complete")
    shot = stages.shot_of(stages.front(4, 4, SPLATS % kind, instance), tmp_path)
    image, text = render_with_hydra(shot, tmp_path, scene_index)
    assert text.count("\nSplats ") == shot.scene.dump().count("\nSplats ") == 1 + bool(instance)
    # Hydra multiplies instances' transforms in another order.
    compare(shot, image, scene_index, 1e-4 if instance else 0.0, "rounding of instances' transforms")
    assert image.std() > 0.01


@MODES
def test_hosts_agree_on_the_rasterizer(opengl, tmp_path, scene_index):
    hydraBuild.skip_before(2608, "Hydra has no adapter of particle fields that is complete")
    shot, image = stages.shot_of(stages.front(4, 4, SPLATS % FLOATS), tmp_path), tmp_path / "raster.exr"
    process = hydraBuild.run_host(shot.stage, image, *shot.host_flags(), "--set", "samples=4", "--set", "seed=0", "--set",
                                  "backend=raster", scene_index=scene_index)
    assert not [line for line in hydraBuild.warnings_of(process) if "splats" in line]
    film, renderer = _patina.Film(), _patina.make_renderer("raster")
    settings = {"width": shot.size[0], "height": shot.size[1], "samples": 4, "seed": 0}
    experiment.draw(renderer, shot.scene, shot.camera, settings, film)
    wanted = np.array(film.resolve("color"))[..., :3]
    assert color(image) == pytest.approx(wanted, abs=1e-5)  # rounding of transforms
    assert wanted.std() > 0.01
