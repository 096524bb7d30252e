# SPDX-License-Identifier: Apache-2.0
"""Levels of detail of UsdLod in usdrecord: those of the command line; instances of a prototype share that of the nearest."""
import numpy as np
import pytest

import hydraBuild
from glowingTiles import COLORS, WIDTH, looks, pictures, tile
from rendering import pixels
import usda

pytestmark = pytest.mark.skipif(not hydraBuild.missing() and not hydraBuild.has_usdrecord(),
                                reason="this OpenUSD has no usdrecord")
DISTANCE = usda.prim("LODDistanceHeuristic", "by", 'uniform token lod:domain = "imaging"',
                     "uniform float[] thresholds = [25, 50]")
SIZE = usda.prim("LODScreenSizeHeuristic", "by", 'uniform token lod:domain = "imaging"',
                 "uniform float[] thresholds = [0.08, 0.03]", "float3[] extent = [(-2, -2, 0), (2, 2, 0)]")
BY = "rel lod:heuristics = </by>"


def root(name, *lines, beside=None, **more):
    """Level a is 4 units wide, as are b, which other renderers are told not to show, and c. b holds a square that nobody shows.
    :param beside: place of each level"""
    beside = beside or {}
    hidden = usda.prim("Xform", "hidden", tile("d"), visibility="invisible", at=(0, 0, 0.5))
    return usda.prim("Xform", name, *lines, usda.prim("Xform", "a", tile("a")),
                     usda.prim("Xform", "b", tile("b"), hidden, visibility="invisible", at=beside.get("b")),
                     usda.prim("Xform", "c", tile("c"), at=beside.get("c")), apis=("LODRootAPI", "LODOverrideAPI"), **more)


def stage(tmp_path, distances, *parts):
    """The camera is so far away in frame 1, 2 and so on; of one distance it stands still. The frame is half as high as wide, so
    that it is no square, and one unit beside the middle, so that the tile is not in the middle."""
    places = {i: (0, 0, z) for i, z in enumerate(distances, 1)}
    path = tmp_path / "levels.usda"
    path.write_text(usda.stage(
        usda.prim("Scope", "Render", usda.prim("RenderSettings", "main", "int patina:samples = 4")),
        usda.camera(lens=(40, 40, 20), clippingRange=(1, 1000), at=places if len(places) > 1 else places[1]),
        usda.prim("Xform", "World", looks()), *parts,
        up="", startTimeCode=1, endTimeCode=3, renderSettingsPrimPath="/Render/main"), encoding="utf-8")
    return path


def levels(picture):
    """:returns: of which levels there is a pixel of their colour; levels that are far cover none whole"""
    seen = picture[picture[..., 3] > 0.3]
    seen = seen[:, :3] / seen[:, 3:]
    return "".join(name for name, rgb in COLORS.items() if np.isclose(seen, rgb, atol=0.01).all(axis=-1).any())


def both(tmp_path, *parts, distance=20):
    hydraBuild.skip_before(2608, "there is no UsdLod")
    hydra, record = pictures(stage(tmp_path, (distance,), *parts), tmp_path, "--camera", "camera")
    return hydra, record


@pytest.mark.parametrize("heuristic", [DISTANCE, SIZE])
@pytest.mark.parametrize("distance, shown", [(20, "a"), (30, "b"), (60, "c")])
def test_the_heuristic_chooses(tmp_path, heuristic, distance, shown):
    hydra, record = both(tmp_path, heuristic, root("root", BY), distance=distance)
    assert levels(record) == shown
    assert np.array_equal(hydra, record)


@pytest.mark.parametrize("lines, shown", [
    ((BY, 'token lod:override:mode = "indexedLOD"', "float lod:override:index = 1.2"), "b"),
    ((BY, 'token lod:override:mode = "noLOD"'), ""), ((BY, 'token lod:override:mode = "allLOD"'), "abc"),
    (("rel lod:heuristics = []", "int lod:default:index = 7"), "c")])
def test_overrides_and_the_default(tmp_path, lines, shown):
    beside = {"b": (4, 0, 0), "c": (-4, 0, 0)} if shown == "abc" else {}  # one beside the other
    hydra, record = both(tmp_path, DISTANCE, root("root", *lines, beside=beside))
    assert levels(record) == shown
    assert np.array_equal(hydra, record)


@pytest.mark.parametrize("distances, shown", [((20, 60, 60), "aca"), ((60, ), "cca")])
def test_they_follow_the_camera_and_an_override_above_that_moves_in_time(tmp_path, distances, shown):
    hydraBuild.skip_before(2608, "there is no UsdLod")
    modes = usda.attribute("token lod:override:mode", {1: "noOverride", 2: "noOverride", 3: "indexedLOD"})
    above = usda.prim("Xform", "top", modes, root("root", BY), apis=("LODOverrideAPI",))
    path = stage(tmp_path, distances, DISTANCE, above)
    hydraBuild.run_usdrecord(path, tmp_path / "h.#.exr", "--camera", "camera", "--frames", "1:3", "--imageWidth", WIDTH,
                             "--disableCameraLight", "--colorCorrectionMode", "disabled", scene_index=True)
    assert [levels(pixels(tmp_path / f"h.{frame}.exr")) for frame in (1, 2, 3)] == list(shown)


PLACES = ((-4, -10), (4, -35))  # x, z: from 20 units before, the first one is nearer than 50, the other is not


@pytest.mark.parametrize("instanceable", [True, False])
def test_native_instances_share_the_level_of_the_nearest(tmp_path, instanceable):
    meta = ("prepend references = </asset>", f"instanceable = {str(instanceable).lower()}")
    placed = [usda.prim("Xform", f"i{i}", meta=meta, at=(x, 0, z)) for i, (x, z) in enumerate(PLACES)]
    for asset in (root("asset", BY, specifier="class"),  # the root is the instance, or is in it
                  usda.prim("Xform", "asset", root("root", BY), specifier="class")):
        hydra, record = both(tmp_path, DISTANCE, asset, *placed)
        assert levels(record) == "bc"
        assert levels(hydra) == ("b" if instanceable else "bc")


def test_instances_of_a_point_instancer(tmp_path):
    trees = usda.prim("PointInstancer", "trees", "rel prototypes = </trees/root>", root("root", BY), protoIndices=[0, 0],
                      positions=[(x, 0, z) for x, z in PLACES])
    hydra, record = both(tmp_path, DISTANCE, trees)
    assert levels(record) == "b"
    assert np.array_equal(hydra, record)


def test_instances_in_a_level_go_with_it(tmp_path):
    instance = usda.prim("Xform", "i", meta=("prepend references = </asset>", "instanceable = true"))
    near = usda.prim("Xform", "near", instance, visibility="invisible")
    far = usda.prim("PointInstancer", "far", "rel prototypes = </outOfView/p>", protoIndices=[0], positions=[(0, 0, 0)])
    for index, shown in ((0, "a"), (1, "b")):
        hydra, record = both(
            tmp_path, usda.prim("Xform", "root", f"int lod:default:index = {index}", near, far, apis=("LODRootAPI",)),
            usda.prim("Xform", "asset", tile("a"), specifier="class"),
            usda.prim("Xform", "outOfView", usda.prim("Xform", "p", tile("b")), at=(0, 999, 0)))
        assert levels(record) == shown
        assert np.array_equal(hydra, record)
