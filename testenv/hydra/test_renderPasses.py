# SPDX-License-Identifier: Apache-2.0
"""Render passes and back plates in usdrecord: passes draw the picture of the command line, in all bits; plates are where and
what they are there."""
import numpy as np
import pytest

import hydraBuild
from glowingTiles import COLORS, WIDTH, looks, pictures, tile
import usda

pytestmark = pytest.mark.skipif(not hydraBuild.missing() and not hydraBuild.has_usdrecord(),
                                reason="this OpenUSD has no usdrecord")
# The four squares, from left to right: two plain ones, one of a native and one of a point instance.
def stage_of(*lines):
    """:param lines: of the pass"""
    return usda.stage(
        usda.camera(flat=(200, 50), clippingRange=(1, 100), at=(0, 0, 20)),
        usda.prim("Xform", "World",
            usda.prim("Xform", "a", tile("a"), at=(-7.5, 0, 0)),
            usda.prim("Xform", "b", tile("b"), at=(-2.5, 0, 0)),
            usda.prim("", "c", meta=("inherits = </asset>", "instanceable = true"), at=(2.5, 0, 0)),
            usda.prim("PointInstancer", "d", "rel prototypes = </World/d/tile>", tile("d"), protoIndices=[0],
                      positions=[(7.5, 0, 0)]),
            looks()),
        usda.prim("Xform", "asset", tile("c"), specifier="class"),
        usda.prim("Scope", "Render",
            usda.prim("RenderSettings", "main", "uniform int2 resolution = (40, 10)", "int patina:samples = 4"),
            usda.prim("RenderPass", "pass", "rel renderSource = </Render/main>", *lines,
                      apis=("CollectionAPI:prune", "CollectionAPI:matte"))),
        up="")


def shown(picture):
    """:returns: names of the squares in whose middle their colour is"""
    row = picture[picture.shape[0] // 2]
    return "".join(name for i, (name, rgb) in enumerate(COLORS.items())
                   if np.allclose(row[WIDTH * (2 * i + 1) // 8][:3], rgb, atol=0.02))


@pytest.mark.parametrize("lines, squares", [
    ("", "abcd"),
    ("rel collection:prune:includes = </World/a>", "bcd"),
    ("rel collection:renderVisibility:excludes = [</World/b>, </World/c>]", "ad"),
    ("rel collection:renderVisibility:excludes = </World/d>", "abc"),
    ("uniform bool collection:renderVisibility:includeRoot = 0\nrel collection:renderVisibility:includes = </World/c>", "c"),
    ("uniform bool collection:renderVisibility:includeRoot = 0\nrel collection:renderVisibility:includes = </World/d>", "d"),
    ("rel collection:cameraVisibility:excludes = </World/a>", "bcd"),
    ("rel collection:matte:includes = </World/b>", "acd"), ("rel collection:matte:includes = </World/c/tile>", "abd"),
    ("rel collection:prune:includes = </World/c/tile>", "abd")])
def test_a_pass_draws_what_its_collections_say(tmp_path, lines, squares):
    hydraBuild.skip_before(2411, "scene indices do not tell the active pass")
    stage = tmp_path / "pass.usda"
    stage.write_text(stage_of(lines), encoding="utf-8")
    hydra, record = pictures(stage, tmp_path, "--camera", "camera", "--renderPassPrimPath", "/Render/pass")
    assert shown(record) == squares
    assert shown(hydra) == squares
    assert np.array_equal(hydra, record), "alpha of mattes too"


def plate(seen, *lines):
    """:param lines: of the camera that has the plate"""
    frame = {"focalLength": 50, "horizontalAperture": 20, "verticalAperture": 10, "clippingRange": (1, 100)}
    return usda.stage(
        usda.camera("asset backPlate:sky:image = @sky.exr@", f'token backPlate:sky:plateVisibility = "{seen}"', *lines,
                    name="main", apis=("BackPlateAPI:sky",), focusDistance=30, **frame),
        usda.camera(name="other", **frame),
        usda.prim("Xform", "mesh", usda.prim("Scope", "material")),  # names that parts of plates have, too
        usda.prim("Sphere", "ball", radius=2, at=(0, 0, -20)),
        up="")


@pytest.mark.parametrize("seen, camera, there", [("solo", "main", True), ("solo", "other", False), ("all", "other", True),
                                                 ("mute", "main", False)])
def test_back_plates_are_pictures_behind_the_scene(tmp_path, seen, camera, there):
    hydraBuild.skip_before(2608, "Hydra knows no back plates")
    import _patina

    sky = np.zeros((4, 8, 3), np.float32)
    sky[:, :4], sky[:, 4:] = (0.8, 0.1, 0.1), (0.1, 0.1, 0.8)
    _patina.write_image(str(tmp_path / "sky.exr"), sky)
    stage = tmp_path / "plate.usda"
    stage.write_text(plate(seen), encoding="utf-8")
    hydra, record = pictures(stage, tmp_path, "--camera", camera)
    for picture in (hydra, record):
        left, right = picture[2, 2, :3], picture[2, -3, :3]
        assert np.allclose(left, (0.8, 0.1, 0.1) if there else 0.0, atol=0.01)
        assert np.allclose(right, (0.1, 0.1, 0.8) if there else 0.0, atol=0.01)
        # The ball is lit by nothing: plates are no lights.
        assert np.allclose(picture[picture.shape[0] // 2, WIDTH // 2, :3], 0.0, atol=1e-4)


@pytest.mark.parametrize("lines, channels", [
    ("color3f backPlate:sky:luma:gain = (0.5, 1, 2)\ncolor3f backPlate:sky:luma:lift = (0.1, 0, 0.2)", 0),
    ("color3f backPlate:sky:luma:gain = (0.5, 1, 2)\ncolor3f backPlate:sky:luma:gamma = (2, 1, 0.5)", 0),
    ("asset backPlate:sky:alpha:image = @alpha.exr@", 1), ("asset backPlate:sky:alpha:image = @alpha.exr@", 2),
    ("asset backPlate:sky:alpha:image = @alpha.exr@", 4)])
def test_back_plates_are_graded_and_have_an_alpha(tmp_path, lines, channels):
    hydraBuild.skip_before(2608, "Hydra knows no back plates")
    import _patina

    sky, alpha = np.full((4, 8, 3), 0.4, np.float32), np.full((4, 8, max(channels, 1)), 0.9, np.float32)
    alpha[..., -1] = 0.25
    _patina.write_image(str(tmp_path / "sky.exr"), sky)
    _patina.write_image(str(tmp_path / "alpha.exr"), alpha)
    stage = tmp_path / "plate.usda"
    stage.write_text(plate("all", lines), encoding="utf-8")
    hydra, record = pictures(stage, tmp_path, "--camera", "main")
    if channels:  # which is met by chance: 64 samples a pixel there, 4 here. Five standard errors, 6e-7
        bound = 5.0 * np.sqrt(0.25 * 0.75 * (1 / 64 + 1 / 4) / hydra[..., 3].size)
        assert abs(hydra[..., 3].mean() - record[..., 3].mean()) < bound
    else:  # usdrecord writes halves
        np.testing.assert_allclose(hydra[3, 3, :3], record[3, 3, :3], rtol=2.0**-11)
