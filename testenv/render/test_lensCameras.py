# SPDX-License-Identifier: Apache-2.0
"""Cameras beyond perspective and orthographic, end to end, against closed forms. Samples lie in the middles of pixels: a filter
of radius 0."""
import numpy as np
import pytest

from inProcess import without_opengl
from usdaText import render_text
import usda

AROUND = (usda.prim("Sphere", "around", radius=10, color=(1, 1, 1))
          + usda.prim("DomeLight", "sky", intensity=1))


def dome(image):
    return usda.prim("DomeLight", "sky", f"asset inputs:texture:file = @{image}@", 'token inputs:texture:format = "latlong"')


def camera(*lines, **values):
    return usda.camera(*lines, name="c", clippingRange=(0.01, 1000), horizontalAperture=20, verticalAperture=20, **values)


def render(text, width, height, aovs=("color", "alpha"), backend="embree", **settings):
    found, warnings, _ = render_text(text, aovs, backend, width=width, height=height,
                                     **{"samples": 1, "filterRadius": 0.0, **settings})
    return found, warnings


def write_map(path, places):
    import _patina

    pixels = np.concatenate([places, np.zeros_like(places[..., :1])], axis=2)
    _patina.write_image(str(path), pixels.astype(np.float32), options={"half": False})


def identity(width, height):
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, 1.0 - (np.arange(height) + 0.5) / height)
    return np.stack([u, v], axis=2)


@pytest.fixture(scope="module")
def sky(tmp_path_factory):
    """:returns: an image whose colours tell directions, and its texels"""
    import _patina

    path = tmp_path_factory.mktemp("sky") / "sky.exr"
    u, v = identity(64, 32)[..., 0], identity(64, 32)[..., 1]
    texels = np.stack([0.5 + 0.4 * np.sin(2 * np.pi * u), 0.2 + v, 0.5 + 0.4 * np.cos(2 * np.pi * u)], axis=2)
    _patina.write_image(str(path), texels.astype(np.float32), options={"half": False})
    return path, texels


def test_a_spherical_camera_gives_the_domes_image_back(sky):
    path, texels = sky
    text = dome(path) + camera('token patina:projection = "spherical"', turn=(0, 180, 0))  # a dome's middle is +z
    found, warnings = render(text, 64, 32)
    assert not warnings
    # Directions of 32 bits move a place by less than a thousandth of a texel.
    assert found["color"] == pytest.approx(texels, abs=1e-3)
    arnold = render(text.replace('token patina:projection = "spherical"', 'string primvars:arnold:camera = "spherical_camera"'),
                    64, 32)[0]
    assert (arnold["color"] == found["color"]).all()


def test_a_fisheye_shows_the_dome_by_angle(sky):
    path, texels = sky
    text = dome(path) + camera('token patina:projection = "fisheye"', "float patina:fieldOfView = 180", turn=(0, 180, 0))
    found, _ = render(text, 40, 40)
    # Along the horizon the angle is the distance from the middle, and green is the latitude, 0.2 + 1 / 2.
    x = (np.arange(40) + 0.5) / 20 - 1
    u = 0.5 + 0.25 * x
    row = found["color"][19:21].mean(axis=0)
    # The rows beside the horizon are a fortieth of 180 degrees high: cosines are 1 to 1e-3; texels are 1/64 wide.
    assert row[1:-1, 0] == pytest.approx((0.5 + 0.4 * np.sin(2 * np.pi * u))[1:-1], abs=5e-3)
    assert row[1:-1, 1] == pytest.approx(0.7, abs=2e-3)


def test_beyond_the_circle_of_a_fisheye_nothing_is():
    text = AROUND + camera('token patina:projection = "fisheyeEquisolid"', "float patina:fieldOfView = 220")
    found, warnings = render(text, 32, 32, ("color", "alpha", "depth", "deviceDepth", "diffuse"))
    assert not warnings
    x, y = np.meshgrid((np.arange(32) + 0.5) / 16 - 1, (np.arange(32) + 0.5) / 16 - 1)
    inside = x * x + y * y <= 1.0
    assert (found["alpha"] == inside).all()
    assert (found["color"][~inside] == 0).all() and (found["diffuse"][~inside] == 0).all()
    assert (found["depth"][~inside] == np.float32(1e10)).all()
    # Distances count from the camera; a sphere's facets are within two percent of it.
    assert found["depth"][inside] == pytest.approx(10.0, rel=0.02)
    assert (found["deviceDepth"][inside] > 0.99).all()


