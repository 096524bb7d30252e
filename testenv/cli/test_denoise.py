# SPDX-License-Identifier: Apache-2.0
"""`record --denoise`: less error, the noisy colour kept, and a clear word where there is no denoiser."""
import os

import numpy as np
import pytest

import _patina
import inProcess
from inProcess import record
from patina.cli import denoiser, imageMetrics
import usda

WIDTH = 64


@pytest.fixture
def library():
    pytest.importorskip("pyoidn", reason="pyoidn is not installed")


def channels(path):
    image = _patina.read_image(str(path))
    return {name: np.array(image.pixels)[..., i] for i, name in enumerate(image.channels)}


# Below four samples the guides count as noisy.
@pytest.mark.parametrize("scene,samples", [("lightDome", 1), ("lightDome", 4), ("roughConductor", 4), ("texturedMesh", 4)])
def test_the_error_falls(scene, samples, library, tmp_path):
    stage = inProcess.scene(scene)
    # Its noise is at most an eighth of that of the others, and counts in both errors alike.
    truth = inProcess.references(stage, [77], "-w", WIDTH, "--samples", "256")[0]
    record(stage, tmp_path / "noisy.exr", "-w", WIDTH, "--samples", samples)
    record(stage, tmp_path / "clean.exr", "-w", WIDTH, "--samples", samples, "--denoise")
    clean, noisy = channels(tmp_path / "clean.exr"), channels(tmp_path / "noisy.exr")
    for name in "RGB":  # what it started from is the render without it, to the bit
        np.testing.assert_array_equal(clean["color.noisy." + name], noisy[name])
    np.testing.assert_array_equal(clean["A"], noisy["A"])
    error = {key: imageMetrics.differences(inProcess.pixels(tmp_path / f"{key}.exr"), truth)["relMSE"]
             for key in ("clean", "noisy")}
    assert error["clean"] < error["noisy"], error


def test_threads_change_no_bit(library, tmp_path):
    stage = inProcess.scene("lightDome")
    for threads in (1, 2):
        record(stage, tmp_path / f"{threads}.exr", "-w", WIDTH, "--samples", "2", "--denoise", "--threads", threads)
    np.testing.assert_array_equal(*(inProcess.pixels(tmp_path / f"{threads}.exr") for threads in (1, 2)))


# A camera that looks at a mirror, tilted by 45 degrees, with an orange wall above it: all that it sees is that wall.
MIRROR = usda.stage(
    usda.camera(focalLength=200, at=(0, 0, 10)),
    usda.prim("DistantLight", "sun", turn=(60, 0, 0)),
    usda.mesh("mirror", [(-3, -3, 3), (3, -3, 3), (3, 3, -3), (-3, 3, -3)], bind="polished"),
    usda.mesh("wall", [(-20, 8, -20), (20, 8, -20), (20, 8, 20), (-20, 8, 20)], bind="matte"),
    usda.lobe("polished", "conductor_bsdf", roughness=(0, 0)),
    usda.lobe("matte", "oren_nayar_diffuse_bsdf", color=(0.8, 0.4, 0.1)))


