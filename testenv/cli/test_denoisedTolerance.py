# SPDX-License-Identifier: Apache-2.0
"""`record --denoise --tolerance`: the render ends when the denoised colour is within the tolerance, and tells its error."""
import json

import numpy as np
import pytest

import _patina
import inProcess
from inProcess import record
from patina import experiment
from patina.cli import denoiser

pytest.importorskip("pyoidn", reason="pyoidn is not installed")

SIZE = ("-w", 64)


def told(path, *flags):
    """:returns: the numbers of a frame that is written there"""
    record(*flags, f"--json={path}.json")
    return json.loads(open(f"{path}.json", encoding="utf-8").read())["frames"][0]


def error(pixels, truth):
    luminance = [image[..., :3] @ (0.2126, 0.7152, 0.0722) for image in (pixels, truth)]
    return float(np.mean(np.abs(luminance[0] - luminance[1]) / (luminance[1] + 0.01)))


# The last is a stage of fine geometry, whose hairs the filter takes for noise.
@pytest.mark.parametrize("scene, tolerance", [("diffuseBox", 0.03), ("shaderball", 0.05), ("hair", 0.06)])
def test_fewer_samples_bring_the_denoised_image_within_the_tolerance(scene, tolerance, tmp_path):
    stage = inProcess.scene(scene)
    flags = (stage, tmp_path / "image.exr", *SIZE, "--tolerance", tolerance)
    noisy = told(tmp_path / "noisy", *flags)
    clean = told(tmp_path / "clean", *flags, "--denoise")
    assert clean["samples"] < noisy["samples"] and "denoisedError" not in noisy
    assert 0.0 < clean["denoisedError"] <= tolerance < clean["estimatedError"]
    many = told(tmp_path / "truth", stage, tmp_path / "truth.exr", *flags[2:], "--samples", 512, "--minSamples", 512)
    apart = error(inProcess.pixels(tmp_path / "image.exr"), inProcess.pixels(tmp_path / "truth.exr"))
    assert apart <= clean["denoisedError"] + many["estimatedError"]


def test_threads_and_cuts_change_no_bit(tmp_path):
    """Parts do not know the others, and go on; the whole is cut back where it was done."""
    stage, flags = inProcess.scene("shaderball"), (*SIZE, "--tolerance", "0.04", "--samples", "256", "--denoise")
    for threads in (1, 2):
        numbers = told(tmp_path / f"{threads}", stage, tmp_path / f"{threads}.exr", *flags, "--threads", threads)
        assert numbers["denoisedError"] <= 0.04 < numbers["estimatedError"], "it ends by what the denoiser would leave"
    for part in (1, 2):
        record(stage, tmp_path / "merged.exr", *flags, "--part", f"{part}/2", "--partial", tmp_path / f"{part}.part")
    inProcess.patina("merge", *(tmp_path / f"{part}.part" for part in (1, 2)), tmp_path / "merged.exr")
    one, two, merged = (inProcess.pixels(tmp_path / f"{name}.exr") for name in ("1", "2", "merged"))
    np.testing.assert_array_equal(one, two)
    np.testing.assert_array_equal(one, merged)


def test_an_image_stays_whose_means_are_nearer():
    class Module:
        done = []

        def denoise(self, *_):
            self.done.append("denoised")

        def keep_noisy(self, _film):
            self.done.append("kept")

    def chosen(**numbers):
        return denoiser.run_where_it_helps(Module(), None, {"image": "a.exr", **numbers}), Module.done[-1]

    assert chosen() == chosen(estimatedError=0.01) == chosen(estimatedError=0.03, denoisedError=0.02) == (None, "denoised")
    text, done = chosen(estimatedError=0.01, denoisedError=0.02)
    assert done == "kept" and text.startswith("a.exr: not denoised, since its noise of 1 %")


def test_an_image_that_is_left_has_its_means_twice():
    film, scene = _patina.Film(), _patina.Scene()
    with scene.edit() as edit:
        edit.set_camera("/camera")
        edit.set_light("/sky", type="dome")
    experiment.draw(_patina.make_renderer("embree"), scene, "/camera",
                    {"width": 4, "height": 2, "samples": 2, "checkpointSeconds": 0.0}, film)
    means = np.array(film.resolve("color"))
    assert means.any()
    _patina.keep_noisy(film)
    np.testing.assert_array_equal(film.resolve("color"), means)
    np.testing.assert_array_equal(film.resolve("color.noisy"), means)


def test_halves_are_asked_for_where_they_tell_something():
    settings = {"tolerance": 0.02, "methods": {}}
    assert denoiser.aovs(settings, "embree") == denoiser.GUIDES + denoiser.HALVES
    for without in (denoiser.aovs({**settings, "tolerance": -1.0}, "embree"), denoiser.aovs(settings, "raster"),
                    denoiser.aovs({**settings, "methods": {"caustics": "photons"}}, "embree"),
                    denoiser.aovs({**settings, "methods": {"indirectLight": "shared"}}, "embree")):
        assert without == denoiser.GUIDES
