# SPDX-License-Identifier: Apache-2.0
"""Scenes of the path tracing benchmark, described once for every renderer.

A scene is a Scene of triangle meshes with constant or textured principled materials and glass, rects of light, and a sky.
Everything is made here; nothing is random but by a fixed seed. Metres, y up.
"""
import dataclasses
import os

import numpy as np

SKY_SIZE = (1024, 512)


@dataclasses.dataclass
class Scene:
    """meshes: name -> (points (n, 3), triangles (m, 3), uv (n, 2) or None, smooth, material)
    instances: name of a mesh -> (k, 4, 4), row vectors: such a mesh is seen where its instances are, only
    materials: name -> {color, roughness (its square is alpha), metallic} with image (a file) in place of color,
        or {glass: ior, roughness}
    rects: (4 x 4 row vectors, width, height, radiance), shining along -z
    sky: file of a latlong image, or None; camera: eye, target, horizontal field of view in degrees"""
    meshes: dict = dataclasses.field(default_factory=dict)
    instances: dict = dataclasses.field(default_factory=dict)
    materials: dict = dataclasses.field(default_factory=dict)
    rects: list = dataclasses.field(default_factory=list)
    sky: str = None
    camera: tuple = ((0.0, 1.5, 6.0), (0.0, 0.8, 0.0), 50.0)

    def plastic(self, name, color, roughness=0.5, metallic=0.0, image=None):
        self.materials[name] = {"color": list(color), "roughness": roughness, "metallic": metallic, "image": image}
        return name


def box(low, high, inward=False):
    low, high = np.asarray(low, float), np.asarray(high, float)
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    points = (low + corners * (high - low))[quads].reshape(-1, 3)
    triangles = np.concatenate([[[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]] for i in range(6)])
    return points, triangles[:, ::-1] if inward else triangles, None, False


def sphere(centre, radius, around=64):
    rows = around // 2
    v, u = np.meshgrid(np.arange(rows + 1) / rows, np.arange(around + 1) / around, indexing="ij")
    theta, phi = np.pi * v, 2.0 * np.pi * u
    normal = np.stack([np.sin(theta) * np.sin(phi), np.cos(theta), np.sin(theta) * np.cos(phi)], -1)
    at = np.arange((rows + 1) * (around + 1)).reshape(rows + 1, around + 1)
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    upper, lower = np.stack([a, b, c], -1), np.stack([a, c, d], -1)
    triangles = np.concatenate([upper[:-around], lower[around:]])  # none of no area at the poles
    uv = np.stack([u, 1.0 - v], -1).reshape(-1, 2)
    return np.asarray(centre) + radius * normal.reshape(-1, 3), triangles, uv, True


def floor(size=20.0):
    s = size / 2.0
    points = np.array([[-s, 0, s], [s, 0, s], [s, 0, -s], [-s, 0, -s]], float)
    return points, np.array([[0, 1, 2], [0, 2, 3]]), np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float), False


def facing(origin, target):
    """:returns: 4 x 4, row vectors: an x, y, z frame at `origin` whose -z looks at `target`"""
    origin, target = np.asarray(origin, float), np.asarray(target, float)
    z = (origin - target) / np.linalg.norm(origin - target)
    x = np.cross([0.0, 1.0, 0.0] if abs(z[1]) < 0.99 else [1.0, 0.0, 0.0], z)
    x /= np.linalg.norm(x)
    matrix = np.eye(4)
    matrix[:3, :3], matrix[3, :3] = (x, np.cross(z, x), z), origin
    return matrix


