# SPDX-License-Identifier: Apache-2.0
"""Which rays see a prim, mattes, and catchers of shadows and reflections, against stages without the prim and closed forms."""
import numpy as np
import pytest

from inProcess import needs_opengl
from usdaText import render_text
from usda import camera, mesh, preview, prim

SIZE = 32
CAMERA = camera(flat=(40, 40), clippingRange=(0.1, 100), at=(0, 0, 10))
SUN = prim("DistantLight", "sun", angle=0, intensity=2)
DOME = prim("DomeLight", "sky", intensity=0.7)
MIRROR = preview("mirror", useSpecularWorkflow=1, specularColor=(1, 1, 1), diffuseColor=(0, 0, 0), roughness=0)


def quad(name, z=0.0, *lines, x=(-9.0, 9.0), y=(-9.0, 9.0), marks="", color=(0.5, 0.5, 0.5), bind=""):
    corners = [(x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z)]
    return mesh(name, corners, marks, *lines, bind=bind, color=color)


def render(text, aovs=("color", "alpha"), samples=4, depth=1, **settings):
    """:param depth: bounces; of 1 there is no light between prims"""
    found, warnings, _ = render_text(CAMERA + text, aovs=aovs, width=SIZE, height=SIZE, samples=samples, maxDepth=depth,
                                     rouletteDepth=4096, filterRadius=0.5, **settings)
    assert not warnings, warnings
    return found


