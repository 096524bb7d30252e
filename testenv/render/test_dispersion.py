# SPDX-License-Identifier: Apache-2.0
"""Glass that disperses, against Snell's law for each wavelength, against energy, and against one wavelength at a time."""
import functools

import numpy as np
import pytest
import scipy.stats
from scipy.spatial.transform import Rotation

from inProcess import Stage
import usda
from usda import camera, material, mesh, prim

SEEDS = range(12)
SIGNIFICANCE = 1e-4  # of each t-test; fixed seeds
D, F, C = 587.56, 486.13, 656.27  # nm
IOR, ABBE, APEX = 1.6, 20.0, np.radians(60)

WHITE = prim("DomeLight", "white")


def stage(path, points, faces, light, x=0, roughness=0.0, scale=1.0, abbe=ABBE):
    """A prism or a slab of glass. :returns: the path"""
    path.write_text(usda.stage(
        camera(flat=(0.1, 0.1), clippingRange=(0.01, 10000), at=(x, 0, 5)),
        mesh("glass", [tuple(f"{c:.9g}" for c in point) for point in points], faces=faces, bind="flint"),
        material("flint", {"surface": ("ND_open_pbr_surface_surfaceshader", {
            "transmission_weight": 1, "specular_ior": 1.6, "specular_roughness": roughness,
            "transmission_dispersion_scale": scale, "transmission_dispersion_abbe_number": abbe})}), light))
    return path


def prism():
    """Corners of a prism through which the ray along -z of wavelength D goes at minimum deviation, bent to +x."""
    inside = np.arcsin(IOR * np.sin(APEX / 2)) - APEX / 2  # half of the deviation
    along, away = np.array([np.sin(inside), -np.cos(inside)]), np.array([np.cos(inside), np.sin(inside)])
    base = 0.9 * np.tan(APEX / 2) * along
    corners = [-away * 0.5, away * 0.4 + base, away * 0.4 - base]
    return [(x, y, z) for y in (-2, 2) for x, z in corners], away


def strip(near, far):
    """A lamp of radiance 1 that faces the origin from 100000 units away, between two angles from -z towards +x."""
    middle, width = (near + far) / 2, 2e5 * np.tan((far - near) / 2)
    x, z = 1e5 * np.sin(middle), -1e5 * np.cos(middle)
    return prim("RectLight", "strip", intensity=1, width=f"{width:.9g}", height=20000, at=f"({x:.9g}, 0, {z:.9g})",
                turn=f"(0, {180 - np.degrees(middle):.9g}, 0)")


def prism_stage(folder, light):
    points, away = prism()
    # The triangle's corners: apex, back, front; the ray enters between apex and front, off the apex.
    faces = [(0, 1, 2), (5, 4, 3), (3, 4, 1, 0), (4, 5, 2, 1), (5, 3, 0, 2)]
    return stage(folder / "prism.usda", points, faces, light, (points[0][0] + points[2][0]) / 2)


