# SPDX-License-Identifier: Apache-2.0
"""Instances that glow share a light tree. They light a floor as one mesh of all their triangles does.

Eight seeds a side. The 51 means of tiles and of the whole, in three channels, may differ by 9 standard errors: with the 7
degrees of freedom that Welch's test has at least, a significance of 0.003 over all, for seeds that are fixed.
"""
import numpy as np

from usdaText import render_text
from usda import camera, floor, material, prim

T = 9.0
SEEDS, SIZE, TILE = 8, 16, 4
STAGE = (
    '(upAxis = "Y")\n'
    + camera(flat=(60, 60), clippingRange=(0.01, 100), at=(0, 0.5, 0), turn=(-90, 0, 0))
    + floor("floor", 9, color=(0.8, 0.8, 0.8))
    + material("glow", {
        "surface": ("UsdPreviewSurface", {"diffuseColor": (0, 0, 0), "color3f emissiveColor": "<reader>"}),
        "reader": ("UsdPrimvarReader_float3", {"varname": "glow"})}))


def _strip(count):
    """:returns: points and triangles of a bent strip, seen from below by its windings"""
    angles = np.linspace(-1.0, 1.0, count // 2 + 1)
    rows = np.stack([np.sin(angles), np.cos(angles), np.zeros_like(angles)], axis=1)
    points = np.concatenate([rows, rows + (0, 0, 0.5)])
    n = len(rows)
    triangles = [t for i in range(n - 1) for t in ((i, i + 1, n + i), (i + 1, n + i + 1, n + i))]
    return points, np.array(triangles)


def _numbers(rows):
    return "[" + ", ".join("(" + ", ".join(f"{x:.7g}" for x in row) + ")" for row in rows) + "]"


def _mesh(name, points, triangles, *lines):
    return prim("Mesh", name, *lines, bind="glow", faceVertexCounts=[3] * len(triangles),
                faceVertexIndices=triangles.ravel().tolist(), points=_numbers(points), subdivisionScheme="none")


def _glow(values, interpolation):
    return f'color3f[] primvars:glow = {_numbers(values)} (interpolation = "{interpolation}")'


def _stages():
    """:returns: the same emitters as instances, and as one mesh"""
    random = np.random.default_rng(5)
    count, (points, triangles) = 48, _strip(24)
    positions = random.uniform((-3, 1, -3), (3, 2.5, 3), (count, 3))
    scales = random.uniform(0.1, 0.4, (count, 3))
    scales[::5, 0] *= -1.0  # mirrored
    scales[0] = 1e-6  # nothing is seen of the first
    glow = random.uniform(0.0, 8.0, (count, 3)) ** 2
    glow[1] = 0.0
    instances = STAGE + prim(
        "PointInstancer", "many", "rel prototypes = [</many/strip>]", f"float3[] scales = {_numbers(scales)}",
        _glow(glow, "varying"), _mesh("strip", points, triangles), protoIndices=[0] * count, positions=_numbers(positions))
    every = np.concatenate([points * scale + position for scale, position in zip(scales, positions)])
    faces = np.concatenate([triangles + i * len(points) for i in range(count)])
    return instances, STAGE + _mesh("all", every, faces, _glow(np.repeat(glow, len(triangles), axis=0), "uniform"))


def _means(stage):
    """:returns: seeds x (tiles and the whole), each in three channels"""
    found = []
    for seed in range(SEEDS):
        images, warnings, _ = render_text(stage, width=SIZE, height=SIZE, samples=4, maxDepth=1, seed=seed)
        assert not warnings, warnings
        image = images["color"][..., :3].astype(np.float64)
        n = SIZE // TILE
        tiles = image.reshape(n, TILE, n, TILE, 3).mean(axis=(1, 3)).reshape(-1, 3)
        found.append(np.concatenate([tiles, image.mean(axis=(0, 1))[None]]))
    return np.array(found)


def test_instances_light_as_one_mesh_of_them_does():
    instances, one = (_means(stage) for stage in _stages())
    error = np.sqrt((instances.var(axis=0, ddof=1) + one.var(axis=0, ddof=1)) / SEEDS)
    assert (one.mean(axis=0) > 0.0).all()
    off = np.abs(instances.mean(axis=0) - one.mean(axis=0)) / error
    assert off.max() <= T, off.max()
    # More noise would tell nothing.
    assert error[-1].max() < 0.1 * one.mean(axis=0)[-1].min()
