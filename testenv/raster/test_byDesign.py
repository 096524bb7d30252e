# SPDX-License-Identifier: Apache-2.0
"""Each feature that the rasterizer draws otherwise by design (byDesign.py): it draws what is said there, and that is not
what the path tracer draws. Both by the test of equivalence.py: the rasterizer's image is the path tracer's of the stage
without the feature, with the same margin as everywhere, and differs from the path tracer's image of the stage itself."""
import json
import os

import numpy as np
import pytest

import byDesign
import equivalence
import floorLights
import inProcess
import outOfView
import sameImage
import usda

pytestmark = pytest.mark.usefixtures("opengl")

WIDTH = 32
LAMP = outOfView.EMITTERS["rect"](outOfView.PLACE)
SKY = usda.prim("DomeLight", "sky", "color3f inputs:color = (0.6, 0.8, 1.0)")
WALL = usda.mesh("wall", [(-3, 0, -0.6), (3, 0, -0.6), (3, 3, -0.6), (-3, 3, -0.6)], "rel material:binding = </World/matte>")


def ball(name, height=0.4):
    return usda.prim("Sphere", "ball", f"rel material:binding = </{name}>", radius=0.4, at=(0.2, height, 0.5))


def write(folder, name, contents, materials="", lights=LAMP):
    return floorLights.write(folder, outOfView.STAGE % {"block": contents, "emitter": lights} + materials, name)


def compare(drawn, traced, depth, *arguments):
    """:returns: the Verdict of the rasterizer's images of one stage and the path tracer's of another"""
    return sameImage.decide(drawn, traced, *arguments, depth=depth, width=WIDTH)[0]


def same(*arguments):
    verdict = compare(*arguments)
    assert not verdict.differs.any() and not verdict.open, verdict.text()


def differences(*arguments):
    """:returns: the differences, in parts of the value, of tiles that surely differ; others as 0"""
    verdict = compare(*arguments)
    return np.where(verdict.differs, verdict.difference, 0.0)


def test_light_between_surfaces_is_left_out(tmp_path):
    stage = write(tmp_path, "wall", WALL)
    same(stage, stage, 1)
    found = differences(stage, stage, 16)
    assert found.min() < -0.03 and found.max() <= 0.0


def test_mirrors_show_the_environment(tmp_path):
    """A mirroring ball over a floor: of the floor it shows nothing."""
    steel = usda.lobe("steel", "conductor_bsdf", roughness=(0, 0))
    stage = write(tmp_path, "mirror", ball("steel"), steel, SKY)
    same(stage, stage, 1)
    found = differences(stage, stage, 16)
    assert found.min() < -0.1


def test_what_hides_the_sky_from_mirrors_is_blurred(tmp_path):
    """A mirroring floor, in whose middle a far board's upper edge shows: dark beyond it, the sky before it. The rasterizer
    knows what hides the sky by cells 17 degrees wide, so that the board takes light before its edge."""
    steel = usda.lobe("steel", "conductor_bsdf", roughness=(0.02, 0.02))
    board = usda.mesh("board", [(-12, 0, -9), (12, 0, -9), (12, 3.6, -9), (-12, 3.6, -9), (-12, 0.01, -8.9), (-12, 0.01, 8),
                       (12, 0.01, 8), (12, 0.01, -8.9)],
                      "rel material:binding = </steel>", faces=[(0, 1, 2, 3), (4, 5, 6, 7)])
    power = equivalence.Power(widest=1.0, samples=16, traced=64, looks=(12,))
    before = [images[:, 9:].mean(axis=(1, 2, 3))[:, None]  # one number: all pixels of a pass are off alike
              for images in sameImage.decide(write(tmp_path, "board", board, steel, SKY), width=WIDTH, power=power)[1:]]
    verdict = equivalence.compare(*before, power)
    assert verdict.differs.all() and verdict.difference < 0.0, (verdict.difference, verdict.half)


