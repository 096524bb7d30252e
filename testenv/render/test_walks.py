# SPDX-License-Identifier: Apache-2.0
"""Methods that walk at random, as the path tracer renders them: values from light samples and samples of the material
are weighed against each other by densities that are estimates, and nothing may come out brighter or darker for it."""
import numpy as np
import pytest
from scipy import stats

from rendering import color, patina, record
import usda

SIZE, SAMPLES = 24, 128
DOME = usda.prim("DomeLight", "dome", intensity=1)
SUN = usda.prim("DistantLight", "sun", angle=0, intensity=1)


def metal(ior):
    return {"surface": ("ND_surface", {"bsdf": "<metal>"}), "metal": ("ND_conductor_bsdf", {
        "ior": (ior, ior, ior), "extinction": (2.3, 2.3, 2.3), "roughness": (0.8, 0.8)})}


def coated(alpha):
    return {"surface": ("ND_surface", {"bsdf": "<layers>"}), "layers": ("ND_layer_bsdf", {"top": "<coat>", "base": "<base>"}),
            "coat": ("ND_dielectric_bsdf", {"roughness": (alpha, alpha)}),
            "base": ("ND_oren_nayar_diffuse_bsdf", {"color": (1, 1, 1)})}


def stage(folder, nodes, light=DOME):
    """A sphere that fills most of the picture."""
    path = folder / "stage.usda"
    path.write_text(usda.stage(usda.camera(lens=(50, 20, 20), clippingRange=(0.01, 10000), at=(0, 0, 5)), light,
                               usda.prim("Sphere", "ball", radius=1, bind="white"), usda.material("white", nodes)))
    return path


def render(path, folder, method, samples=SAMPLES):
    """:returns: mean over the middle of the sphere, and its standard error"""
    image = folder / "image.exr"
    record(path, image, "--imageWidth", SIZE, "--imageHeight", SIZE, "--samples", samples, "--filterRadius", 0.5,
           "--method", method)
    middle = slice(SIZE // 3, -(SIZE // 3))
    found = color(image)[middle, middle, 0]
    return found.mean(), found.std() / np.sqrt(found.size)


@pytest.mark.parametrize("nodes, method", [
    (metal(0), "energyCompensation=randomWalk"), (coated(0), "layering=positionFree"), (coated(0.3), "layering=positionFree")])
def test_white_under_a_white_dome_is_white(tmp_path, nodes, method):
    mean, error = render(stage(tmp_path, nodes), tmp_path, method)
    assert abs(mean - 1.0) < 4.0 * error + 2e-3


def test_light_samples_alone_find_the_mean_value(tmp_path):
    """A sun of no width is found by light samples only: the sphere's middle shows f, which `bsdf eval` prints as the mean of
    256 walks. Welch's test of 16 images, seeds 0 to 15, against 128 directions within 0.013 of the normal, each of which has
    walks of its own: significance 0.001, and a difference of 4 % would be found."""
    path = stage(tmp_path, metal(1.1), SUN)
    image = tmp_path / "image.exr"
    method = ("--method", "energyCompensation=randomWalk")

    def drawn(seed):
        record(path, image, "--imageWidth", 5, "--imageHeight", 5, "--samples", 2048, "--filterRadius", 0.05, "--seed", seed,
               *method)
        return color(image)[2, 2, 0]

    def value(step):
        return float(patina("bsdf", "eval", path, "--wo", "0,0,1", "--wi", f"{1e-4 * step},0,1", *method).stdout.split()[1])

    images, values = [drawn(seed) for seed in range(16)], [value(step) for step in range(128)]
    error = np.hypot(*(np.std(x, ddof=1) / np.sqrt(len(x)) for x in (images, values)))
    assert error < 0.01 * np.mean(values)
    assert stats.ttest_ind(images, values, equal_var=False).pvalue > 0.001
