# SPDX-License-Identifier: Apache-2.0
"""Surfaces that are rougher to paths that come from rough ones (`--indirectRoughness`)."""
import numpy as np
import pytest
import scipy.stats

from inProcess import Stage
from rendering import scene
import usda
from usda import camera, lobe, mesh, prim

SEEDS = range(8)
SIGNIFICANCE = 1e-4  # of each test; fixed seeds
BLOCK = 16           # samples that are blurred alike (sampleBlock.h)
CURVE = 1.5e-3       # error of the energy of constant lobes (testEnergyCurve.cpp)


def stage_of(path, *arguments, width=32, samples=BLOCK, roughness=0.0):
    return Stage(path, "--imageWidth", width, "--samples", samples, "--disableCameraLight", "--maxDepth", 2, "--branches", 1,
                 "--lightSamples", 1, "--indirectRoughness", roughness, *arguments)


def wall(folder, node, **inputs):
    """A white wall in view. The sun above reaches it by way of a floor alone, which is out of view."""
    path = folder / f"{node}.usda"
    path.write_text(usda.stage(
        camera(flat=(4, 4), at=(0, 2.2, 5)), usda.floor("ground", 50, bind="metal", doubleSided=True),
        mesh("wall", [(-9, 0.1, 0), (9, 0.1, 0), (9, 9, 0), (-9, 9, 0)], bind="white", doubleSided=True),
        lobe("metal", node, **inputs), lobe("white", "oren_nayar_diffuse_bsdf", color=(1, 1, 1)),
        prim("DistantLight", "sun", intensity=1, angle=0, turn=(-90, 0, 0))))
    return path


@pytest.mark.parametrize("node, inputs", [
    ("conductor_bsdf", {}), ("dielectric_bsdf", {}), ("generalized_schlick_bsdf", {"color0": (0.9, 0.5, 0.2)})])
def test_it_is_the_roughness_of_what_comes_second(tmp_path, node, inputs):
    """The wall shows what a floor of that roughness would send it. A rougher floor stays as it is."""
    rough = wall(tmp_path, node, roughness=(0.4, 0.4), **inputs)
    wanted = stage_of(rough).image(1)
    assert wanted.mean() > 1e-3
    assert np.array_equal(stage_of(rough, roughness=0.3).image(1), wanted)
    smooth = stage_of(wall(tmp_path, node, roughness=(0.02, 0.02), **inputs), roughness=0.4).image(1)
    assert np.allclose(smooth, wanted, rtol=2 * CURVE, atol=1e-5)


@pytest.mark.parametrize("ball, kept", [
    (lobe("ball", "dielectric_bsdf", ior=1.5, roughness=(0, 0), scatter_mode="RT"), True),
    (lobe("ball", "conductor_bsdf", roughness=(0.1, 0.1)), False)], ids=["glass", "metal"])
def test_what_the_camera_sees_in_mirrors_and_clear_glass_keeps_its_bits(tmp_path, ball, kept):
    """A ball before two mirrors, each in the other. Past a rough ball they are blurred."""
    path = tmp_path / "mirrors.usda"
    path.write_text(usda.stage(
        camera(at=(0, 1, 6)), usda.floor("ground", 20, bind="mirror", doubleSided=True),
        mesh("back", [(-9, 0, -2), (9, 0, -2), (9, 9, -2), (-9, 9, -2)], bind="mirror", doubleSided=True),
        prim("Sphere", "sphere", bind="ball", radius=1, at=(0, 1, 0)), ball,
        lobe("mirror", "conductor_bsdf", roughness=(0, 0)), prim("DomeLight", "sky", intensity=1)))
    plain, blurred = (stage_of(path, "--maxDepth", 8, roughness=roughness).image(1) for roughness in (0.0, 1.0))
    assert plain.any() and np.array_equal(plain, blurred) == kept


