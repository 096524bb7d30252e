# SPDX-License-Identifier: Apache-2.0
"""Stages of the benchmark of growth: each has one thing that there are more of, in a field of the same size under one sky."""
import math
import os

import numpy as np
from pxr import Gf, Sdf, UsdGeom, Vt

FIELD = 12.0  # width of the field, whatever is in it
TRIANGLES = 1000  # of a prototype whose instances are counted in triangles
TEXTURE = 1024  # width of a texture: 4 MiB of texels with its smaller levels left out


class Made:
    """A layer that is filled prim by prim, without a stage that listens."""

    def __init__(self, file):
        self.layer = Sdf.Layer.CreateNew(file)
        self.layer.pseudoRoot.SetInfo(UsdGeom.Tokens.upAxis, "Y")

    def prim(self, path, kind):
        spec = Sdf.CreatePrimInLayer(self.layer, path)
        parent = spec.nameParent
        while parent and parent.specifier == Sdf.SpecifierOver:  # what is made on the way
            parent.specifier, parent = Sdf.SpecifierDef, parent.nameParent
        spec.specifier, spec.typeName = Sdf.SpecifierDef, kind
        return spec

    @staticmethod
    def set(spec, name, kind, value, uniform=False):
        made = Sdf.AttributeSpec(spec, name, kind, Sdf.VariabilityUniform if uniform else Sdf.VariabilityVarying)
        made.default = value
        return made

    def move(self, spec, place):
        self.set(spec, "xformOp:translate", Sdf.ValueTypeNames.Double3, Gf.Vec3d(*map(float, place)))
        self.set(spec, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, ["xformOp:translate"], uniform=True)

    @staticmethod
    def target(spec, name, path):
        Sdf.RelationshipSpec(spec, name, False).targetPathList.explicitItems = [path]

    def bind(self, spec, path):
        spec.SetInfo("apiSchemas", Sdf.TokenListOp.Create(prependedItems=["MaterialBindingAPI"]))
        self.target(spec, "material:binding", path)

    def material(self, path, color, image=None):
        self.prim(path, "Material")
        surface = self.prim(path + "/surface", "Shader")
        self.set(surface, "info:id", Sdf.ValueTypeNames.Token, "UsdPreviewSurface", uniform=True)
        self.set(surface, "inputs:diffuseColor", Sdf.ValueTypeNames.Color3f, Gf.Vec3f(*map(float, color)))
        self.set(surface, "outputs:surface", Sdf.ValueTypeNames.Token, None)
        self._connect(self.layer.GetPrimAtPath(path), "outputs:surface", Sdf.ValueTypeNames.Token,
                      path + "/surface.outputs:surface")
        if not image:
            return
        place, texture = self.prim(path + "/st", "Shader"), self.prim(path + "/image", "Shader")
        self.set(place, "info:id", Sdf.ValueTypeNames.Token, "UsdPrimvarReader_float2", uniform=True)
        self.set(place, "inputs:varname", Sdf.ValueTypeNames.String, "st")
        self.set(place, "outputs:result", Sdf.ValueTypeNames.Float2, None)
        self.set(texture, "info:id", Sdf.ValueTypeNames.Token, "UsdUVTexture", uniform=True)
        self.set(texture, "inputs:file", Sdf.ValueTypeNames.Asset, Sdf.AssetPath(image))
        self._connect(texture, "inputs:st", Sdf.ValueTypeNames.Float2, path + "/st.outputs:result")
        self.set(texture, "outputs:rgb", Sdf.ValueTypeNames.Float3, None)
        surface.attributes["inputs:diffuseColor"].connectionPathList.explicitItems = [path + "/image.outputs:rgb"]

    @staticmethod
    def _connect(spec, name, kind, source):
        Sdf.AttributeSpec(spec, name, kind).connectionPathList.explicitItems = [source]

    def mesh(self, path, columns, rows, width, depth, place=(0.0, 0.0, 0.0)):
        """A wavy cloth of 2 x columns x rows triangles around `place`, drawn as it is."""
        u, v = np.meshgrid(np.linspace(-0.5, 0.5, columns + 1), np.linspace(-0.5, 0.5, rows + 1))
        x, z = u.ravel() * width, v.ravel() * depth
        points = np.stack([x, 0.05 * np.sin(3.1 * x) * np.cos(2.3 * z + x), z], 1) + place
        first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
        faces = np.stack([first, first + columns + 1, first + columns + 2, first + 1], 1)
        spec = self.prim(path, "Mesh")
        self.set(spec, "points", Sdf.ValueTypeNames.Point3fArray, Vt.Vec3fArray.FromNumpy(points.astype(np.float32)))
        self.set(spec, "faceVertexCounts", Sdf.ValueTypeNames.IntArray, Vt.IntArray.FromNumpy(np.full(len(faces), 4, np.int32)))
        self.set(spec, "faceVertexIndices", Sdf.ValueTypeNames.IntArray, Vt.IntArray.FromNumpy(faces.ravel().astype(np.int32)))
        self.set(spec, "subdivisionScheme", Sdf.ValueTypeNames.Token, "none", uniform=True)
        st = np.stack([u.ravel() + 0.5, v.ravel() + 0.5], 1).astype(np.float32)
        held = self.set(spec, "primvars:st", Sdf.ValueTypeNames.TexCoord2fArray, Vt.Vec2fArray.FromNumpy(st))
        held.SetInfo("interpolation", "vertex")
        return spec

    def instancer(self, path, prototypes, places):
        """Instances of prims below it, in turn.
        :param prototypes: their paths"""
        spec = self.prim(path, "PointInstancer")
        relationship = Sdf.RelationshipSpec(spec, "prototypes", False)
        relationship.targetPathList.explicitItems = prototypes
        numbers = np.arange(len(places), dtype=np.int32) % len(prototypes)
        self.set(spec, "protoIndices", Sdf.ValueTypeNames.IntArray, Vt.IntArray.FromNumpy(numbers))
        self.set(spec, "positions", Sdf.ValueTypeNames.Point3fArray, Vt.Vec3fArray.FromNumpy(places.astype(np.float32)))

    def save(self):
        self.layer.Save()
        return self.layer.realPath