CARD = {"x": (-1.0, 1.0), "y": (-1.0, 1.0)}
# Half of the image's side is 2 units: the card covers its middle half.
MIDDLE = np.zeros((SIZE, SIZE), bool)
MIDDLE[SIZE // 4:-SIZE // 4, SIZE // 4:-SIZE // 4] = True


@pytest.mark.parametrize("mark", [
    "bool primvars:patina:visibility:camera = 0", "bool primvars:arnold:visibility:camera = 0",
    'string primvars:karma:object:rendervisibility = "-primary"', "int primvars:ri:attributes:visibility:camera = 0"])
def test_what_the_camera_does_not_see_keeps_its_shadow(mark):
    floor = quad("floor")
    lit = render(floor + SUN)["color"]
    seen = render(floor + SUN + quad("card", 2.0, marks=mark, **CARD))["color"]
    assert lit.min() > 0.1
    assert np.allclose(seen[~MIDDLE], lit[~MIDDLE], rtol=1e-6)
    assert (seen[MIDDLE] == 0.0).all()  # the card's shadow; the sun is no disk


@pytest.mark.parametrize("mark", [
    "bool primvars:patina:visibility:shadow = 0", "bool primvars:arnold:visibility:shadow = 0",
    'string primvars:karma:object:rendervisibility = "-shadow"', "int primvars:ri:attributes:visibility:transmission = 0"])
def test_what_casts_no_shadow_leaves_the_floor_lit(mark, backend="embree"):
    # From the side, so that the card is seen beside its shadow.
    sun = prim("DistantLight", "sun", angle=0, intensity=2, turn=(0, -45, 0))
    floor, card = quad("floor"), quad("card", 1.0, x=(-1.9, -1.0), y=(-1.0, 1.0), marks=mark)
    lit = render(floor + sun, backend=backend)["color"]
    seen = render(floor + card + sun, backend=backend)["color"]
    beside = np.zeros((SIZE, SIZE), bool)
    beside[:, SIZE // 4 + 1:] = True
    assert np.allclose(seen[beside], lit[beside], rtol=1e-5)
    shadowed = render(floor + card.replace(mark, "") + sun, backend=backend)["color"]
    assert not np.allclose(shadowed, seen, rtol=1e-2), "there is a shadow without the mark"


def test_the_rasterizer_shows_no_shadow_either():
    needs_opengl()
    test_what_casts_no_shadow_leaves_the_floor_lit("bool primvars:patina:visibility:shadow = 0", "raster")


def test_marks_are_inherited():
    mark = "bool primvars:patina:visibility:shadow = 0"
    text = quad("floor") + SUN + prim("Xform", "set", mark, quad("card", 1.0, **CARD))
    plain = quad("floor") + SUN + quad("card", 1.0, marks=mark, **CARD)
    assert np.array_equal(render(text)["color"], render(plain)["color"])


@pytest.mark.parametrize("kind, seen", [("diffuse", True), ("specular", False), ("transmission", True)])
def test_a_mirror_shows_what_specular_rays_see(kind, seen):
    """A black card behind the camera stands before the sky that the mirror shows else."""
    back = quad("back", 20.0, marks=f"bool primvars:patina:visibility:{kind} = 0", color=(0.0, 0.0, 0.0))
    image = render(quad("mirror_quad", bind="mirror") + MIRROR + DOME + back, depth=2)["color"]
    assert (image.mean() < 0.35) == seen  # half of the sky's radiance


GLOW = preview("glow", diffuseColor=(0, 0, 0), emissiveColor=(3, 3, 3))


def glow(mark, backend="embree", samples=4):
    """:returns: what a card that glows adds to a floor"""
    card = quad("card", 2.0, 'uniform token orientation = "leftHanded"', marks=mark, bind="glow", **CARD)
    dark = prim("SphereLight", "dark", intensity=0)
    return render(quad("floor") + GLOW + card + dark, samples=samples, backend=backend)["color"][~MIDDLE]


@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_glow_that_scattered_rays_do_not_see_lights_nothing(backend):
    needs_opengl(backend)
    assert glow("", backend).mean() > 0.1
    assert (glow("bool primvars:patina:visibility:indirect = 0", backend) == 0.0).all()


def test_glow_is_as_bright_where_some_rays_do_not_see_it_and_none_of_these_is_there():
    """Without light samples the mean has a standard error of 0.24 % (by eight seeds), with them 0.01 %; the bound is six of
    these."""
    sampled = glow("", samples=256).mean()
    found = glow("bool primvars:patina:visibility:transmission = 0", samples=256).mean()
    assert found == pytest.approx(sampled, rel=0.015)


@pytest.mark.parametrize("mark", ["bool primvars:patina:matte = 1", "bool primvars:patina:holdout = 1",
                                  "bool primvars:arnold:matte = 1",
                                  "int primvars:ri:attributes:Ri:Matte = 1", "int primvars:karma:object:holdoutmode = 1"])
def test_a_matte_is_a_hole_in_the_picture(mark):
    plain = render(quad("floor") + SUN)
    held = render(quad("floor") + SUN + quad("card", 1.0, marks=mark, **CARD))
    for name in ("color", "alpha"):
        assert (held[name][MIDDLE] == 0.0).all()
        assert np.array_equal(held[name][~MIDDLE], plain[name][~MIDDLE])


def test_a_matte_is_seen_in_mirrors_as_it_is():
    text = quad("mirror_quad", bind="mirror") + MIRROR + DOME
    plain = render(text + quad("back", 20.0), depth=2)["color"]
    matte = render(text + quad("back", 20.0, marks="bool primvars:patina:matte = 1"), depth=2)["color"]
    assert plain.mean() > 0.1
    assert np.array_equal(matte, plain)


def test_a_shadow_catcher_is_as_opaque_as_its_light_is_missing():
    """A point of the floor in the card's umbra has alpha 1, one beside it 0; black everywhere."""
    caught = render(quad("floor", marks="bool primvars:patina:shadowCatcher = 1") + SUN +
                    quad("card", 1.0, marks="bool primvars:patina:visibility:camera = 0", **CARD))
    assert (caught["color"] == 0.0).all()
    assert (caught["alpha"][MIDDLE] == 1.0).all()
    assert (caught["alpha"][~MIDDLE] == 0.0).all()


def test_a_shadow_catcher_weighs_lights_by_what_they_give():
    """Two suns of intensities 3 and 1 from above, one of which the card does not shadow: alpha is 3/4 or 1/4 there."""
    one = prim("DistantLight", "one", angle=0, intensity=3)
    other = prim("DistantLight", "other", "bool inputs:shadow:enable = 0", angle=0, intensity=1, apis=("ShadowAPI",))
    samples = 64
    caught = render(quad("floor", marks="bool primvars:patina:shadowCatcher = 1") + one + other +
                    quad("card", 1.0, marks="bool primvars:patina:visibility:camera = 0", **CARD), samples=samples)
    inside = caught["alpha"][MIDDLE]
    # Samples are 0 or 1 with mean 3/4. The choice among 16 candidates has a bias below 1/16; 5 standard errors of all pixels.
    assert abs(inside.mean() - 0.75) < 1.0 / 16.0 + 5.0 * np.sqrt(0.75 * 0.25 / (inside.size * samples))


def test_a_reflection_catcher_is_opaque_where_it_mirrors_a_prim():
    """The card behind the camera covers the middle of the mirror, whose reflectance is 1."""
    mirror = quad("mirror_quad", bind="mirror", marks="bool primvars:patina:reflectionCatcher = 1")
    back = quad("back", 20.0, **CARD)
    caught = render(mirror + MIRROR + DOME + back, samples=64, depth=2)
    plain = render(mirror.replace("reflectionCatcher = 1", "reflectionCatcher = 0") + MIRROR + DOME + back, samples=64, depth=2)
    assert np.allclose(caught["alpha"][MIDDLE], 1.0, atol=1e-5)
    assert (caught["alpha"][~MIDDLE] == 0.0).all() and (caught["color"][~MIDDLE] == 0.0).all()
    a, b = (image["color"][MIDDLE][:, 0] for image in (caught, plain))
    assert abs(a.mean() - b.mean()) < 5.0 * np.sqrt((a.var() + b.var()) / a.size)  # five standard errors: 6e-7