def guides(found):
    """:returns: the means of albedo and normal over the image's middle"""
    middle = np.s_[len(found["A"]) // 2 - 4:len(found["A"]) // 2 + 4, WIDTH // 2 - 4:WIDTH // 2 + 4]
    return [np.array([found[f"{name}.{c}"][middle].mean() for c in parts])
            for name, parts in (("denoisingAlbedo", "RGB"), ("denoisingNormal", "XYZ"))]


def test_guides_are_those_of_what_a_mirror_shows(tmp_path):
    (tmp_path / "mirror.usda").write_text(MIRROR)
    record(tmp_path / "mirror.usda", tmp_path / "a.exr", "-w", WIDTH, "--samples", "4", "--aov", "denoisingNormal",
           "--aov", "denoisingAlbedo", "--aov", "albedo")
    found = channels(tmp_path / "a.exr")
    albedo, normal = guides(found)
    # The wall's colour times the mirror's, and the wall's normal: down, towards the mirror.
    mirror = np.array([found["albedo." + c][len(found["A"]) // 2, WIDTH // 2] for c in "RGB"])
    np.testing.assert_allclose(albedo, mirror * (0.8, 0.4, 0.1), rtol=0.01)
    np.testing.assert_allclose(normal, (0.0, -1.0, 0.0), atol=1e-5)


# A camera that looks through a pane of clear glass at an orange wall: two faces, each of which mirrors 4 % of what it gets.
GLASS = usda.stage(
    usda.camera(focalLength=200, at=(0, 0, 10)),
    usda.prim("DistantLight", "sun", turn=(-40, 0, 0)),
    usda.prim("Cube", "pane", scale=(3, 3, 0.1), bind="clear"),
    usda.mesh("wall", [(-20, -20, -5), (20, -20, -5), (20, 20, -5), (-20, 20, -5)], bind="matte"),
    usda.lobe("clear", "dielectric_bsdf", ior=1.5, roughness=(0, 0), scatter_mode="RT"),
    usda.lobe("matte", "oren_nayar_diffuse_bsdf", color=(0.8, 0.4, 0.1)))


def test_guides_are_those_of_what_clear_glass_shows(tmp_path):
    """And black where it mirrors nothing."""
    (tmp_path / "glass.usda").write_text(GLASS)
    record(tmp_path / "glass.usda", tmp_path / "a.exr", "-w", WIDTH, "--samples", "64", "--aov", "denoisingNormal",
           "--aov", "denoisingAlbedo")
    albedo, normal = guides(channels(tmp_path / "a.exr"))
    # One plate lets (1 - r) / (1 + r) through, of which 4096 paths draw their share: four standard errors are 0.017.
    through = (1 - 0.04) / (1 + 0.04)
    np.testing.assert_allclose(albedo, np.multiply((0.8, 0.4, 0.1), through), atol=0.017)
    np.testing.assert_allclose(normal, (0.0, 0.0, through), atol=0.017)


def test_guides_fade_at_outlines(tmp_path):
    """Means over all samples of a pixel: where an outline goes through it, normals of both sides make a shorter one."""
    record(inProcess.scene("lightDome"), tmp_path / "a.exr", "-w", WIDTH, "--samples", "64", "--aov", "denoisingNormal",
           "--aov", "normal")
    found = channels(tmp_path / "a.exr")
    length, nearest = (np.linalg.norm([found[f"{name}.{axis}"] for axis in "XYZ"], axis=0)
                       for name in ("denoisingNormal", "normal"))
    assert length.max() <= 1.0 + 1e-5
    assert set(np.unique(nearest.round(4))) <= {0.0, 1.0}  # of one sample each: they do not fade
    assert ((length > 0.1) & (length < 0.9)).any()


def test_the_rasterizer_is_denoised_too(library, tmp_path):
    inProcess.needs_opengl()
    stage = inProcess.scene("lightRect")
    for name, more in (("noisy", ()), ("clean", ("--denoise",))):
        record(stage, tmp_path / (name + ".exr"), "-w", WIDTH, "--samples", "2", "--backend", "raster", *more)
    clean, noisy = channels(tmp_path / "clean.exr"), channels(tmp_path / "noisy.exr")
    for name in "RGB":
        np.testing.assert_array_equal(clean["color.noisy." + name], noisy[name])
        assert np.isfinite(clean[name]).all() and (clean[name] != noisy[name]).any()


def test_png_has_the_denoised_colour_alone(library, tmp_path):
    images = {}
    for name, more in (("noisy", ()), ("clean", ("--denoise",))):
        record(inProcess.scene("lightDome"), tmp_path / (name + ".png"), "-w", WIDTH, "--samples", "2", *more)
        images[name] = _patina.read_image(str(tmp_path / (name + ".png")))
    assert list(images["clean"].channels) == list(images["noisy"].channels)
    assert (np.array(images["clean"].pixels) != np.array(images["noisy"].pixels)).any()


def test_without_a_denoiser_nothing_is_rendered(tmp_path, monkeypatch):
    found = []

    class Module:
        @staticmethod
        def set_denoiser_library(path):
            found.append(path)

        @staticmethod
        def denoiser_missing():
            return "Open Image Denoise is not found (no such file)"

    monkeypatch.delenv("PATINA_OIDN_LIBRARY", raising=False)
    with pytest.raises(denoiser.CommandError, match="--denoise: Open Image Denoise is not found.*PATINA_OIDN_LIBRARY"):
        denoiser.prepare(Module)
    assert len(found) == 1 and (not found[0] or os.path.exists(found[0]))


def test_aovs_of_light_on_request(library, tmp_path):
    """Each is denoised as the colour is; that of all paths is the colour."""
    stage = inProcess.scene("lightDome")
    for name, more in (("noisy", ()), ("color", ("--denoise",)), ("all", ("--denoiseAovs",))):
        record(stage, tmp_path / f"{name}.exr", "-w", WIDTH, "--samples", 4, "--aov", "diffuse", "--aov", "whole=lpe:C.*[LO]",
               "--aov", "normal", *more)
    noisy, color, both = (channels(tmp_path / f"{name}.exr") for name in ("noisy", "color", "all"))
    for c in "RGB":
        np.testing.assert_array_equal(color["diffuse." + c], noisy["diffuse." + c])
        np.testing.assert_array_equal(both[c], color[c])
        assert (both["diffuse." + c] != noisy["diffuse." + c]).any()
        # The same picture through the same filter: sums of light paths differ in their rounding, and the filter is continuous.
        np.testing.assert_allclose(both["whole." + c], both[c], rtol=1e-3, atol=1e-3)
    for c in "XYZ":
        np.testing.assert_array_equal(both["normal." + c], noisy["normal." + c])
