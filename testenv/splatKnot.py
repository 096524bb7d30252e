# SPDX-License-Identifier: Apache-2.0
"""Writes a stage with a knot of Gaussian splats over a floor that mirrors.

    ./patina python testenv/splatKnot.py FILE.usdc [--alone]

Its kernels lie flat on the knot, as those of captures lie on what was seen. Band 1 of their harmonics is a highlight."""
import argparse
import os
import sys

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import checkout

    checkout.enter()

import numpy as np
from pxr import Gf, Usd
from scipy.spatial.transform import Rotation

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "render"))
import usda  # noqa: E402
from splatStages import DC, Cloud  # noqa: E402

SUN = np.array([0.4, 0.8, 0.45])


def curve(t):
    r = 1 + 0.35 * np.cos(3 * t)
    return np.stack([r * np.cos(2 * t), 0.35 * np.sin(3 * t), r * np.sin(2 * t)], -1)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def knot(count):
    random = np.random.default_rng(4)
    t, around = random.uniform(0, 2 * np.pi, (2, count))
    along = unit(curve(t + 1e-3) - curve(t - 1e-3))
    across = unit(np.cross(along, [0, 1, 0.01]))
    normals = np.cos(around)[:, None] * across + np.sin(around)[:, None] * np.cross(along, across)
    turns = Rotation.from_matrix(np.stack([along, np.cross(normals, along), normals], -1))
    scales = np.stack([random.uniform(0.03, 0.06, count), random.uniform(0.012, 0.03, count), np.full(count, 0.004)], -1)
    colors = 0.5 + 0.5 * np.cos(t[:, None] + 2 * np.pi * np.array([0, 0.33, 0.67]))
    light = np.clip(normals @ SUN, 0, 1)[:, None]
    mirrored = 2 * (normals @ SUN)[:, None] * normals - SUN
    harmonics = np.zeros((count, 4, 3))
    harmonics[:, 0] = (colors * (0.15 + 0.75 * light) - 0.5) / DC
    for band, axis, sign in ((1, 1, 1), (2, 2, -1), (3, 0, 1)):
        harmonics[:, band] = 0.25 * sign * light * mirrored[:, [axis]]
    return Cloud(curve(t) + 0.14 * normals, scales, random.uniform(0.6, 1, count), turns=turns, coefficients=harmonics)


def write(path, count=10000, alone=False):
    """:param alone: without floor and lights"""
    view = Gf.Matrix4d().SetLookAt(Gf.Vec3d(0, 1.9, 4.6), Gf.Vec3d(0, -0.12, 0), Gf.Vec3d(0, 1, 0)).GetInverse()
    camera = usda.camera(lens=(40, 32, 20), clippingRange=(0.1, 100), matrix=tuple(tuple(row) for row in view))
    surroundings = () if alone else (
        usda.floor("floor", 6, y=-0.75, scheme="", bind="stone"),
        usda.material("stone", {"surface": ("ND_standard_surface_surfaceshader", {
            "base_color": (0.35, 0.37, 0.4), "specular_roughness": 0.06, "specular_IOR": 1.8})}),
        usda.prim("DomeLight", "sky", intensity=0.35, color=(0.75, 0.85, 1)),
        usda.prim("DistantLight", "sun", intensity=2.2, angle=3, turn=(-55, 35, 0)))
    stage = Usd.Stage.CreateInMemory()
    stage.GetRootLayer().ImportFromString(usda.stage(camera, *surroundings))
    knot(count).define(stage, "/knot", half=True)
    stage.GetRootLayer().Export(path)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", metavar="FILE.usdc", help="is overwritten")
    parser.add_argument("--alone", action="store_true", help="without floor and lights")
    arguments = parser.parse_args()
    write(arguments.file, alone=arguments.alone)
