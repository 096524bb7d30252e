# SPDX-License-Identifier: Apache-2.0
"""A pixel depends on scene, settings and seed: not on threads, interruption or order."""
import json

import numpy as np
import pytest

from patina import experiment
from rendering import color, pixels, record, scene

SMALL = ("--imageWidth", 80, "--imageHeight", 45)


def test_thread_count_does_not_change_a_bit(tmp_path):
    images = []
    for threads in (1, 2, 3):
        image = tmp_path / f"t{threads}.exr"
        record(scene("roughGlass"), image, *SMALL, "--samples", 8, "--threads", threads)
        images.append(pixels(image))
    assert np.array_equal(images[0], images[1]) and np.array_equal(images[0], images[2])


def test_seed_changes_the_noise_and_not_the_mean(tmp_path):
    means, images = [], []
    for seed in (1, 2):
        image = tmp_path / f"s{seed}.exr"
        record(scene("diffuseBox"), image, *SMALL, "--samples", 64, "--seed", seed)
        images.append(color(image))
        means.append(images[-1].mean())
    assert not np.array_equal(images[0], images[1])
    assert means[0] == pytest.approx(means[1], rel=0.02)


@pytest.mark.parametrize("method", ["sampled", "splatted"])
def test_resumed_render_has_the_bits_of_an_uninterrupted_one(tmp_path, method):
    whole, cut = tmp_path / "whole.exr", tmp_path / "cut.exr"
    flags = (*SMALL, "--samples", 48, "--method", f"pixelFilter={method}")
    record(scene("diffuseBox"), whole, *flags)
    # A time limit that is over at once leaves a part and its checkpoint.
    record(scene("diffuseBox"), cut, *flags, "--seconds", 0.05, "--keepCheckpoint")
    assert not np.array_equal(pixels(whole), pixels(cut))
    record(scene("diffuseBox"), cut, *flags, "--resume")
    assert np.array_equal(pixels(whole), pixels(cut))


def test_adaptive_render_is_reproducible_and_cheaper(tmp_path):
    statistics = []
    images = []
    for threads in (1, 2):
        image = tmp_path / f"a{threads}.exr"
        out = tmp_path / f"a{threads}.json"
        record(scene("lightDome"), image, *SMALL, "--samples", 256, "--tolerance", 0.02, "--threads", threads,
               f"--json={out}")
        statistics.append(json.loads(out.read_text()))
        images.append(pixels(image))
    assert np.array_equal(images[0], images[1])
    assert statistics[0]["samples"] < 256 * 80 * 45


def test_adaptive_render_that_is_continued_is_the_same(tmp_path):
    whole, cut = tmp_path / "whole.exr", tmp_path / "cut.exr"
    flags = ["--imageWidth", 40, "--imageHeight", 23, "--tolerance", 0.02]
    record(scene("lightSphere"), whole, *flags, "--samples", 1024)
    # Broken off between two steps, and after the counts at which the first tiles are good enough.
    for samples in (20, 40):
        record(scene("lightSphere"), cut, *flags, "--samples", samples, "--keepCheckpoint")
        assert not np.array_equal(pixels(whole), pixels(cut))
        record(scene("lightSphere"), cut, *flags, "--samples", 1024, "--resume")
        assert np.array_equal(pixels(whole), pixels(cut))


def test_tolerance_is_kept(tmp_path):
    """In the mean over pictures: one of four is beyond it by a sixteenth. Seeds are fixed."""
    reference, image = tmp_path / "reference.exr", tmp_path / "image.exr"
    small = ("--imageWidth", 24, "--imageHeight", 14)
    record(scene("lightSphere"), reference, *small, "--samples", 16384, "--seed", 7)
    b, errors = color(reference) @ experiment.LUMINANCE, []
    for seed in range(4):
        record(scene("lightSphere"), image, *small, "--samples", 2048, "--tolerance", 0.02, "--seed", seed)
        errors.append(experiment.relative_error(color(image) @ experiment.LUMINANCE, b))
    assert np.mean(errors) <= 0.02