def test_maps(tmp_path, sky):
    plain = dome(sky[0])
    lens = ("float fStop = 2", "float focusDistance = 3")
    write_map(tmp_path / "identity.exr", identity(17, 9))
    write_map(tmp_path / "shifted.exr", identity(32, 32) + [0.5, 0.0])
    without, _ = render(plain + camera(*lens), 32, 32, filterRadius=1.0)
    same, warnings = render(plain + camera(*lens, f"asset patina:distortionMap = @{tmp_path}/identity.exr@"), 32, 32,
                            filterRadius=1.0)
    assert not warnings and (same["color"] == without["color"]).all()
    sharp, _ = render(plain + camera(), 32, 32)
    shifted, _ = render(plain + camera(f"asset patina:distortionMap = @{tmp_path}/shifted.exr@"), 32, 32)
    assert shifted["color"][:, :16] == pytest.approx(sharp["color"][:, 16:], abs=1e-5)


def test_eyes_in_one_image():
    """A card between both eyes' views: its outlines are apart by the closed form's pixels."""
    text = usda.card("card", (0.5, 9), z=-4)
    lens = ("float focalLength = 20", "float patina:interocularDistance = 0.4", "float patina:convergenceDistance = 8")
    both, warnings = render(text + camera('token patina:stereo = "sideBySide"', *lens), 400, 8, ("alpha",))
    assert not warnings
    # The film is 1 wide at distance 1 and has 200 pixels: 0.4 * (1 / 4 - 1 / 8) of that between the eyes.
    middles = []
    for eye in (both["alpha"][4, :200], both["alpha"][4, 200:]):
        assert eye.sum() == pytest.approx(50, abs=1)  # 1 / 4 of the film
        middles.append((eye * (np.arange(200) + 0.5)).sum() / eye.sum())
    assert middles[0] - middles[1] == pytest.approx(200 * 0.4 * (1 / 4 - 1 / 8), abs=1)
    for name, eye in (("left", both["alpha"][:, :200]), ("right", both["alpha"][:, 200:])):
        one, _ = render(text + camera(f'token patina:stereo = "{name}"', *lens), 200, 8, ("alpha",))
        assert (one["alpha"] == eye).all()


BAD = [("int patina:apertureBlades = 1000000000", "patina:apertureBlades"),
       ("float patina:fieldOfView = 0", "patina:fieldOfView"),
       ("float primvars:arnold:aperture_aspect_ratio = nan", "arnold:aperture_aspect_ratio"),
       ("float patina:convergenceDistance = 0", "patina:convergenceDistance"),
       ('token patina:projection = "panini"', "patina:projection"),
       ("float3 patina:distortionK1 = (1, 2, 3)", "patina:distortionK1"),
       ("asset patina:distortionMap = @no/such/map.exr@", "patina:distortionMap")]


@pytest.mark.parametrize("line, name", BAD)
def test_what_a_camera_does_not_take_is_told(sky, line, name):
    plain = dome(sky[0])
    found, warnings = render(plain + camera(line), 8, 8)
    assert len(warnings) == 1 and warnings[0].startswith(f"/c {name}: "), warnings
    assert (found["color"] == render(plain + camera(), 8, 8)[0]["color"]).all()


@pytest.mark.skipif(bool(without_opengl()), reason="no OpenGL")
def test_the_rasterizer_tells_what_it_does_not_draw(sky):
    lines = ['token patina:projection = "fisheye"', "float patina:distortionK1 = 0.1"]
    plain = dome(sky[0])
    found, warnings = render(plain + camera(*lines), 8, 8, backend="raster")
    assert sorted(w.split(":", 2)[1] for w in warnings) == ["distortionK1", "projection"]
    assert all(w.startswith("/c patina:") and "rasterizer" in w for w in warnings)
    assert (found["color"] == render(plain + camera(), 8, 8, backend="raster")[0]["color"]).all()


@pytest.mark.skipif(bool(without_opengl()), reason="no OpenGL")
def test_the_rasterizer_draws_one_eye():
    text = usda.prim("Sphere", "s", radius=1, at=(0, 0, -5)) + usda.prim("DistantLight", "sun")
    eye = camera('token patina:stereo = "right"', "float focalLength = 20", "float patina:interocularDistance = 1",
                 "float patina:convergenceDistance = 20")
    traced = render(text + eye, 48, 48, ("alpha",))[0]["alpha"]
    drawn, warnings = render(text + eye, 48, 48, ("alpha",), backend="raster")
    assert not warnings
    columns = np.arange(48) + 0.5
    # Samples in the same places see the same sphere, but for its outline's facets.
    assert (traced * columns).sum() / traced.sum() == pytest.approx(
        (drawn["alpha"] * columns).sum() / drawn["alpha"].sum(), abs=0.2)
    assert (traced * columns).sum() / traced.sum() == pytest.approx(24 - 48 * 0.5 * (1 / 5 - 1 / 20), abs=0.3)
