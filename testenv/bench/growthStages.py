# SPDX-License-Identifier: Apache-2.0
"""Stages of the benchmark of growth: each has one thing that there are more of, in a field of the same size under one sky."""
import math
import os

import numpy as np
from pxr import Gf, Sdf, Vt

import usda

FIELD = 12.0  # width of the field, whatever is in it
TRIANGLES = 1000  # of a prototype whose instances are counted in triangles
TEXTURE = 1024  # width of a texture: 4 MiB of texels with its smaller levels left out
CAMERA = usda.camera(lens=(35, 32, 24), at=(0, 6, 10), rotateX=-30)
SKY = usda.prim("DomeLight", "sky", intensity=1)


def cloth(name, **values):
    """A mesh without its points, which weave() gives it."""
    return usda.prim("Mesh", name, st=[], subdivisionScheme="none", **values)


def weave(layer, path, columns, rows, width, depth, place=(0.0, 0.0, 0.0)):
    """Makes a mesh a wavy cloth of 2 x columns x rows triangles around `place`."""
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, columns + 1), np.linspace(-0.5, 0.5, rows + 1))
    x, z = u.ravel() * width, v.ravel() * depth
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    faces = np.stack([first, first + columns + 1, first + columns + 2, first + 1], 1)
    usda.fill(layer, path, points=np.stack([x, 0.05 * np.sin(3.1 * x) * np.cos(2.3 * z + x), z], 1) + place,
              faceVertexCounts=np.full(len(faces), 4), faceVertexIndices=faces.ravel(),
              **{"primvars:st": np.stack([u.ravel() + 0.5, v.ravel() + 0.5], 1)})


def instancer(layer, path, prototypes, places):
    """Makes prims below an instancer its prototypes, in turn."""
    made = Sdf.RelationshipSpec(layer.GetPrimAtPath(path), "prototypes", False)
    made.targetPathList.explicitItems = [f"{path}/{name}" for name in prototypes]
    usda.fill(layer, path, protoIndices=np.arange(len(places)) % len(prototypes), positions=places)


