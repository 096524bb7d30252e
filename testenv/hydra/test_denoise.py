# SPDX-License-Identifier: Apache-2.0
"""The render setting `denoise`: the last image in Hydra is the denoised one, and without a denoiser the noisy one with a
warning."""
import os

import numpy as np
import pytest

import hydraBuild
import stages
from patina.cli import denoiser
from rendering import color, pixels

SCENE = os.path.join(stages.SCENES, "lightDome.usda")
HOST = ["--size", "48x32", "--camera", "/World/camera", "--set", "backend=embree"]


def render(folder, name, samples, *arguments, **more):
    """:returns: pixels and warnings of what hydraHost renders"""
    image = folder / (name + ".exr")
    process = hydraBuild.run_host(SCENE, image, *HOST, "--set", f"samples={samples}", *arguments, **more)
    return color(image), hydraBuild.warnings_of(process)


def test_the_last_image_has_less_error(tmp_path):
    library = denoiser.of_wheel()
    if not library:
        pytest.skip("pyoidn is not installed")
    truth, _ = render(tmp_path, "truth", 512, "--set", "seed=9")
    noisy, _ = render(tmp_path, "noisy", 4)
    clean, warnings = render(tmp_path, "clean", 4, "--set", "denoise=true", PATINA_OIDN_LIBRARY=library)
    assert not warnings
    assert ((clean - truth) ** 2).mean() < ((noisy - truth) ** 2).mean()


def test_a_tolerance_is_about_the_denoised_image(tmp_path):
    library = denoiser.of_wheel()
    if not library:
        pytest.skip("pyoidn is not installed")
    counts = {}
    for clean in ("false", "true"):
        image = tmp_path / f"{clean}.exr"
        hydraBuild.run_host(SCENE, image, *HOST, "--aov", "sampleCount", "--set", "samples=256", "--set",
                            "convergedVariance=0.02", "--set", f"denoise={clean}", PATINA_OIDN_LIBRARY=library)
        counts[clean] = pixels(image)
    assert counts["true"].max() == 16 < counts["false"].max()


def test_without_a_denoiser_the_image_stays_as_it_is(tmp_path):
    noisy, _ = render(tmp_path, "noisy", 2)
    same, warnings = render(tmp_path, "same", 2, "--set", "denoise=true", PATINA_OIDN_LIBRARY=str(tmp_path / "none.so"))
    np.testing.assert_array_equal(same, noisy)
    assert len([w for w in warnings if "Open Image Denoise" in str(w)]) == 1