def test_glass_shows_what_is_behind(tmp_path):
    """A pane over the whole floor of the view: direct light alone ends there, the rasterizer goes on behind it."""
    pane = usda.lobe("pane", "dielectric_bsdf", ior=1.0001, roughness=(0, 0), scatter_mode="RT")
    glass = usda.prim("Cube", "pane", "rel material:binding = </pane>", at=(0, 0.8, 2.2), scale=(2, 2, 0.01))
    without, with_pane = write(tmp_path, "without", ""), write(tmp_path, "pane", glass, pane)
    same(with_pane, without, 1)
    assert differences(with_pane, with_pane, 1).max() > 0.5


def test_subsurface_shows_as_diffuse(tmp_path):
    wax = usda.lobe("thing", "subsurface_bsdf", color=(0.8, 0.5, 0.3), radius=(0.3, 0.2, 0.1))
    matte = usda.lobe("thing", "oren_nayar_diffuse_bsdf", color=(0.8, 0.5, 0.3))
    scattering = write(tmp_path, "wax", ball("thing"), wax)
    same(scattering, write(tmp_path, "matte", ball("thing"), matte), 1)
    assert np.abs(differences(scattering, scattering, 16)).max() > 0.1


def test_volumes_cast_no_shadow(tmp_path):
    """Somewhere on the floor smoke takes a twentieth of the traced light, and the rasterizer's floor is as without smoke."""
    stage, clear = inProcess.scene("volume"), str(tmp_path / "clear.usda")
    with open(clear, "w", encoding="utf-8") as out:
        gone = usda.prim("", "puff", meta=("active = false",), specifier="over")
        out.write(usda.stage(usda.prim("", "World", gone, specifier="over"), up="", subLayers=f"[@{stage}@]"))
    smoke = inProcess.Stage(stage, "-w", WIDTH, "--samples", 1)
    smoke.image()
    if smoke.warnings():
        pytest.skip(smoke.warnings()[0])  # a build without OpenVDB
    shaded, drawn = differences(clear, stage, 16), compare(stage, clear, 1)
    assert ((shaded > 0.05) & ~drawn.differs & (drawn.half < equivalence.FULL.widest)).any(), drawn.text()


def test_lights_do_not_move_while_the_shutter_is_open(tmp_path):
    """They are where they are in the middle of it."""
    moving, still = (outOfView.EMITTERS["rect"]({**outOfView.PLACE, "at": at})
                     for at in ({0: (-0.4, 2.2, 0.2), 1: (1.6, 2.2, 0.2)}, (0.6, 2.2, 0.2)))

    def stage(name, light):
        text = outOfView.STAGE.replace("float focalLength = 35", "double shutter:close = 1\n        float focalLength = 35")
        return floorLights.write(tmp_path, text % {"block": outOfView.BLOCK, "emitter": light}, name)

    moves = stage("moving", moving)
    same(moves, stage("still", still), 1, "--frames", "0")
    assert np.abs(differences(moves, moves, 1, "--frames", "0")).max() > 0.1


OPEN_BLOCK = usda.mesh("block",
                       [(0.1, 0.8, 0.4), (0.9, 0.8, 0.4), (0.9, 0.8, -0.4), (0.1, 0.8, -0.4), (0.1, 0, 0.4), (0.9, 0, 0.4),
                        (0.1, 0, -0.4)],
                       faces=[(0, 1, 2, 3), (4, 5, 1, 0), (4, 0, 3, 6)], color=(0.6, 0.3, 0.2))


def test_shadows_of_limited_distance_know_the_near_side(tmp_path):
    """As if a block had only its three sides that face the light; its other sides are near enough to the floor to hide it."""
    lamp = floorLights.light("SphereLight", "float inputs:shadow:distance = 0.7", apis=("ShadowAPI",), intensity=40,
                             radius=0.05)
    blocks = {"closed": floorLights.BLOCK, "open": OPEN_BLOCK}
    paths = []
    for name, block in blocks.items():
        (tmp_path / name).mkdir()
        paths.append(floorLights.write(tmp_path / name, floorLights.world(floorLights.FLOOR, block, lamp)))
    whole = paths[0]
    same(*paths, 1, "--disableCameraLight")
    assert differences(whole, whole, 1, "--disableCameraLight").max() > 0.05


