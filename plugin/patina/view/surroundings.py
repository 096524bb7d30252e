# SPDX-License-Identifier: Apache-2.0
"""Where a material is looked at: environments, lights, shapes, and the first camera."""
import functools
import os

import numpy as np

from patina.cli.errors import CommandError
from patina.view import images, shapes

IDENTITY = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]


def studio(width=256):
    """A room with two soft boxes and a floor, made here so that a page needs no file."""
    height = width // 2
    v, u = np.meshgrid((np.arange(height) + 0.5) / height, (np.arange(width) + 0.5) / width, indexing="ij")
    up = np.cos(np.pi * v)
    image = np.where(up[..., None] > 0.0, np.array([0.30, 0.32, 0.36]) * (0.55 + 0.45 * up[..., None]),
                     np.array([0.16, 0.15, 0.14]) * (1.0 + 0.5 * up[..., None]))

    def box(u0, v0, du, dv, color):
        soft = 0.02
        across = np.clip((du - np.abs((u - u0 + 0.5) % 1.0 - 0.5)) / soft, 0.0, 1.0)
        down = np.clip((dv - np.abs(v - v0)) / soft, 0.0, 1.0)
        return (across * down)[..., None] * np.asarray(color)

    image = image + box(0.38, 0.30, 0.07, 0.11, (7.0, 6.6, 6.0)) + box(0.72, 0.36, 0.04, 0.16, (2.2, 2.6, 3.2))
    return {**images.half_rgb(image.astype(np.float32)), "name": "studio", "radiance": [1.0, 1.0, 1.0]}


def even():
    return {**images.half_rgb(np.ones((2, 4, 3), np.float32)), "name": "even", "radiance": [1.0, 1.0, 1.0]}


def black():
    return {**images.half_rgb(np.zeros((2, 4, 3), np.float32)), "name": "none", "radiance": [0.0, 0.0, 0.0]}


def environments(files, domes, largest, z_up):
    """Those of files, then of a stage, then the page's own. A file is read once, however many name it."""
    upright = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0] if z_up else IDENTITY
    latlong = functools.cache(lambda file: images.latlong(file, largest))
    found = []
    for file in files:
        if not os.path.exists(file):
            raise CommandError(f"--environment: there is no file {file}")
        entry = latlong(file)
        found.append({**entry, "name": os.path.splitext(os.path.basename(file))[0], "radiance": [1.0, 1.0, 1.0],
                      "toLocal": upright})
    for dome in domes:
        axes = np.array(dome["axes"])
        lengths = np.linalg.norm(axes, axis=1, keepdims=True)
        axes = axes / np.maximum(lengths, 1e-20)
        if dome["pixels"] is not None:
            entry = images.half_rgb(images.shrunk(np.nan_to_num(dome["pixels"]), largest))
        else:
            entry = latlong(dome["texture"]) if dome["texture"] else even()
        found.append({**entry, "name": dome["path"].rpartition("/")[2], "radiance": [float(x) for x in dome["radiance"]],
                      "toLocal": [float(x) for x in axes.T.ravel()]})
    return found + [{**made, "toLocal": upright} for made in (studio(), even(), black())]


def shared(found):
    """:returns: environments as a page holds them: one whose texels an earlier one has names its place as `texelsOf`"""
    first, made = {}, []
    for i, entry in enumerate(found):
        k = first.setdefault((entry["width"], entry["height"], entry["data"]), i)
        made.append(entry if k == i else {**{key: value for key, value in entry.items() if key != "data"}, "texelsOf": k})
    return made


def camera(radius, target, z_up):
    """:returns: what the page's camera starts from"""
    up = [0.0, 0.0, 1.0] if z_up else [0.0, 1.0, 0.0]
    way = np.array([0.45, -1.0, 0.3] if z_up else [0.45, 0.3, 1.0])
    eye = np.asarray(target) + 4.7 * radius * way / np.linalg.norm(way)
    return {"fov": 28.0, "up": up, "target": [float(x) for x in target], "radius": float(radius)}, \
        [float(x) for x in eye]


def built_in_shapes(radius, target, z_up):
    """The page's own shapes, as large as what they stand for: (name, mesh, closed, columns of the transform)."""
    # Columns; with z up, the shapes' own y is turned there.
    y, z = ([0.0, 0.0, radius], [0.0, -radius, 0.0]) if z_up else ([0.0, radius, 0.0], [0.0, 0.0, radius])
    to_world = [radius, 0.0, 0.0, 0.0, *y, 0.0, *z, 0.0, *[float(x) for x in target], 1.0]
    return [(*shape, to_world) for shape in shapes.built_in()]
