# SPDX-License-Identifier: Apache-2.0
"""More light samples and more branches where the camera looks change the noise, not the image: they stay weighted to one."""
import json

import numpy as np
import pytest

import usda
from rendering import assert_same_mean, color, record, scene


@pytest.mark.parametrize("name", ["lightMesh", "lightDome", "media"])
def test_light_samples_do_not_change_the_mean(name):
    assert_same_mean(name, "--lightSamples", 1, 5, "--maxDepth", 3)


@pytest.mark.parametrize("name", ["lightMesh", "lightDome", "media", "plastic", "prism", "roughGlass", "motionBlur"])
def test_branches_do_not_change_the_mean(name):
    assert_same_mean(name, "--branches", 1, 3, "--maxDepth", 4)


def test_each_branch_walks_beneath_the_surface(tmp_path):
    """Light that comes out again counts once, whatever the number of branches."""
    stage = tmp_path / "skin.usda"
    stage.write_text(usda.stage(
        usda.camera(at=(0, 0.4, 5)), usda.floor("floor", 8, y=-1), usda.prim("Sphere", "ball", bind="skin", radius=1),
        usda.prim("SphereLight", "key", radius=0.4, intensity=60, at=(2, 3, 2)), usda.prim("DomeLight", "sky", intensity=0.3),
        usda.lobe("skin", "subsurface_bsdf", color=(0.9, 0.5, 0.4), radius=(0.4, 0.2, 0.1))))
    assert_same_mean(str(stage), "--branches", 1, 3, "--maxDepth", 5)


@pytest.mark.parametrize("name", ["lightRect", "lightDome", "manyLights"])
def test_what_is_chosen_is_what_flags_ask_for(name, tmp_path):
    """Whatever seed, number of samples and region there are: parts of a frame are merged to the whole."""
    def image(file, *more, seed=3, samples=2):
        record(scene(name), tmp_path / file, "--imageWidth", 32, "--imageHeight", 18, "--samples", samples, "--maxDepth", 3,
               "--seed", seed, f"--json={tmp_path / 'told.json'}", *more)
        told = json.loads((tmp_path / "told.json").read_text())["frames"][0]
        return color(tmp_path / file), (int(told["lightSamples"]), int(told["branches"]))

    own, (lights, branches) = image("own.exr")
    flags = ("--lightSamples", lights, "--branches", branches)
    assert np.array_equal(own, image("same.exr", *flags)[0])
    assert not np.array_equal(own, image("other.exr", *flags[:3], branches + 1)[0])
    assert image("seed.exr", seed=4, samples=5)[1] == image("crop.exr", "--dataWindow", "4,2,9,11")[1] == (lights, branches)


def test_many_lamps_take_more_light_samples_than_one(tmp_path):
    def chosen(name):
        record(scene(name), tmp_path / "x.exr", "--imageWidth", 64, "--imageHeight", 36, "--samples", 1,
               f"--json={tmp_path / 'told.json'}")
        return json.loads((tmp_path / "told.json").read_text())["frames"][0]["lightSamples"]
    assert chosen("manyLights") > chosen("roughGlass")
