# SPDX-License-Identifier: Apache-2.0
"""The built-in shapes: triangles with normals, tangents and texture coordinates."""
import numpy as np

from patina.view import blobs


def packed(name, mesh, closed):
    """
    :param mesh: dict of points, normals (n, 3), uv (n, 2), tangents (n, 4), indices
    """
    used = {"position": mesh["points"], "normal": mesh["normals"], "uv": mesh["uv"], "tangent": mesh["tangents"]}
    if "colors" in mesh:
        used["color"] = mesh["colors"]
    return {"name": name, "closed": closed, "count": len(mesh["indices"]),
            "attributes": {key: {"size": int(np.shape(value)[1]), "data": blobs.pack(np.asarray(value, "<f4"))}
                           for key, value in used.items()},
            "indices": blobs.pack(np.asarray(mesh["indices"], "<u4"))}


def revolved(profile, normals, around=96):
    """A profile (n, 2) of radius and height, from below upwards, turned about the y axis."""
    angle = np.linspace(0.0, 2.0 * np.pi, around + 1)
    s, c = np.sin(angle), np.cos(angle)
    steps = len(profile)
    r, y = profile[:, 0][:, None], profile[:, 1][:, None]
    nr, ny = normals[:, 0][:, None], normals[:, 1][:, None]
    points = np.stack([r * s, np.broadcast_to(y, (steps, around + 1)), r * c], axis=-1)
    directions = np.stack([nr * s, np.broadcast_to(ny, (steps, around + 1)), nr * c], axis=-1)
    tangents = np.stack([c, np.zeros_like(c), -s, np.ones_like(c)], axis=-1)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))])
    v = length / length[-1]
    uv = np.stack(np.broadcast_arrays(angle[None, :] / (2.0 * np.pi), v[:, None]), axis=-1)
    row = np.arange(steps - 1)[:, None] * (around + 1) + np.arange(around)[None, :]
    a, b, d, e = row, row + 1, row + around + 1, row + around + 2
    triangles = np.stack([a, b, e, a, e, d], axis=-1).reshape(-1, 3)
    flat = points.reshape(-1, 3)
    p = flat[triangles]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    return {"points": flat, "normals": directions.reshape(-1, 3), "uv": uv.reshape(-1, 2),
            "tangents": np.broadcast_to(tangents, (steps, around + 1, 4)).reshape(-1, 4),
            "indices": triangles[area > 1e-12].ravel()}


def sphere(around=128):
    """Radius 1; u runs once around, v from the south pole to the north pole."""
    angle = np.linspace(-0.5 * np.pi, 0.5 * np.pi, around // 2 + 1)
    profile = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    profile[[0, -1], 0] = 0.0
    return revolved(profile, profile, around)


def _arc(centre, radius, start, end, steps):
    angle = np.radians(np.linspace(start, end, steps))
    n = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return np.asarray(centre) + radius * n, n


def shader_ball():
    """A ball with a groove about its waist, on a rounded foot: broad and narrow curvature, edges in and out."""
    parts = [
        _arc((0.0, -0.95), 1e-6, -90, -90, 1),
        _arc((0.50, -0.93), 0.07, -90, 90, 10),
        _arc((0.38, -0.76), 0.10, 270, 180, 7),  # the hollow between foot and ball
        _arc((0.0, 0.05), 0.80, -62, -9, 20),
        _arc((0.755, 0.01), 0.035, -80, 10, 5),
        _arc((0.745, 0.05), 0.045, 225, 135, 7),
        _arc((0.755, 0.09), 0.035, -10, 80, 5),
        _arc((0.0, 0.05), 0.80, 9, 90, 32)]
    # Concave arcs are walked around their far side, so their normals point to the centre.
    parts[2] = (parts[2][0], -parts[2][1])
    parts[5] = (parts[5][0], -parts[5][1])
    profile = np.concatenate([p for p, _ in parts])
    normals = np.concatenate([n for _, n in parts])
    normals[0] = (0.0, -1.0)
    profile[0, 0] = profile[-1, 0] = 0.0
    return revolved(profile, normals)


def plane():
    """Two units wide, upright, facing +z."""
    points = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], dtype=np.float64)
    return {"points": points, "normals": np.tile((0.0, 0.0, 1.0), (4, 1)), "uv": points[:, :2] * 0.5 + 0.5,
            "tangents": np.tile((1.0, 0.0, 0.0, 1.0), (4, 1)), "indices": np.array([0, 1, 2, 0, 2, 3])}


def built_in():
    """:returns: list of (name, mesh, whether it is closed)"""
    return [("sphere", sphere(), True), ("shader ball", shader_ball(), True), ("plane", plane(), False)]