def slab_stage(folder, roughness=0.0, scale=1.0, abbe=9.0, light=WHITE, turn=(0.0, 0.0, 0.0)):
    """:param turn: about an axis, by its length in radians"""
    points = [(x, y, z) for z in (-0.5, 0.5) for x, y in ((-8, -8), (8, -8), (8, 8), (-8, 8))]
    points = Rotation.from_rotvec(turn).apply(points)
    faces = [(4, 5, 6, 7), (3, 2, 1, 0), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    return stage(folder / f"slab{roughness}{scale}{abbe}.usda", points, faces, light, 0, roughness, scale, abbe)


def ior(nm):
    """Cauchy's equation through the lines C, d and F."""
    b = (IOR - 1) / ABBE / (F ** -2 - C ** -2)
    return IOR + b * (nm ** -2.0 - D ** -2)


def deviation(n):
    """Of the ray that enters as the one of wavelength d does at its minimum (Snell at both faces), and what passes both."""
    first = np.arcsin(IOR * np.sin(APEX / 2))
    inside = np.arcsin(np.sin(first) / n)
    within = APEX - inside
    out = np.arcsin(n * np.sin(within))
    return first + out - APEX, passed(first, inside, n) * passed(within, out, 1 / n)


def passed(incident, refracted, n):
    """Fresnel's transmittance of unpolarised light."""
    ci, ct = np.cos(incident), np.cos(refracted)
    s, p = (ci - n * ct) / (ci + n * ct), (n * ci - ct) / (n * ci + ct)
    return 1 - (s * s + p * p) / 2


@functools.lru_cache(maxsize=None)
def spectrum():
    """Wavelengths in nm, and what the channels of linear Rec.709 see of each (Wyman, Sloan and Shirley 2013): the negative
    parts cut, each scaled to sum to 1 over bins of 1 nm."""
    def hump(nm, centre, below, above):
        return np.exp(-0.5 * ((nm - centre) / np.where(nm < centre, below, above)) ** 2)

    nm = np.arange(380, 780) + 0.5
    x = 1.056 * hump(nm, 599.8, 37.9, 31.0) + 0.362 * hump(nm, 442.0, 16.0, 26.7) - 0.065 * hump(nm, 501.1, 20.4, 26.2)
    y = 0.821 * hump(nm, 568.8, 46.9, 40.5) + 0.286 * hump(nm, 530.9, 16.3, 31.1)
    z = 1.217 * hump(nm, 437.0, 11.8, 36.0) + 0.681 * hump(nm, 459.0, 26.0, 13.8)
    rgb = np.array([3.2404542 * x - 1.5371385 * y - 0.4985314 * z, 1.8760108 * y - 0.9692660 * x + 0.0415560 * z,
                    0.0556434 * x - 0.2040259 * y + 1.0572252 * z]).clip(0)
    fine = np.repeat(rgb / rgb.sum(1, keepdims=True), 50, axis=1) / 50  # constant over each bin
    return 380 + (np.arange(fine.shape[1]) + 0.5) / 50, fine


def means(path, *arguments, samples=256, seeds=SEEDS, **settings):
    """:returns: the mean colour of an image for each seed"""
    shot = Stage(path, "--imageWidth", 8, "--samples", samples, *arguments, image_height=8)
    return np.array([shot.image(seed, **settings).mean((0, 1)) for seed in seeds])


@pytest.mark.parametrize("band", [(435, 455), (520, 540), (600, 625)])
def test_a_prism_bends_each_wavelength_as_snell_says(tmp_path, band):
    """A strip of light is seen through the prism in the colours of just the wavelengths that are deviated to it."""
    near, far = sorted(deviation(ior(float(nm)))[0] for nm in band)
    nm, rgb = spectrum()
    bent, through = deviation(ior(nm))
    expected = (rgb * through)[:, (bent > near) & (bent < far)].sum(1)
    assert expected.max() > 0.05
    # Two surfaces, without what is reflected inside.
    found = means(prism_stage(tmp_path, strip(near, far)), "--maxDepth", 2)
    for channel in range(3):
        if expected[channel] > 0.0:
            assert scipy.stats.ttest_1samp(found[:, channel], expected[channel]).pvalue > SIGNIFICANCE, (found.mean(0),
                                                                                                         expected)
        assert found[:, channel].mean() == pytest.approx(expected[channel], abs=0.02 * expected.max())


@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (0.3, 0.4, 0.1)])
def test_white_light_stays_white_through_a_slab(tmp_path, turn):
    """All wavelengths leave parallel faces as they came, and an even sky is white from every direction, however it lies."""
    found = means(slab_stage(tmp_path, turn=turn), "--maxDepth", 64)
    for channel in range(3):
        assert scipy.stats.ttest_1samp(found[:, channel], 1.0).pvalue > SIGNIFICANCE, found.mean(0)
    assert found.mean(0) == pytest.approx([1, 1, 1], abs=0.02)


@pytest.mark.parametrize("roughness", [0.0, 0.4, 0.8])
def test_three_wavelengths_have_the_mean_of_one(tmp_path, roughness):
    """Hero wavelengths and their weights change the noise alone: under a lamp that only some directions see, too."""
    lamp = (prim("SphereLight", "lamp", intensity=30, radius=0.7, at=(3, 1, -4))
            + prim("DomeLight", "sky", color=(0.2, 0.3, 0.6)))
    path = slab_stage(tmp_path, roughness, light=lamp)
    hero, single = (means(path, "--maxDepth", 12, methods={"dispersion": method}) for method in ("hero", "single"))
    for channel in range(3):
        assert scipy.stats.ttest_ind(hero[:, channel], single[:, channel], equal_var=False).pvalue > SIGNIFICANCE, \
            (hero.mean(0), single.mean(0))
    if roughness > 0.0:
        assert hero.std(0).sum() < single.std(0).sum()


@pytest.mark.parametrize("scale,abbe", [(0.0, 20.0), (1.0, 0.0)])
def test_without_scale_or_number_nothing_disperses(tmp_path, scale, abbe):
    """The same bits as with the method that bends all light alike."""
    first = means(slab_stage(tmp_path, 0.3, scale, abbe), samples=8, seeds=[1])
    none = means(slab_stage(tmp_path, 0.3, scale, abbe), samples=8, seeds=[1], methods={"dispersion": "none"})
    assert np.array_equal(first, none)
