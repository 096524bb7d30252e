# SPDX-License-Identifier: Apache-2.0
"""Corners of UsdLux and of cameras: closed forms, and the same scene said in another way."""
import math

import pytest

from inProcess import patina
from rendering import color, shot
from usda import camera, card, floor, lobe, material, mesh, prim, stage

GREY = 0.5
GROUND = (lobe("grey", "oren_nayar_diffuse_bsdf", color=(GREY,) * 3), floor("floor", 90, bind="grey"))
FROM_ABOVE = {"flat": (0.4, 0.4), "clippingRange": (0.01, 100), "turn": (-90, 0, 0)}
SMALL = ("--camera", "/camera", "--imageWidth", 4, "--imageHeight", 4, "--disableCameraLight")


def seen(folder, *prims, samples=64, flags=()):
    """:returns: pixels (height, width, 3) of a stage's own camera"""
    return color(shot(folder, stage(*prims), *SMALL, "--samples", samples, *flags))


@pytest.mark.parametrize("instanceable", [0, 1])
def test_normalized_mesh_lights_are_as_bright_at_each_place(tmp_path, instanceable):
    """Two lamps 2 above a floor. Each gives intensity / 2^2, less at most twice the square of its half size by its distance:
    5e-4; the lamp farther off gives less than 1e-6 of it."""
    lamp = card("lamp", 0.01, "bool inputs:normalize = 1", "float inputs:intensity = 8", apis=("MeshLightAPI",))
    lamps = [prim("Xform", name, meta=("inherits = </class>", f"instanceable = {bool(instanceable)}".lower()), at=(x, 2, 0),
                  turn=(90, 0, 0), scale=(size, size, size)) for name, x, size in (("a", -50, 1), ("b", 50, 3))]
    for x in (-50, 50):
        found = seen(tmp_path, prim("", "class", lamp, specifier="class"), *lamps, *GROUND,
                     camera(at=(x, 1, 0), **FROM_ABOVE))
        assert found == pytest.approx(GREY / math.pi * 8 / 4, rel=2e-3)


@pytest.mark.parametrize("backend", ["embree", "raster"])
def test_normalized_mesh_lights_look_as_bright_as_their_places_are_small(tmp_path, backend):
    """Intensity / area; the larger lamps are turned by different angles."""
    lamp = card("lamp", 1, "bool inputs:normalize = 1", "float inputs:intensity = 8", apis=("MeshLightAPI",))
    lamps = [prim("Xform", name, meta=("inherits = </class>", "instanceable = true"), at=(x, 0, 0), turn=(0, 0, turn),
                  scale=(size, size, size)) for name, x, size, turn in (("a", -50, 1, 0), ("b", 50, 3, 30), ("c", 100, 3, 77))]
    for x, size in ((-50, 1), (50, 3), (100, 3)):
        found = seen(tmp_path, prim("", "class", lamp, specifier="class"), *lamps, camera(flat=(0.4, 0.4), at=(x, 0, 5)),
                     samples=1, flags=("--backend", backend))
        assert found == pytest.approx(8 / (2 * size) ** 2, rel=1e-4)


def test_a_shadow_fades_over_no_more_than_its_distance(tmp_path):
    """A card 2 above the floor, shadows of 3: two thirds of the light come through, however long the falloff."""
    block = (lobe("black", "oren_nayar_diffuse_bsdf", color=(0, 0, 0)),
             card("block", 1, bind="black", at=(0, 2, 0), turn=(-90, 0, 0)))

    def under(*shadow, prims=block):
        sun = prim("DistantLight", "sun", *shadow, apis=("ShadowAPI",), intensity=1, angle=0, turn=(-90, 0, 0))
        return seen(tmp_path, sun, *GROUND, *prims, camera(at=(0, 1, 0), **FROM_ABOVE), samples=4)

    lit, far = under(prims=()), under("float inputs:shadow:distance = 3", "float inputs:shadow:falloff = 10")
    assert far == pytest.approx(2 / 3 * lit, rel=1e-5)
    assert far == pytest.approx(under("float inputs:shadow:distance = 3", "float inputs:shadow:falloff = 3"), rel=1e-6)


def test_an_orthographic_camera_sees_what_lies_behind_it(tmp_path):
    """Its near plane may lie behind it. The same camera stands before all in the other picture."""
    glow = material("glow", {"surface": ("UsdPreviewSurface", {"diffuseColor": (0, 0, 0), "emissiveColor": (0.5, 0.25, 1)})})
    pictures = [seen(tmp_path, glow, card("near", 0.1, bind="glow", z=3), card("far", 0.1, bind="glow", z=8),
                     camera(flat=(4, 4), at=(0, 0, z), clippingRange=planes), samples=1)
                for z, planes in ((0, (-5, 10)), (6, (1, 16)))]
    assert pictures[0].max() == pytest.approx(1.0) and pictures[0] == pytest.approx(pictures[1], rel=1e-6)


@pytest.mark.parametrize("normalize", [0, 1])
def test_a_point_light_without_a_size_shines_or_says_why(tmp_path, normalize):
    (tmp_path / "s.usda").write_text(stage(
        prim("SphereLight", "lamp", "bool treatAsPoint = 1", f"bool inputs:normalize = {normalize}", radius=0, at=(0, 2, 0)),
        mesh("card", [(-1, 0, 1), (1, 0, 1), (1, 0, -1)]), camera()), encoding="utf-8")
    said = patina("record", tmp_path / "s.usda", tmp_path / "s.exr", *SMALL, "--samples", 1).stderr
    assert ("inputs:radius" in said) != bool(normalize)
