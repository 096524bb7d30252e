# SPDX-License-Identifier: Apache-2.0
"""The choice point `subdivision`: edges get shorter with the tolerance, and pictures are as near the finest as predicted."""
import json
import os

import numpy as np
import pytest

import _patina
from patina.chart import measureSubdivision, probes
from patina.experiment import LUMINANCE, draw, relative_error
from patina.cli import main

SCENES = os.path.join(os.path.dirname(os.path.dirname(__file__)), "scenes")
TOLERANCES = (0.1, 0.05, 0.01, 0.001)
SIDE = 48  # pixels


def ball(kind):
    """A ball of 96 quads that fills most of a picture, before a lit wall."""
    scene = _patina.Scene()
    points, counts, indices, _ = measureSubdivision.cage(False)
    alpha = 0.04
    own = (probes.network("oren_nayar_diffuse_bsdf", color=(0.5, 0.5, 0.5)) if kind == "diffuse" else
           probes.network("conductor_bsdf", ior=(0.2, 0.2, 0.2), extinction=(3.9, 3.9, 3.9), roughness=(alpha, alpha)))
    with scene.edit() as edit:
        edit.set_camera("/camera", transform=probes.moved(0, 0, 4), orthographic=True, horizontal_aperture=12.0,
                        vertical_aperture=12.0, clip_near=0.1)
        edit.set_material("/own", own)
        edit.set_material("/grey", probes.network("oren_nayar_diffuse_bsdf", color=(0.2, 0.2, 0.2)))
        edit.set_mesh("/ball", points=points, face_vertex_counts=counts, face_vertex_indices=indices, scheme="catmullClark",
                      material="/own", transform=measureSubdivision._turned())
        edit.set_mesh("/wall", points=np.array([[-3, -3, -1], [3, -3, -1], [3, 3, -1], [-3, 3, -1]], np.float32),
                      face_vertex_counts=[4], face_vertex_indices=[0, 1, 2, 3], scheme="none", material="/grey")
        edit.set_light("/dome", type="dome", intensity=0.4)
        edit.set_light("/key", type="rect", transform=probes.facing((-0.5, 0.7, 0.5), 4.0), width=2.5,
                       height=2.5, intensity=9.0)
    return scene


def render(scene, backend, tolerance=None, methods=None, samples=16, **more):
    renderer, film = _patina.make_renderer(backend), _patina.Film()
    settings = {"width": SIDE, "height": SIDE, "samples": samples, "minSamples": samples, "seed": 3, "filterRadius": 0.5,
                "methods": methods or {}, "checkpointSeconds": 0.0, **more}
    if tolerance is not None:
        settings["tolerance"] = tolerance
    progress = draw(renderer, scene, "/camera", settings, film)
    if progress["backend"] != backend:
        pytest.skip(f"no {backend} here")
    choices = {choice["point"]: choice for choice in progress["sceneChoices"]}
    return np.asarray(film.resolve("color"), np.float64) @ LUMINANCE, choices, progress["statistics"]


@pytest.mark.parametrize("kind", ["diffuse", "metal"])
def test_edges_follow_the_tolerance(kind):
    """The same random numbers (seed 3) in all pictures of 96 samples; 1e-4 is left for noise that they do not share."""
    scene = ball(kind)
    finest, _, maximum = render(scene, "embree", methods={"subdivision": "0.5px"}, samples=96)
    lengths, triangles = [], []
    for tolerance in TOLERANCES:
        _, choices, statistics = render(scene, "embree", tolerance, samples=1)
        chosen = choices["subdivision"]
        image, none, forced = render(scene, "embree", methods={"subdivision": chosen["method"]}, samples=96)
        assert not none and forced["trianglesStored"] == statistics["trianglesStored"]
        error = relative_error(image, finest)
        assert chosen["error"] <= 0.1 * tolerance
        assert error <= chosen["error"] + 1e-4, (tolerance, chosen, error)
        lengths.append(float(chosen["method"][:-2]))
        triangles.append(statistics["trianglesStored"])
    assert lengths == sorted(lengths, reverse=True) and triangles == sorted(triangles)
    assert lengths[0] >= 4.0 > lengths[-1] and triangles[-1] <= maximum["trianglesStored"]