def test_no_light_is_lost(tmp_path):
    """A white ball on a white floor under a white sky is as bright as the sky, however rough they become."""
    path = tmp_path / "white.usda"
    white = {"color0": (1, 1, 1), "color90": (1, 1, 1)}
    path.write_text(usda.stage(
        camera(at=(0, 1, 6)), usda.floor("ground", 1e4, bind="chalk", doubleSided=True),
        prim("Sphere", "ball", bind="metal", radius=1, at=(0, 1, 0)),
        lobe("metal", "generalized_schlick_bsdf", roughness=(0.05, 0.05), **white),
        lobe("chalk", "oren_nayar_diffuse_bsdf", color=(1, 1, 1)), prim("DomeLight", "sky", intensity=1)))
    stage = stage_of(path, "--maxDepth", 64, "--rouletteDepth", 64, samples=64, roughness=0.5)
    found = [stage.image(seed).mean() for seed in SEEDS]
    assert scipy.stats.sem(found) < 2e-3
    assert scipy.stats.ttest_1samp(found, 1.0).pvalue > SIGNIFICANCE, found


def test_light_of_photons_and_of_paths_stays_one(tmp_path):
    """A white floor under a slab of glass shows a white sky. Photons have what comes from the sky through the slab, and paths
    what comes from the floor by way of it."""
    path, h = tmp_path / "slab.usda", 1.5
    corners = [(x, y, z) for y in (0.02, 0.2) for x, z in ((-h, -h), (h, -h), (h, h), (-h, h))]
    faces = [(0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]
    path.write_text(usda.stage(
        camera(flat=(20, 20), at=(0, 5, 0), turn=(-90, 0, 0)), usda.floor("ground", 1.4, bind="chalk", doubleSided=True),
        mesh("slab", corners, faces=faces, bind="glass"),
        lobe("glass", "dielectric_bsdf", ior=2.4, roughness=(0, 0), scatter_mode="RT"),
        lobe("chalk", "oren_nayar_diffuse_bsdf", color=(1, 1, 1)), prim("DomeLight", "sky", intensity=1)))
    stage = stage_of(path, "--maxDepth", 64, "--method", "caustics=photons", width=24, samples=64, roughness=0.5)
    found = [stage.image(seed).mean() for seed in SEEDS]
    assert scipy.stats.sem(found) < 0.01
    assert scipy.stats.ttest_1samp(found, 1.0).pvalue > SIGNIFICANCE, found


def test_caustics_have_less_noise():
    """Light by way of glossy surfaces. Wilcoxon's test of the spread of each pixel over seeds."""
    noise = []
    for roughness in (0.3, 0.0):
        stage = stage_of(scene("plastic"), "--maxDepth", 4, roughness=roughness)
        noise.append(np.array([stage.image(seed) for seed in SEEDS]).std(0, ddof=1).ravel())
    assert noise[0].mean() < noise[1].mean()
    assert scipy.stats.wilcoxon(*noise, alternative="less").pvalue < SIGNIFICANCE


def test_the_blur_shrinks_with_samples(tmp_path):
    """As the sixth root of samples: the 64th block asks for half the roughness of the first."""
    late = {"samples": 64 * BLOCK}
    found = stage_of(wall(tmp_path, "conductor_bsdf", roughness=(0.02, 0.02)), **late, roughness=0.8)
    wanted = stage_of(wall(tmp_path, "conductor_bsdf", roughness=(0.4, 0.4)), **late)
    images = [stage.image(1, sampleBegin=63 * BLOCK) for stage in (found, wanted)]
    assert images[1].mean() > 1e-3
    assert np.allclose(*images, rtol=2 * CURVE, atol=1e-5)


def test_threads_and_crops_keep_bits():
    one, three = (stage_of(scene("plastic"), "--threads", n, "--maxDepth", 4, samples=40, roughness=0.3) for n in (1, 3))
    whole = one.image(5)
    assert np.array_equal(whole, three.image(5)) and whole.any()
    crop = three.image(5, dataWindow=(3, 2, 9, 8))
    assert np.array_equal(crop[2:9, 3:10], whole[2:9, 3:10])