CORNERS = [(x, y, z) for x in (-2, 2) for y in (0, 3) for z in (-2, 2)]
SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
ROOM = usda.mesh("walls", [CORNERS[i] for side in SIDES for i in side], faces=[range(i, i + 4) for i in range(0, 24, 4)])


def test_a_closed_room_of_thin_walls_is_dark_but_for_its_seams(tmp_path):
    stage = tmp_path / "room.usda"
    camera = usda.camera(clippingRange=(0.01, 100), focalLength=15, at=(-0.5, 1.5, 1.9))
    stage.write_text(usda.stage(usda.prim("Xform", "World", ROOM, SKY, camera)))
    shown = {width: inProcess.Stage(str(stage), "--backend", "raster", "--samples", 16, "-w", width).image(0).mean()
             for width in (48, 192)}
    assert inProcess.Stage(str(stage), "--samples", 4, "-w", 48).image(0).max() == 0.0
    assert shown[48] > 0.0, "no light is left along the seams: take this feature out"
    # Maps have as many texels as the image has pixels, so the strip is a quarter as wide; half is allowed.
    assert shown[192] < 0.5 * shown[48]


@pytest.mark.parametrize("method, filtered", [("filtered", True), ("harmonics", False)])
def test_harmonics_know_no_light_filters(method, filtered, tmp_path):
    prims = (floorLights.light("DomeLight", "rel light:filters = </World/filter>", "asset inputs:texture:file = @./image.exr@",
                               place={})
             + usda.prim("LightFilter", "filter", 'uniform token lightFilter:shaderId = "PxrIntMultLightFilter"',
                         "float inputs:intensity = 0.25"))
    images = []
    bare = prims.replace("rel light:filters", "custom rel no")
    for name, contents in (("filtered", floorLights.STAGE % prims), ("bare", floorLights.STAGE % bare)):
        image, said = tmp_path / f"{name}.exr", tmp_path / f"{name}.json"
        inProcess.record(floorLights.write(tmp_path, contents), image, "--backend", "raster", "--imageWidth", 16,
                         "--samples", 2, "--method", f"domeLight={method}", f"--json={said}")
        images.append(inProcess.pixels(image)[8:])  # the floor, without the sky
        warned = {w["prim"] for w in json.loads(said.read_text())["warnings"]
                  if "do not change what the method" in w["message"]}
        assert warned == (set() if filtered or name == "bare" else {"/World/light"})
    share = images[0].mean() / images[1].mean()
    if filtered:
        assert share == pytest.approx(0.25, rel=1e-3)
    else:  # diffuse lobes are lit by the whole sky, and what is left of the others by samples, which filters change
        assert 0.5 < share < 1.001


def _as_without(tmp_path, name, feature, plain, words):
    """The rasterizer draws a test scene as the same stage without a feature, and its warnings have these words."""
    with open(inProcess.scene(name), encoding="utf-8") as file:
        text = file.read().replace("@textures/", "@" + os.path.join(inProcess.SCENES, "textures/"))
    assert feature in text
    images = []
    for kind, contents in (("whole", text), ("plain", text.replace(feature, plain))):
        stage = tmp_path / f"{kind}.usda"
        stage.write_text(contents)
        drawn = inProcess.Stage(stage, "--backend", "raster", "--imageWidth", 16, "--samples", 1)
        images.append(drawn.image(0))
        assert any(words in warning for warning in drawn.warnings()) == (kind == "whole")
    assert np.array_equal(*images)


def test_cameras_of_other_projections_are_plain(tmp_path):
    _as_without(tmp_path, "fisheye", "token patina:projection", "custom token no", "rasterizer")


def test_catchers_are_plain(tmp_path):
    _as_without(tmp_path, "catchers", "Catcher = 1", "Catcher = 0", "catcher")


def test_every_feature_has_its_test():
    for name, feature in byDesign.FEATURES.items():
        file, _, function = feature.test.partition("::")
        with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), file), encoding="utf-8") as text:
            assert f"def {function}(" in text.read(), name
        assert feature.instead, name