def test_both_back_ends_choose_alike():
    scene, triangles = ball("diffuse"), []
    for tolerance in TOLERANCES:
        drawn = render(scene, "raster", tolerance, samples=1)
        assert drawn[1]["subdivision"] == render(scene, "embree", tolerance, samples=1)[1]["subdivision"]
        triangles.append(drawn[2]["trianglesStored"])
    assert triangles == sorted(triangles) and triangles[0] < triangles[-1]


def test_the_predicted_error_holds_in_the_rasterizer():
    """The rasterizer's own noise is above the finer predictions, so that it is compared at the coarsest. Its first eight passes
    take as many samples of lights as shadow maps of so many triangles allow, so that they do not share their numbers: 192
    passes leave a 24th of what that makes."""
    scene = ball("diffuse")
    finest, _, _ = render(scene, "raster", methods={"subdivision": "0.5px"}, samples=192)
    image, choices, _ = render(scene, "raster", TOLERANCES[0], methods={"areaLight": "sampled", "domeLight": "sampled"},
                               samples=192)
    error = relative_error(image, finest)
    assert error <= choices["subdivision"]["error"] + 1e-3


def test_small_surfaces_are_expected_to_be_far_off():
    """Some pixels across, which is less than any row was measured at. 96 samples with the random numbers of the finest (seed
    3)."""
    scene, small = ball("diffuse"), {"width": 6, "height": 6, "samples": 96}
    finest = render(scene, "embree", methods={"subdivision": "0.5px"}, **small)[0]
    coarse, _, _ = render(scene, "embree", methods={"subdivision": "2px"}, **small)
    predicted = render(scene, "embree", 0.5, methods={"subdivision": "2px"}, **small)[1]["subdivision"]["error"]
    wrong = relative_error(coarse, finest)
    assert 0.0 < wrong <= predicted
    assert render(scene, "embree", 0.01, width=6, height=6, samples=1)[1]["subdivision"]["method"] in ("1px", "0.5px")


def test_who_decides():
    scene = ball("diffuse")
    count = {edge: render(scene, "embree", edgeLength=edge, samples=1)[2]["trianglesStored"] for edge in (16.0, 4.0, 0.5)}
    assert count[16.0] < count[4.0] < count[0.5]

    def of(tolerance, **more):
        _, choices, statistics = render(scene, "embree", tolerance, samples=1, **more)
        return choices.get("subdivision"), statistics["trianglesStored"]

    assert of(None) == (None, count[4.0])
    exact, triangles = of(0.0)
    assert exact["method"] == "0.5px" and exact["error"] == 0.0 and triangles == count[0.5]
    forced, triangles = of(0.0, methods={"subdivision": "16px"})
    assert forced["forced"] and triangles == count[16.0]
    assert of(0.0, methods={"subdivision": "16px"}, edgeLength=4.0) == (None, count[4.0])


def test_files_say_what_was_chosen(tmp_path):
    image, file = tmp_path / "a.exr", tmp_path / "a.json"
    assert main.main(["record", os.path.join(SCENES, "subdivision.usda"), str(image), "-w", "32", "--tolerance", "0.2",
                      "--samples", "4", "--quiet", f"--json={file}"]) == 0
    frame = json.loads(file.read_text(encoding="utf-8"))["frames"][0]
    scene = frame["plan"]["scene"]
    assert set(scene) == {"subdivision", "pathDepth", "roulette"}
    drawn = scene["subdivision"]["error"]
    assert 0.0 < drawn <= 0.1 * 0.2
    bias = min(frame["predictedError"], 0.4 * 0.2) + drawn + scene["pathDepth"]["error"]
    assert frame["noiseTolerance"] == pytest.approx((0.2**2 - bias**2) ** 0.5)
    reported = _patina.read_image(str(image)).metadata["patina:methods"]
    assert all(f"{point}={choice['method']}" in reported for point, choice in scene.items())
