# SPDX-License-Identifier: Apache-2.0
"""Splats in the rasterizer where testenv/render/test_splats.py, which has the closed forms for both back ends, does not look:
other cameras, surfaces that transmit, further AOVs.

Bounds: as there. Two kernels at nearly the same distance may swap, in both back ends."""
import numpy as np
import pytest

from pxr import UsdVol

import inProcess
from splatStages import (CUT, DOME, END, PANE, SUN, WHITE, Cloud, floor, new_stage, off, random_cloud, rays,
                         sharp_image)

if not hasattr(UsdVol, "ParticleField3DGaussianSplat"):
    pytest.skip("before OpenUSD 26.03", allow_module_level=True)

PIXELS, ROUNDING = 32, 2e-5
BOTH = pytest.mark.parametrize("backend", ["embree", "raster"])


PINHOLE = (10, 4, 4)  # a perspective whose image is 0.4 wide at distance 1


def pinhole_rays(distance, half=0.2, shift=(0.0, 0.0), focus=1.0):
    """:param shift: of the eye on a lens, with the plane at this distance in focus
    :returns: origins, directions of unit length"""
    x = ((np.arange(PIXELS) + 0.5) / PIXELS * 2 - 1) * half
    grid = np.stack(np.meshgrid(x, -x), -1).reshape(-1, 2)
    directions = np.concatenate([grid - np.array(shift) / focus, np.full((len(grid), 1), -1.0)], 1)
    eye = np.array([shift[0], shift[1], distance])
    return np.broadcast_to(eye, directions.shape), directions / np.linalg.norm(directions, axis=1, keepdims=True)


@BOTH
@pytest.mark.parametrize("distance", [6.0, 0.3])
def test_a_perspective_from_afar_and_from_among_the_kernels(tmp_path, backend, distance):
    cloud = random_cloud(150, 31, degree=2)
    stage = new_stage(near=1e-3, eye=(0, 0, distance), lens=PINHOLE)
    cloud.define(stage)
    images, _ = sharp_image(stage, tmp_path, PIXELS, backend=backend)
    light, alpha = cloud.seen(*pinhole_rays(distance))
    difference = off(images, light)
    assert np.mean(difference > 1e-4) < 0.01 and difference.max() < 0.05 + END
    assert images["alpha"].ravel() == pytest.approx(alpha, abs=2 * CUT + END)


@BOTH
def test_clipping_ranges_and_planes(tmp_path, backend):
    """A kernel counts as a whole, by the point where it is densest."""
    plane = "float4[] clippingPlanes = [(0, 0, -1, -9.5)]"  # of the camera's space: what is farther than 9.5 is seen
    stage = new_stage(width=0.001, near=8.5, far=11.5, lines=(plane,))
    Cloud([[0, 0, z] for z in (2, 1, 0, -1, -2)], 0.3, 0.5, [[v] * 3 for v in (0.9, 0.7, 0.5, 0.3, 0.1)]).define(stage)
    images, _ = sharp_image(stage, tmp_path, 1, backend=backend)
    assert images["color"][0, 0, 0] == pytest.approx(0.5 * 0.5 + 0.25 * 0.3, abs=ROUNDING)


@BOTH
def test_depth_of_field(tmp_path, backend):
    """The mean over the lens of closed forms. Lens samples are spread evenly, 256 of them: their standard error is below
    that of random ones, and the bound is five of those."""
    cloud = random_cloud(12, 33, 0.5, 0.2)
    # A lens 1 unit wide, of a focal length of 1: apertures are in tenths of units.
    stage = new_stage(near=0.1, eye=(0, 0, 4), lens=PINHOLE, focusDistance=3, fStop=1)
    cloud.define(stage)
    images, _ = sharp_image(stage, tmp_path, PIXELS, 256, backend=backend)
    random = np.random.default_rng(7)
    radius, turn = 0.5 * np.sqrt(random.uniform(0, 1, 1024)), random.uniform(0, 2 * np.pi, 1024)
    seen = np.array([cloud.seen(*pinhole_rays(4.0, shift=(r * np.cos(a), r * np.sin(a)), focus=3.0))[1]
                     for r, a in zip(radius, turn)])
    error = seen.std(0) * np.sqrt(1 / 256 + 1 / 1024)
    assert (np.abs(images["alpha"].ravel() - seen.mean(0)) <= 5 * error + 12 * CUT).all()
    assert seen.std(0).max() > 0.1


