# SPDX-License-Identifier: Apache-2.0
"""Caustics from photons: against Fresnel's and Beer's laws, where paths find nothing, and against paths, where they do."""
import numpy as np
import pytest
import scipy.stats

from inProcess import Stage
from patina.significance import sidak
import usda
from usda import camera, floor, material, mesh, prim

SEEDS = range(8)
SIGNIFICANCE = 1e-4  # of each test; fixed seeds
IOR = 1.5
PASSED = (1 - ((IOR - 1) / (IOR + 1)) ** 2) ** 2  # by both faces of a slab, seen straight on (Fresnel)

SLAB = mesh("slab", [(-2, 1, 2), (2, 1, 2), (2, 1, -2), (-2, 1, -2), (-2, 2, 2), (2, 2, 2), (2, 2, -2), (-2, 2, -2)],
            faces=[(4, 5, 6, 7), (3, 2, 1, 0), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)], bind="glass")
BALL = prim("Sphere", "ball", bind="glass", radius=0.4, at=(0, 1.5, 0))
SUN = prim("DistantLight", "sun", intensity=2, angle=0, turn=(-90, 0, 0))
LAMP = prim("RectLight", "lamp", intensity=5, width=3, height=3, at=(0, 4, 0), turn=(-90, 0, 0))


def stage(folder, glass, light, roughness=0.0, color=(1, 1, 1), aperture=10, x=0):
    path = folder / "caustics.usda"
    path.write_text(usda.stage(
        camera(flat=(aperture, aperture), clippingRange=(0.01, 100), at=(x, 0.9, 0), turn=(-90, 0, 0)),
        floor("floor", 1.5, color=(0.5, 0.5, 0.5)), glass,
        material("glass", {"surface": ("ND_open_pbr_surface_surfaceshader", {
            "transmission_weight": 1, "transmission_color": color, "transmission_depth": 1, "specular_ior": 1.5,
            "specular_roughness": roughness})}), light))
    return path


def opened(path, method, *arguments):
    return Stage(path, "--imageWidth", 16, "--samples", 16, "--disableCameraLight", "--method", f"caustics={method}",
                 *arguments)


@pytest.mark.parametrize("color", [(1, 1, 1), (0.5, 0.25, 0.9)])
def test_a_slab_passes_what_fresnel_and_beer_leave(tmp_path, color):
    """Three surfaces at most: light that goes to and fro between the faces is left out. A sun of no size through flat glass
    is found by no path."""
    sun = opened(stage(tmp_path, "", SUN), "paths", "--maxDepth", 1).image(0).mean()  # the bare floor
    path = stage(tmp_path, SLAB, SUN, color=color)
    made = opened(path, "photons", "--maxDepth", 3, "--samples", 128)
    images = np.array([made.image(seed).mean((0, 1)) for seed in SEEDS])
    assert not opened(path, "paths", "--maxDepth", 3).image(0).any()
    wanted = sun * PASSED * np.array(color)
    for c in range(3):
        t = scipy.stats.ttest_1samp(images[:, c], wanted[c])
        assert t.pvalue > SIGNIFICANCE, (images[:, c].mean(), wanted[c])
    # The test could see an error of this size.
    assert scipy.stats.sem(images[:, 0]) < 0.01 * wanted[0]


def test_photons_show_what_paths_find(tmp_path):
    path = stage(tmp_path, BALL, LAMP, roughness=0.5, aperture=20)
    means = {}
    for method, samples in (("photons", 64), ("paths", 256)):
        made = opened(path, method, "--samples", samples)
        images = np.array([made.image(seed)[..., 1] for seed in SEEDS])
        # Quarters of the image: what photons blur stays in them.
        means[method] = images.reshape(len(SEEDS), 2, 8, 2, 8).mean((2, 4)).reshape(len(SEEDS), 4)
    for q in range(4):
        a, b = means["photons"][:, q], means["paths"][:, q]
        assert scipy.stats.ttest_ind(a, b, equal_var=False).pvalue > sidak(SIGNIFICANCE, 4), (a.mean(), b.mean())
        assert np.hypot(scipy.stats.sem(a), scipy.stats.sem(b)) < 0.01 * b.mean()


def test_bits_depend_on_no_threads(tmp_path):
    path = stage(tmp_path, BALL, LAMP, aperture=20)
    one, three = (opened(path, "photons", "--threads", n).image(5) for n in (1, 3))
    assert np.array_equal(one, three) and one.any()


def test_where_photons_cannot_be_used_paths_are(tmp_path):
    halved = LAMP.replace("float inputs:intensity", "float inputs:diffuse = 0.5\n    float inputs:intensity")
    path = stage(tmp_path, BALL, halved)
    photons, paths = opened(path, "photons"), opened(path, "paths")
    assert np.array_equal(photons.image(1), paths.image(1))
    told = [w for w in photons.warnings() if "caustics" in str(w)]
    assert len(told) == 1 and "treats diffuse and specular light differently" in str(told[0])
    assert not [w for w in paths.warnings() if "caustics" in str(w)]