def sky(folder):
    """Clouds from bands of noise, and a bright small sun. :returns: the file"""
    from patina.cli import compiled

    width, height = SKY_SIZE
    v, u = np.meshgrid((np.arange(height) + 0.5) / height, (np.arange(width) + 0.5) / width, indexing="ij")
    up = np.cos(np.pi * v)
    noise, random = np.zeros((height, width)), np.random.default_rng(7)
    for octave in range(1, 6):
        cells = random.random((2 ** octave + 1, 2 ** (octave + 1)))
        x, y = u * 2 ** (octave + 1), v * 2 ** octave
        i, j = x.astype(int), y.astype(int)
        a, b = x - i, y - j
        i, k = i % cells.shape[1], (i + 1) % cells.shape[1]
        noise += ((cells[j, i] * (1 - a) + cells[j, k] * a) * (1 - b)
                  + (cells[j + 1, i] * (1 - a) + cells[j + 1, k] * a) * b) / 2 ** octave
    cloud = np.clip(3.0 * noise - 1.4, 0.0, 1.0)[..., None]
    blue = np.stack([0.3 + 0.2 * (1 - up), 0.5 + 0.2 * (1 - up), np.ones_like(up)], -1)
    image = np.where(up[..., None] > 0.0, blue * (1 - cloud) + 1.6 * cloud, [0.15, 0.13, 0.11])
    sun = np.exp(-((u - 0.63) ** 2 + (0.5 * (v - 0.27)) ** 2) / (2.0 * 0.006 ** 2))[..., None]
    path = os.path.join(folder, "sky.exr")
    compiled.load().write_image(path, (image + 400.0 * sun * [1.0, 0.9, 0.75]).astype(np.float32))
    return path


def interior(_):
    """A room that two lights at the ceiling light, most of it indirectly."""
    made = Scene(camera=((2.6, 1.6, 2.6), (-0.4, 0.9, -0.4), 70.0))
    made.meshes["room"] = (*box((-3, 0, -3), (3, 3, 3), inward=True), made.plastic("wall", (0.7, 0.68, 0.62), 0.9))
    random = np.random.default_rng(3)
    for i in range(12):
        low = np.array([random.uniform(-2.6, 1.6), 0.0, random.uniform(-2.6, 1.2)])
        high = low + random.uniform((0.3, 0.2, 0.3), (0.9, 1.4, 0.9))
        made.meshes[f"box{i}"] = (*box(low, high), made.plastic(f"m{i}", random.uniform(0.1, 0.8, 3), random.uniform(0.2, 0.8)))
    made.meshes["ball"] = (*sphere((0.3, 0.35, 0.9), 0.35), made.plastic("metal", (0.9, 0.7, 0.4), 0.3, 1.0))
    for x in (-1.5, 1.5):
        made.rects.append((facing((x, 2.98, -0.5), (x, 0.0, -0.5)), 0.8, 0.8, 12.0))
    return made


