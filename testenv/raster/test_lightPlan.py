# SPDX-License-Identifier: Apache-2.0
"""With a tolerance the rasterizer lights each material by the cheapest way that the table of methods finds good enough."""
import os

import numpy as np
import pytest

import _patina
from patina.chart import measureSubdivision, probes
from patina.experiment import LUMINANCE, draw, relative_error

SKY = os.path.join(os.path.dirname(os.path.dirname(__file__)), "scenes", "textures", "sky.exr")
MATERIALS = {"diffuse": None, "smooth": 0.003, "rough": 0.4}  # alpha of metals


SIZE = {"width": 36, "height": 12}


class Balls:
    """Three balls in a row under one light at a time. One scene and one renderer: each program is compiled once."""

    def __init__(self):
        self.scene, self.renderer = _patina.Scene(), _patina.make_renderer("raster")
        points, counts, indices, _ = measureSubdivision.cage(False)
        with self.scene.edit() as edit:
            edit.set_camera("/camera", transform=probes.moved(0, 0, 4), orthographic=True, horizontal_aperture=33.0,
                            vertical_aperture=11.0, clip_near=0.1)
            for i, (name, alpha) in enumerate(MATERIALS.items()):
                edit.set_material(f"/{name}", probes.network("oren_nayar_diffuse_bsdf", color=(0.5, 0.5, 0.5)) if alpha is None
                                  else probes.network("conductor_bsdf", ior=(0.2,) * 3, extinction=(3.9,) * 3,
                                                      roughness=(alpha, alpha)))
                edit.set_mesh(f"/ball{i}", points=points, face_vertex_counts=counts, face_vertex_indices=indices,
                              scheme="catmullClark", material=f"/{name}", transform=probes.moved(1.1 * (i - 1), 0, 0))

    def light(self, kind):
        with self.scene.edit() as edit:
            if kind == "sky":
                edit.set_light("/light", type="dome", texture_file=SKY, texture_format="latlong", texture_color_space="auto",
                               camera_visible=False)
            elif kind == "even":
                edit.set_light("/light", type="dome", camera_visible=False)
            else:
                edit.set_light("/light", type="rect", transform=probes.facing((-0.5, 0.7, 0.5), 2.0),
                               width=1.5, height=1.5, intensity=9.0)

    def render(self, tolerance=None, samples=192, **more):
        film = _patina.Film()
        settings = {**SIZE, "samples": samples, "seed": 5, "checkpointSeconds": 0.0, "edgeLength": 4.0, **more}
        if tolerance is not None:
            settings["tolerance"] = tolerance
        progress = draw(self.renderer, self.scene, "/camera", settings, film)
        if progress["backend"] != "raster":
            pytest.skip("no OpenGL here")
        chosen = {path: {c["point"]: c for c in plan["choices"]} for path, plan in progress["plans"].items()}
        return np.asarray(film.resolve("color"), np.float64) @ LUMINANCE, chosen


@pytest.fixture(scope="module")
def balls():
    return Balls()


@pytest.mark.parametrize("light, point", [("sky", "domeLight"), ("rect", "areaLight")])
def test_the_cheapest_that_fits_is_taken(balls, light, point):
    """Three materials side by side, seed 5: the whole error, noise of 192 passes of the reference included, is within the
    tolerance. For the smallest one only the choice is looked at: its passes would take a minute.
    """
    balls.light(light)
    truth, none = balls.render(samples=192, seed=6)
    assert not none
    ways = {}
    for tolerance, samples in ((0.3, 192), (0.1, 192), (0.01, 1)):
        image, chosen = balls.render(tolerance, samples)
        for name in MATERIALS:
            choice = chosen["/" + name][point]
            ways[name, tolerance] = choice["method"]
            assert choice["error"] <= 0.4 * tolerance and choice["ns"] <= choice["nsDefault"]
            assert (choice["error"] == 0.0) == (choice["method"] == "sampled")
        assert samples == 1 or relative_error(image, truth) <= tolerance, (tolerance, ways)
    # A method that fits a large tolerance is cheap, and no error is small enough at last. Which of a dome's two tables is the
    # cheaper one is the timing table's to say.
    assert ways["diffuse", 0.3] in (("harmonics", "prefiltered") if point == "domeLight" else ("linearlyTransformedCosines",))
    assert ways["diffuse", 0.01] == ways["rough", 0.01] == "sampled"
    if point == "domeLight":
        assert ways["smooth", 0.1] == "prefiltered" and ways["rough", 0.1] == "sampled"


def test_an_even_sky_needs_no_samples(balls):
    balls.light("even")
    assert balls.render(0.01, samples=2)[1]["/diffuse"]["domeLight"]["method"] in ("harmonics", "prefiltered")


def test_who_decides(balls):
    balls.light("sky")
    for tolerance, methods, expected in ((0.0, {}, "sampled"), (0.3, {"domeLight": "sampled"}, "sampled"),
                                         (0.01, {"domeLight": "harmonics"}, "harmonics")):
        choice = balls.render(tolerance, samples=1, methods=methods)[1]["/diffuse"]["domeLight"]
        assert choice["method"] == expected and choice["forced"] == bool(methods)
    assert balls.render(samples=1)[1] == {}