def places(count, height=0.3):
    """:returns: `count` places on a square grid over the field, at some heights; and the width of a cell"""
    side = math.ceil(math.sqrt(count))
    k = np.arange(count)
    return np.stack([((k % side + 0.5) / side - 0.5) * FIELD, height + 0.4 * ((k * 7919) % 13) / 13.0,
                     ((k // side + 0.5) / side - 0.5) * FIELD], 1), FIELD / side


def begin(folder, sky=True):
    made = Made(os.path.join(folder, "stage.usdc"))
    camera = made.prim("/camera", "Camera")
    made.set(camera, "focalLength", Sdf.ValueTypeNames.Float, 35.0)
    made.set(camera, "horizontalAperture", Sdf.ValueTypeNames.Float, 32.0)
    made.set(camera, "verticalAperture", Sdf.ValueTypeNames.Float, 24.0)
    turn = Gf.Matrix4d().SetRotate(Gf.Rotation(Gf.Vec3d(1, 0, 0), -30.0)) * Gf.Matrix4d().SetTranslate(Gf.Vec3d(0, 6, 10))
    made.set(camera, "xformOp:transform", Sdf.ValueTypeNames.Matrix4d, turn)
    made.set(camera, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, ["xformOp:transform"], uniform=True)
    made.mesh("/floor", 2, 2, 40.0, 40.0)
    if sky:
        made.set(made.prim("/sky", "DomeLight"), "inputs:intensity", Sdf.ValueTypeNames.Float, 1.0)
    return made


def triangles(folder, count):
    """Triangles of one mesh."""
    made, side = begin(folder), math.ceil(math.sqrt(count / 2))
    made.mesh("/cloth", side, side, FIELD, FIELD, (0.0, 0.3, 0.0))
    return made.save()


def instanced(folder, count):
    """Triangles of instances of one mesh of 1000."""
    made = begin(folder)
    at, width = places(max(1, count // TRIANGLES))
    made.instancer("/field", ["/field/leaf"], at)
    made.mesh("/field/leaf", 25, 20, 0.9 * width, 0.9 * width)
    return made.save()


def lights(folder, count):
    """Small spheres of light over the field, of the same power together."""
    made = begin(folder, sky=False)
    for i, place in enumerate(places(count, 0.8)[0]):
        light = made.prim(f"/lights/light{i}", "SphereLight")
        made.set(light, "inputs:radius", Sdf.ValueTypeNames.Float, 0.01)
        made.set(light, "inputs:intensity", Sdf.ValueTypeNames.Float, 60000.0 / count)
        made.move(light, place)
    return made.save()


def _quads(made, count):
    at, width = places(count)
    for i, place in enumerate(at):
        yield i, made.mesh(f"/quads/quad{i}", 1, 1, 0.9 * width, 0.9 * width, place)


def materials(folder, count):
    """A quad for each material, of a colour of its own."""
    made, random = begin(folder), np.random.default_rng(3)
    for i, spec in _quads(made, count):
        made.material(f"/materials/m{i}", random.uniform(0.1, 0.8, 3))
        made.bind(spec, f"/materials/m{i}")
    return made.save()


def prims(folder, count):
    """Meshes of two triangles."""
    made = begin(folder)
    for _ in _quads(made, count):
        pass
    return made.save()


def prototypes(folder, count):
    """Prototypes of two triangles, with an instance each."""
    made = begin(folder)
    at, width = places(count)
    paths = [f"/field/leaf{i}" for i in range(count)]
    made.instancer("/field", paths, at)
    for path in paths:
        made.mesh(path, 1, 1, 0.9 * width, 0.9 * width)
    return made.save()


def instances(folder, count):
    """Prims that are instances of one prim (instanceable)."""
    made = begin(folder)
    at, width = places(count)
    spec = Sdf.CreatePrimInLayer(made.layer, "/class/leaf")
    made.layer.GetPrimAtPath("/class").specifier = spec.specifier = Sdf.SpecifierClass
    made.mesh("/class/leaf/mesh", 1, 1, 0.9 * width, 0.9 * width)
    for i, place in enumerate(at):
        instance = made.prim(f"/field/leaf{i}", "Xform")
        instance.instanceable = True
        instance.referenceList.explicitItems = [Sdf.Reference("", "/class/leaf")]
        made.move(instance, place)
    return made.save()


def textures(folder, count):
    """A quad for each texture of 1024 x 1024 texels."""
    from patina.cli import compiled

    made, random = begin(folder), np.random.default_rng(5)
    for i, spec in _quads(made, count):
        file = os.path.join(folder, f"image{i}.png")
        compiled.load().write_image(file, np.kron(random.random((64, 64, 3)), np.ones((TEXTURE // 64,) * 2 + (1,)))
                                    .astype(np.float32))
        made.material(f"/materials/m{i}", (0.5, 0.5, 0.5), file)
        made.bind(spec, f"/materials/m{i}")
    return made.save()


def splats(folder, count):
    """Gaussian kernels with harmonics of degree 3, flat ones that lie on a cloth and overlap as those of captures do."""
    made, random = begin(folder), np.random.default_rng(7)
    at, width = places(count)
    at += random.uniform(-0.5, 0.5, at.shape) * (width, 0, width)
    at[:, 1] = 0.5 + 0.3 * np.sin(3.1 * at[:, 0]) * np.cos(2.3 * at[:, 2])
    spec = made.prim("/splats", "ParticleField3DGaussianSplat")
    kinds = Sdf.ValueTypeNames
    turns = random.normal(0, (0.1, 0.3, 0.1), (count, 3))
    harmonics = random.normal(0, 0.1, (count, 16, 3))
    harmonics[:, 0] = random.uniform(-1.5, 1.5, (count, 3))
    for name, kind, values in (("positions", kinds.Point3fArray, at), ("scales", kinds.Float3Array, np.tile(
            (width, 0.1 * width, width), (count, 1))), ("radiance:sphericalHarmonicsCoefficients", kinds.Float3Array,
                                                        harmonics.reshape(-1, 3))):
        made.set(spec, name, kind, Vt.Vec3fArray.FromNumpy(values.astype(np.float32)))
    made.set(spec, "orientations", kinds.QuatfArray, Vt.QuatfArray([Gf.Quatf(1, *map(float, turn)) for turn in turns]))
    made.set(spec, "opacities", kinds.FloatArray, Vt.FloatArray.FromNumpy(random.uniform(0.2, 1, count).astype(np.float32)))
    return made.save()


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