@BOTH
@pytest.mark.parametrize("places", [[2.0], [-2.0], [2.0, -2.0]])
def test_a_pane_that_does_not_bend_light(tmp_path, backend, places):
    """Before and behind a pane that is not there but for its name, kernels show as without it."""
    colors = [[1, 0.5, 0.2], [0.1, 0.3, 1]][:len(places)]
    images = []
    for pane in (False, True):
        stage = new_stage(DOME, floor(**PANE) if pane else "")
        Cloud([[0, 0, z] for z in places], 0.4, 0.6, colors).define(stage)
        images.append(sharp_image(stage, tmp_path, PIXELS, 4, backend=backend)[0]["color"])
    assert images[1] == pytest.approx(images[0], abs=ROUNDING)


@pytest.mark.parametrize("passes", [1, 4, 12])
def test_first_passes_smooth_what_is_behind(tmp_path, passes):
    """The passes of a first look smooth the light of surfaces. Before that splats show as ever, over the wall of a stage
    without them."""
    inProcess.needs_opengl()
    cloud = random_cloud(40, 35)
    images = []
    for splats in (False, True):
        stage = new_stage(floor(z=-3.0, **WHITE), DOME)
        if splats:
            cloud.define(stage)
        images.append(sharp_image(stage, tmp_path, PIXELS, passes, backend="raster")[0]["color"][..., :3].reshape(-1, 3))
    light, alpha = cloud.seen(*rays(PIXELS))
    assert images[1] == pytest.approx(light + (1 - alpha[:, None]) * images[0], abs=1e-4)


def test_ids_and_mattes_of_what_splats_hide(tmp_path):
    """Both back ends: where splats have taken half of the light the prim is theirs, and the coverage of Cryptomatte none."""
    inProcess.needs_opengl()
    found = []
    for backend in ("embree", "raster"):
        stage = new_stage(floor(z=-3.0, **WHITE))
        Cloud([0.4, 0, 0], 0.2, 1.0).define(stage)
        images, _ = sharp_image(stage, tmp_path, PIXELS, 4, aovs=("primId", "cryptoObject", "albedo"), backend=backend)
        found.append(images)
    for aov in ("primId", "albedo"):
        assert np.array_equal(found[0][aov], found[1][aov]), aov
    assert len(np.unique(found[0]["primId"])) == 2


def test_parts_of_an_image(tmp_path):
    """A data window and the whole have the same pixels."""
    inProcess.needs_opengl()
    stage = new_stage()
    random_cloud(60, 36, degree=1).define(stage)
    path = tmp_path / "stage.usda"
    stage.Export(str(path))
    arguments = ("--camera", "/camera", "--imageWidth", PIXELS, "--imageHeight", PIXELS, "--backend", "raster", "--samples", 3)
    images = [inProcess.Stage(path, *arguments, *crop).image() for crop in ((), ("--dataWindow", "8,8,23,23"))]
    assert images[1].max() > 0
    part = slice(PIXELS // 4, 3 * PIXELS // 4)
    assert np.array_equal(images[0][part, part], images[1][part, part])


def test_splats_are_seen_by_the_camera_alone(tmp_path):
    """A floor in the sun is as without a kernel that is out of sight between them."""
    inProcess.needs_opengl()
    images = []
    for kernel in (False, True):
        stage = new_stage(floor(**WHITE), SUN, eye=(0, 0, 2))
        if kernel:
            Cloud([0, 0, 4], 0.3, 1.0, 1.0).define(stage)
        images.append([sharp_image(stage, tmp_path, 8, 4, backend=name)[0]["color"] for name in ("raster", "embree")])
    assert np.array_equal(images[0][0], images[1][0])
    assert abs(images[0][1] - images[1][1]).max() > 0.1
