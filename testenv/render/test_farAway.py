# SPDX-License-Identifier: Apache-2.0
"""Far from the origin a scene looks as it does near by: everything under one transform is moved there."""
import numpy as np
import pytest

import inProcess
from patina import experiment
from usdaText import render_text
from usda import camera, floor, material, prim


# Neither whole numbers, nor such that floats have so far away: the spacing of floats is 1/128 there.
FAR = (100000.3337, 12.1, 50000.1234)

STAGE = prim("Xform", "world",
    camera(clippingRange=(0.01, 10000000), at=(0.2003, 1.5, 4.0001), turn=(-18, 0, 0)),
    prim("RectLight", "light", intensity=30, at=(1.5, 3.0007, 1.5), turn=(-60, 40, 0)),
    floor("floor", 50, scheme=""),
    prim("Cube", "block", size=0.05, at=(0.303, 0.0251, 2.6)),
    prim("Sphere", "ball", radius=0.3, at=(-0.4003, 0.3, 2.1)),
    prim("BasisCurves", "curve", type="linear", curveVertexCounts=[2], points=[(0, 0, 0), (0, 0.8, 0)],
         widths='[0.05] (interpolation = "constant")', at=(0.7003, 0, 1.9)),
    prim("PointInstancer", "posts", "rel prototypes = </world/posts/post>",
        prim("Cube", "post", size=0.2),
        protoIndices=[0, 0], positions=[(-0.9, 0.1, 2.0), (0.1, 0.1, 1.2)]),
    at="%(at)s")


def look(at, **settings):
    images, warnings, _ = render_text(STAGE % {"at": at}, ("color", "position", "depth", "normal"), maxDepth=2, **settings)
    assert not warnings
    return images


def assert_same_color(near, far):
    """The same rays but for their last bits: few of them pass an edge on its other side."""
    color = near["color"][..., :3]
    assert color.max() > 0.1
    difference = np.abs(color - far["color"][..., :3]).mean() / color.mean()
    assert difference < 0.01, difference


def compare(far, near, at):
    """Positions, depths and normals of all pixels but a hundredth: at an edge the nearest sample may be another one."""
    seen = near["depth"].reshape(32, 32) < 100.0
    assert seen.mean() > 0.5
    for name, spacing in (("depth", 1e-4), ("normal", 1e-3)):
        off = np.abs(near[name] - far[name]).reshape(32, 32, -1).max(-1)[seen] > spacing
        assert off.mean() < 0.01, name
    # Positions are told in the world, with the numbers that there are.
    off = np.abs(near["position"] + np.array(at) - far["position"]).max(-1)[seen] > 2.0 ** -6
    assert off.mean() < 0.01


def test_shadows_stay_and_so_do_positions_depths_and_normals():
    at = (100000.0, 0.0, 50000.0)
    near, far = look((0, 0, 0)), look(at)
    assert_same_color(near, far)
    compare(far, near, at)


def test_what_floats_cannot_place_at_all_is_seen():
    """Floats are 8 apart there: rays from the world's origin meet nothing of the scene."""
    assert_same_color(look((0, 0, 0)), look((80000000.0, 0.0, 50000000.0)))


def test_the_rasterizer_places_as_the_path_tracer_does():
    """Transforms are added up in double, too. Floats are a quarter apart there, which is five times the block."""
    inProcess.needs_opengl()
    at = (3000000.3337, 12.1, 2000000.1234)
    near, far = look((0, 0, 0), backend="raster"), look(at, backend="raster")
    seen = near["depth"].reshape(32, 32) < 100.0
    assert seen.mean() > 0.5
    # Doubles are 5e-10 apart there, so only edges may be another pixel's.
    off = np.abs(near["depth"] - far["depth"]).reshape(32, 32)[seen] > 1e-4
    assert off.mean() < 0.01, off.mean()


def test_places_between_the_numbers_that_there_are_stay_apart():
    """Transforms are handed over, and made relative, in double. Zeros of other signs turn the frames that samples are
    drawn in, so the noise is another one: the mean of 16384 samples that vary by less than their mean is known to 0.8 %,
    and two of them differ by less than five times the root of two of that."""
    near, far = look((0, 0, 0)), look(FAR)
    compare(far, near, FAR)
    assert far["color"].mean() == pytest.approx(near["color"].mean(), rel=5 * 2 ** 0.5 * 0.008)


def test_materials_read_the_same_world():
    """Stripes that follow the position in the world stand where they do for a scene that is seen from the origin."""
    stripes = material("stripes", {
        "surface": ("ND_surface_unlit", {"color3f emission_color": "<color>"}),
        "color": ("ND_convert_vector3_color3", {"float3 in": "<scale>"}),
        "scale": ("ND_multiply_vector3FA", {"float3 in1": "<place>", "in2": 0.00001}),
        "place": ("ND_position_vector3", {"space": "world"})})
    world = prim("Xform", "world", camera(at=(0, 0, 4)), prim("Sphere", "ball", bind="stripes"), at=(100000, 0, 50000))
    images, warnings, _ = render_text(stripes + world, samples=1)
    assert not warnings
    middle = images["color"][16, 16, :3]
    assert middle == pytest.approx([1.0, 0.0, 0.50001], abs=2e-5)


def test_scenes_near_the_origin_keep_their_numbers():
    """The origin stays 0 where what is seen is not far from it, so the same image comes of a camera that looks from
    there and of one that has looked elsewhere before."""
    import _patina

    from patina.stage import StageOptions, read_stage
    from usdaText import open_text

    scene = _patina.Scene()
    renderer = _patina.make_renderer("embree")
    images = []
    for at in ((0, 0, 0), FAR, (0, 0, 0)):
        with scene.edit() as edit:
            edit.clear()
            info = read_stage(open_text(STAGE % {"at": at}), edit, StageOptions(headlight=False))
        film = _patina.Film()
        experiment.draw(renderer, scene, info.camera, {"width": 16, "height": 16, "samples": 2, "threads": 1}, film)
        images.append(np.array(film.resolve("color")))
    assert np.array_equal(images[0], images[2])