def places(count, height=0.3):
    """:returns: `count` places on a square grid over the field, at some heights; and the width of a cell"""
    side = math.ceil(math.sqrt(count))
    k = np.arange(count)
    return np.stack([((k % side + 0.5) / side - 0.5) * FIELD, height + 0.4 * ((k * 7919) % 13) / 13.0,
                     ((k // side + 0.5) / side - 0.5) * FIELD], 1), FIELD / side


def begin(*prims, sky=SKY):
    """:returns: the layer of a stage of these prims, with a camera, a floor and a sky"""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString(usda.stage(CAMERA, cloth("floor"), sky, *prims))
    weave(layer, "/floor", 2, 2, 40.0, 40.0)
    return layer


def save(layer, folder):
    path = os.path.join(folder, "stage.usdc")
    layer.Export(path)
    return path


def triangles(folder, count):
    """Triangles of one mesh."""
    layer, side = begin(cloth("cloth")), math.ceil(math.sqrt(count / 2))
    weave(layer, "/cloth", side, side, FIELD, FIELD, (0.0, 0.3, 0.0))
    return save(layer, folder)


def instanced(folder, count):
    """Triangles of instances of one mesh of 1000."""
    layer = begin(usda.prim("PointInstancer", "field", cloth("leaf")))
    at, width = places(max(1, count // TRIANGLES))
    instancer(layer, "/field", ["leaf"], at)
    weave(layer, "/field/leaf", 25, 20, 0.9 * width, 0.9 * width)
    return save(layer, folder)


def lights(folder, count):
    """Small spheres of light over the field, of the same power together."""
    return save(begin(usda.prim("Scope", "lights", *(
        usda.prim("SphereLight", f"light{i}", radius=0.01, intensity=60000.0 / count, at=tuple(place))
        for i, place in enumerate(places(count, 0.8)[0].tolist()))), sky=""), folder)


def _quads(folder, count, materials=()):
    """A quad for each material, or as many without."""
    quads = [cloth(f"quad{i}", bind=f"materials/m{i}" if materials else "") for i in range(count)]
    layer = begin(usda.prim("Scope", "quads", *quads), usda.prim("Scope", "materials", *materials))
    at, width = places(count)
    for i, place in enumerate(at):
        weave(layer, f"/quads/quad{i}", 1, 1, 0.9 * width, 0.9 * width, place)
    return save(layer, folder)


def materials(folder, count):
    """A quad for each material, of a colour of its own."""
    random = np.random.default_rng(3)
    return _quads(folder, count, [usda.preview(f"m{i}", "/materials", diffuseColor=tuple(random.uniform(0.1, 0.8, 3).tolist()))
                                  for i in range(count)])


def prims(folder, count):
    """Meshes of two triangles."""
    return _quads(folder, count)


def prototypes(folder, count):
    """Prototypes of two triangles, with an instance each."""
    names = [f"leaf{i}" for i in range(count)]
    layer = begin(usda.prim("PointInstancer", "field", *map(cloth, names)))
    at, width = places(count)
    instancer(layer, "/field", names, at)
    for name in names:
        weave(layer, f"/field/{name}", 1, 1, 0.9 * width, 0.9 * width)
    return save(layer, folder)


def instances(folder, count):
    """Prims that are instances of one prim (instanceable)."""
    at, width = places(count)
    placed = (usda.prim("Xform", f"leaf{i}", meta=("instanceable = true", "references = </class/leaf>"), at=tuple(place))
              for i, place in enumerate(at.tolist()))
    leaf = usda.prim("", "leaf", cloth("mesh"), specifier="class")
    layer = begin(usda.prim("", "class", leaf, specifier="class"), usda.prim("", "field", *placed))
    weave(layer, "/class/leaf/mesh", 1, 1, 0.9 * width, 0.9 * width)
    return save(layer, folder)


def textures(folder, count):
    """A quad for each texture of 1024 x 1024 texels."""
    from patina.cli import compiled

    random, materials = np.random.default_rng(5), []
    for i in range(count):
        file = os.path.join(folder, f"image{i}.png")
        compiled.load().write_image(file, np.kron(random.random((64, 64, 3)), np.ones((TEXTURE // 64,) * 2 + (1,)))
                                    .astype(np.float32))
        materials.append(usda.material(f"m{i}", {
            "surface": ("UsdPreviewSurface", {"color3f diffuseColor": "<image>"}),
            "image": ("UsdUVTexture", {"file": file, "float2 st": "<st>"}),
            "st": ("UsdPrimvarReader_float2", {"varname": "st"})}, "/materials"))
    return _quads(folder, count, materials)


def splats(folder, count):
    """Gaussian kernels with harmonics of degree 3, flat ones that lie on a cloth and overlap as those of captures do."""
    random = np.random.default_rng(7)
    at, width = places(count)
    at += random.uniform(-0.5, 0.5, at.shape) * (width, 0, width)
    at[:, 1] = 0.5 + 0.3 * np.sin(3.1 * at[:, 0]) * np.cos(2.3 * at[:, 2])
    turns = random.normal(0, (0.1, 0.3, 0.1), (count, 3))
    harmonics = random.normal(0, 0.1, (count, 16, 3))
    harmonics[:, 0] = random.uniform(-1.5, 1.5, (count, 3))
    layer = begin(usda.prim("ParticleField3DGaussianSplat", "splats", "quatf[] orientations = []"))
    usda.fill(layer, "/splats", positions=at, scales=np.tile((width, 0.1 * width, width), (count, 1)),
              opacities=random.uniform(0.2, 1, count), **{"radiance:sphericalHarmonicsCoefficients": harmonics.reshape(-1, 3)})
    layer.GetAttributeAtPath("/splats.orientations").default = Vt.QuatfArray(
        [Gf.Quatf(1, *map(float, turn)) for turn in turns])
    return save(layer, folder)


# name -> (what makes a stage of a number of them, the numbers)
AXES = {
    "triangles": (triangles, [10 ** k for k in range(4, 8)]),
    "instanced": (instanced, [10 ** k for k in range(5, 9)]),
    "lights": (lights, [10 ** k for k in range(6)]),
    "materials": (materials, [10 ** k for k in range(5)]),
    "prims": (prims, [10 ** k for k in range(6)]),
    "prototypes": (prototypes, [10 ** k for k in range(6)]),
    "instances": (instances, [10 ** k for k in range(6)]),
    "textures": (textures, [1, 4, 16, 64]),
    "splats": (splats, [10 ** k for k in range(3, 7)]),
}