def underSky(folder):
    """Nine balls from smooth to rough, plastic and metal, on a floor under clouds and a sun."""
    made = Scene(sky=sky(folder))
    made.meshes["floor"] = (*floor(), made.plastic("ground", (0.4, 0.38, 0.35), 0.8))
    for i in range(9):
        name = made.plastic(f"m{i}", (0.2 + 0.08 * i, 0.3, 0.9 - 0.08 * i), 0.1 + 0.09 * i, float(i % 3 == 1))
        made.meshes[f"ball{i}"] = (*sphere((1.1 * (i % 3 - 1), 0.45, 1.1 * (i // 3 - 1)), 0.45), name)
    return made


def roughGlass(_):
    """A ball and a pane of rough glass before a coloured wall; lit through them."""
    made = Scene()
    made.materials["glass"] = {"glass": 1.5, "roughness": 0.35}
    made.meshes["floor"] = (*floor(), made.plastic("ground", (0.6, 0.6, 0.6), 0.9))
    made.meshes["wall"] = (*box((-3, 0, -2.2), (3, 2.5, -2.0)), made.plastic("wall", (0.7, 0.3, 0.2), 0.9))
    made.meshes["ball"] = (*sphere((-0.8, 0.75, 0.0), 0.7, 96), "glass")
    made.meshes["pane"] = (*box((0.3, 0.01, -0.1), (1.7, 1.5, 0.0)), "glass")
    made.rects.append((facing((2.5, 3.5, 2.0), (0, 0.5, 0)), 1.5, 1.5, 14.0))
    made.rects.append((facing((-3.0, 2.0, -1.0), (0, 0.5, 0)), 0.8, 0.8, 10.0))
    return made


def thousandLights(_):
    """1000 small lights above a floor with balls."""
    made = Scene(camera=((0.0, 2.2, 6.5), (0.0, 0.4, 0.0), 50.0))
    made.meshes["floor"] = (*floor(), made.plastic("ground", (0.5, 0.5, 0.5), 0.6))
    random = np.random.default_rng(5)
    for i in range(12):
        made.meshes[f"ball{i}"] = (*sphere((random.uniform(-3, 3), 0.3, random.uniform(-3, 2)), 0.3),
                                   made.plastic(f"m{i}", random.uniform(0.2, 0.8, 3), 0.4))
    for _ in range(1000):
        at = np.array([random.uniform(-6, 6), random.uniform(0.8, 2.5), random.uniform(-6, 4)])
        made.rects.append((facing(at, at - (0.1, 1.0, 0.05)), 0.05, 0.05, random.uniform(2.0, 40.0)))
    return made


def foliage(folder):
    """400 instances of a bush of 2000 leaves under a sky."""
    made = Scene(sky=sky(folder), camera=((0.0, 2.0, 9.0), (0.0, 0.7, 0.0), 50.0))
    made.meshes["floor"] = (*floor(60.0), made.plastic("ground", (0.25, 0.2, 0.15), 0.9))
    random = np.random.default_rng(9)
    centre = random.normal(size=(2000, 3)) * (0.22, 0.25, 0.22) + (0.0, 0.6, 0.0)
    axes = random.normal(size=(2, 2000, 3))
    a, b = (0.06 * x / np.linalg.norm(x, axis=1, keepdims=True) for x in axes)
    points = np.stack([centre - a, centre - 0.4 * b, centre + a, centre + 0.4 * b], 1).reshape(-1, 3)
    first = 4 * np.arange(2000)[:, None]
    triangles = np.concatenate([first + [0, 1, 2], first + [0, 2, 3]])
    made.meshes["bush"] = (points, triangles, None, False, made.plastic("leaf", (0.12, 0.35, 0.06), 0.6))
    turns, places = random.uniform(0, 2 * np.pi, 400), random.uniform((-9, 0, -14), (9, 0, 5), (400, 3))
    transforms = np.tile(np.eye(4), (400, 1, 1))
    transforms[:, 0, 0] = transforms[:, 2, 2] = np.cos(turns)
    transforms[:, 0, 2], transforms[:, 2, 0] = -np.sin(turns), np.sin(turns)
    transforms[:, 3, :3] = places
    made.instances["bush"] = transforms
    return made


def hundredTextures(folder):
    """100 balls, each with a material and a texture of 512 x 512 of its own, under a sky."""
    from patina.cli import compiled

    made = Scene(sky=sky(folder), camera=((0.0, 6.0, 8.0), (0.0, 0.0, 0.3), 50.0))
    made.meshes["floor"] = (*floor(), made.plastic("ground", (0.4, 0.4, 0.4), 0.8))
    random = np.random.default_rng(11)
    for i in range(100):
        colors = random.uniform(0.05, 0.9, (16, 16, 3))
        path = os.path.join(folder, f"checks{i}.png")
        compiled.load().write_image(path, np.kron(colors, np.ones((32, 32, 1))).astype(np.float32))
        name = made.plastic(f"m{i}", (0.5, 0.5, 0.5), random.uniform(0.2, 0.9), image=path)
        made.meshes[f"ball{i}"] = (*sphere((0.8 * (i % 10 - 4.5), 0.35, 0.8 * (i // 10 - 4.5)), 0.33, 48), name)
    return made


SCENES = {"interior": interior, "underSky": underSky, "roughGlass": roughGlass, "thousandLights": thousandLights,
          "foliage": foliage, "hundredTextures": hundredTextures}
