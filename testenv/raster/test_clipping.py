# SPDX-License-Identifier: Apache-2.0
"""Regions that a camera does not see: before its near plane, beyond its far plane and behind its clipping planes; lights have a
place, too, also where no surface is near them."""

import numpy as np
import pytest

import inProcess
import pairs
import usda

pytestmark = pytest.mark.usefixtures("opengl")

STAGE = usda.stage(
    usda.camera("float4[] clippingPlanes = [%(planes)s]", lens=(20, "%(aperture)s", "%(aperture)s"),
                projection="%(projection)s", clippingRange="(%(near)s, %(far)s)", at=(0, 0, 10)),
    usda.prim("DomeLight", "sky", "bool inputs:shadow:enable = 0", intensity=0.3))
LIGHT = usda.prim("SphereLight", "light%(i)d", "bool inputs:shadow:enable = 0", radius=0.4, intensity=2,
                  at="(%(x)s, %(y)s, %(z)s)")
SURFACES = (
    usda.prim("Sphere", "ball", radius=1.5, color=(0.2, 0.5, 0.8))
    + usda.prim("Cube", "box", size=2, at=(-2, -1.5, -0.5), color=(0.8, 0.3, 0.2)))


def images(tmp_path, surfaces, lights, projection, near=0.1, far=100, planes="", backends=("raster", "embree")):
    stage = tmp_path / "stage.usda"
    values = {"projection": projection, "aperture": 20 if projection == "perspective" else 100, "near": near, "far": far,
              "planes": planes}
    stage.write_text(STAGE % values + surfaces +
                     "".join(LIGHT % {"i": i, "x": x, "y": y, "z": z} for i, (x, y, z) in enumerate(lights)))
    found = []
    for backend in backends:
        image = str(tmp_path / (backend + ".exr"))
        pairs.record(str(stage), image, "--backend", backend, "--samples", "32", "--maxDepth", "1", "-w", "64")
        found.append(pairs.pixels(image))
    return found


def assert_alike(raster, traced, mean=0.01):
    # 32 samples of an edge: most of a pixel's error.
    assert abs(raster.mean() / traced.mean() - 1.0) < mean
    assert np.abs(raster - traced).mean() < 0.01 * traced.max()
    assert np.abs(raster - traced).max() < 0.2 * traced.max()


LIGHTS = [(0.5, 0.7, 6), (2, 1.5, 1.2), (-2, 2, -4), (-1, -0.5, 4), (1.5, -2, -8), (2.5, 2.5, -12)]


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize("surfaces", ["", SURFACES])
def test_lights_are_seen_wherever_they_are(tmp_path, surfaces, projection):
    raster, traced = images(tmp_path, surfaces, LIGHTS, projection)
    assert (traced.max(axis=2) > 1.5).sum() > 50
    assert_alike(raster, traced)


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_lights_outside_of_the_clipping_range_are_not_seen(tmp_path, projection):
    raster, traced = images(tmp_path, SURFACES, LIGHTS, projection, near=5, far=16)
    wide = images(tmp_path, SURFACES, LIGHTS, projection, backends=["embree"])[0]
    assert (wide.max(axis=2) > 1.5).sum() > (traced.max(axis=2) > 1.5).sum() + 20
    assert_alike(raster, traced)


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize("planes", ["(1, 0.2, 0, 1)", "(1, 0.2, 0, 1), (0, 0, -1, -9.2), (-0.3, -1, 0, 1.4)"])
def test_clipping_planes_cut_surfaces_and_lights(tmp_path, projection, planes):
    raster, traced = images(tmp_path, SURFACES, LIGHTS, projection, planes=planes)
    whole = images(tmp_path, SURFACES, LIGHTS, projection, backends=["embree"])[0]
    assert np.abs(whole - traced).mean() > 0.05 * whole.mean()
    assert_alike(raster, traced)


def test_more_planes_than_are_taken_are_told(tmp_path):
    stage = tmp_path / "stage.usda"
    planes = ", ".join(f"(0, 0, -1, {-1 - i})" for i in range(9))
    stage.write_text(STAGE % {"projection": "perspective", "aperture": 20, "near": 0.1, "far": 100, "planes": planes}
                     + SURFACES)
    found = inProcess.patina("record", stage, tmp_path / "image.exr", "--backend", "raster", "--samples", "1", "-w", "16")
    assert "/camera" in found.stderr + found.stdout and "clippingPlanes" in found.stderr + found.stdout
