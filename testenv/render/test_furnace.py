# SPDX-License-Identifier: Apache-2.0
"""White furnace: a convex object in a uniform dome shows its directional albedo, and nothing else."""
import functools

import numpy as np
import pytest
import scipy.stats

from inProcess import Stage
from rendering import color, record, scene
import usda

SIZE, SAMPLES = 64, 1024
DIFFUSE = "/World/materials/white/diffuse"


def sphere_cosines(image):
    """Cosine between normal and view of each pixel of the sphere, from the position AOV's stand-in:
    the scene's camera looks along -z at a unit sphere from (0, 0, 5) with a 20/50 window."""
    axis = (np.arange(SIZE) + 0.5) / SIZE * 2 - 1
    x, y = np.meshgrid(axis * 0.2, -axis * 0.2)
    direction = np.stack([x, y, -np.ones_like(x)], -1)
    direction /= np.linalg.norm(direction, axis=-1, keepdims=True)
    b = 5 * direction[..., 2]
    discriminant = b * b - 24
    distance = -b - np.sqrt(np.maximum(discriminant, 0))
    position = np.array([0, 0, 5]) + direction * distance[..., None]
    cosine = -(position * direction).sum(-1)
    return np.where(discriminant > 0, cosine, 0)


@functools.lru_cache(maxsize=None)
def oren_nayar_interreflection(cosine):
    """Mean of max(0, s) / max(mu_i, mu_o) times mu_i over the hemisphere, by quadrature: it knows no roughness."""
    mu = (np.arange(400) + 0.5) / 400
    phi = (np.arange(400) + 0.5) / 400 * 2 * np.pi
    mu, phi = np.meshgrid(mu, phi, indexing="ij")
    s = np.sqrt(1 - mu * mu) * np.sqrt(1 - cosine * cosine) * np.cos(phi)
    return (np.where(s > 0, s / np.maximum(mu, cosine), 0) * mu).mean()


def oren_nayar_albedo(cosine, roughness, color_value):
    """Directional albedo of the qualitative model (Oren and Nayar 1994, eq. 30)."""
    s2 = roughness * roughness
    a, b = 1 - 0.5 * s2 / (s2 + 0.33), 0.45 * s2 / (s2 + 0.09)
    # Pixels that lie mirrored to each other see the same.
    return 2 * color_value * (a * 0.5 + b * oren_nayar_interreflection(round(float(cosine), 12)))


@pytest.mark.parametrize("roughness", [0.0, 0.5, 1.0])
def test_diffuse_sphere_shows_its_albedo(tmp_path, roughness):
    image = tmp_path / "furnace.exr"
    samples = SAMPLES if roughness else 16  # all samples of Lambert's lobe weigh the same
    record(scene("furnace"), image, "--imageWidth", SIZE, "--imageHeight", SIZE, "--samples", samples,
           "--filterRadius", 0.5, "--set", f"{DIFFUSE}.roughness={roughness}")
    cosine = sphere_cosines(None)
    inside = cosine > 0.5
    expected = np.array([oren_nayar_albedo(c, roughness, 0.8) for c in cosine[inside]])
    found = color(image)[inside].mean(axis=-1)
    assert found.mean() == pytest.approx(expected.mean(), rel=1e-3)
    centre = np.argsort(-cosine[inside])[:64]
    assert found[centre].mean() == pytest.approx(expected[centre].mean(), rel=1e-3)


def test_background_is_the_dome(tmp_path):
    image = tmp_path / "furnace.exr"
    record(scene("furnace"), image, "--imageWidth", SIZE, "--imageHeight", SIZE, "--samples", 4)
    assert np.allclose(color(image)[0, :8], 1.0, atol=1e-6)


BUBBLE = usda.stage(
    usda.camera(flat=(6, 6), at=(0, 0, 5)),
    usda.prim("DomeLight", "sky"),
    usda.prim("Sphere", "bubble", bind="soap", radius=0.45),
    usda.material("soap", {
        "surface": ("ND_open_pbr_surface_surfaceshader",
                    {"transmission_weight": 1, "specular_ior": 1, "specular_roughness": 0, "thin_film_weight": 1,
                     "thin_film_thickness": 0.5, "geometry_thin_walled": True})}),
    up="")


def test_a_soap_bubble_shows_no_more_and_no_less_than_the_sky(tmp_path):
    """Its colours are light that went another way. Paths that are reflected inside are rare, and must not count the more."""
    path = tmp_path / "bubble.usda"
    path.write_text(BUBBLE)
    stage = Stage(path, "--imageWidth", 8, "--samples", 256, "--maxDepth", 64, image_height=8)
    found = np.array([stage.image(seed).mean((0, 1)) for seed in range(12)])
    for channel in range(3):  # significance 1e-4 of each, fixed seeds
        assert scipy.stats.ttest_1samp(found[:, channel], 1.0).pvalue > 1e-4, found.mean(0)
    assert found.mean(0) == pytest.approx([1, 1, 1], abs=0.01)
