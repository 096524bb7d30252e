# SPDX-License-Identifier: Apache-2.0
"""Writes a baked material: one shader with values and textures, in the words of a shading model. Stage and
textures appear together, or nothing is changed."""
import hashlib
import os
import re

import numpy as np

from patina import messages
from patina.chart.png import display_values
from patina.cli import materials, outputs, tryStage
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError
from patina.cli.usd import TYPES, Sdf, Usd, UsdShade, reader

EXTENSIONS = (".usda", ".usdc", ".usd")
# Vectors that are directions.
NORMALS = ("normal", "coat_normal", "clearcoat_normal", "geometry_normal", "geometry_coat_normal")


def check_in_place(output):
    """Says early why --in-place could not open OUT, or not write it. Nothing is read yet, so it may be any file that is.

    :raises CommandError: where it is no regular file, OpenUSD dies of it, or no file can be written there"""
    outputs.check(output, EXTENSIONS)
    problem = tryStage.why_trial_fails(output) if os.path.exists(output) else ""
    if problem:
        raise CommandError(f"{output} {problem}")


def write(arguments, name, inputs, warnings):
    """Writes the stage and its textures.

    :param name: of the material: a path on its stage, or a name in its document
    :param inputs: what bake.evaluate() gave"""
    base = re.sub(r"[^A-Za-z0-9_]+", "_", name.rpartition("/")[2]) or "material"
    base = "_" + base if base[0].isdigit() else base
    with outputs.Together() as files:
        present = _present(arguments.output) if arguments.in_place and os.path.exists(arguments.output) else None
        path = _path_in(present, base, name)
        textures = _Textures(arguments, files, present, path, name, inputs)
        made = _layer_of(arguments, base, textures, inputs, warnings)
        if present:
            made = _merged(arguments, made, base, present, path)
        _export(made, files.add(arguments.output, arguments.in_place, EXTENSIONS), arguments.output)


def _present(output):
    """:returns: the layer of OUT, which is there"""
    layer, problem = reader.compat.attempt(Sdf.Layer.FindOrOpen, output)
    if layer is None:
        raise CommandError(f"{output} cannot be opened: {problem or 'it is no USD file'}")
    return layer


def _path_in(layer, base, name):
    """:param layer: of OUT, None for a new one
    :returns: path of the material there"""
    there = layer is not None and name.startswith("/") and Sdf.Path.IsValidPathString(name)
    return Sdf.Path(name if there else f"/{base}")


class _Textures:
    """Names of textures, and the files that they are written to. Those of other materials of OUT stay."""

    def __init__(self, arguments, files, layer, path, name, inputs):
        """:param layer: of OUT where it is changed in place and there, else None
        :param path: of the material in it; :param name: of the material where it is read"""
        self._arguments, self._files, self._path = arguments, files, str(path)
        self._readers = _readers(layer, path) if layer else {}
        self.stem = os.path.splitext(os.path.basename(arguments.output))[0]
        if arguments.in_place:  # other materials of the file have textures too
            self.stem += "_" + re.sub(r"[^A-Za-z0-9_]+", "_", name).strip("_")
            varying = [key for key, (_, value) in inputs.items() if isinstance(value, np.ndarray) and value.ndim == 3]
            if any(self._others(key) for key in varying):  # of /a_b and /a/b, or of names that are not ASCII
                self.stem += "_" + hashlib.sha256(name.encode()).hexdigest()[:8]

    def name(self, key):
        return f"{self.stem}_{key}.{self._arguments.format}"

    def add(self, key):
        """:returns: the path to write the texture of an input to
        :raises CommandError: where another material, or this command from elsewhere, reads the file that it would replace"""
        file, others = self._file(key), self._others(key)
        if others:
            raise CommandError(f"cannot write '{file}': {others[0]} of {self._arguments.output} reads it; rename the file "
                               "that it reads")
        return self._files.add(file, self._path in self._readers.get(os.path.realpath(file), ()))

    def _file(self, key):
        return os.path.join(os.path.dirname(self._arguments.output), self.name(key))

    def _others(self, key):
        """:returns: sorted paths of other materials of OUT that read the file"""
        return sorted(self._readers.get(os.path.realpath(self._file(key)), set()) - {self._path})


def _readers(layer, path):
    """:param path: of the material that is replaced: what is below it is its own
    :returns: dict of a file that the layer names -> paths of the materials that do, or of the prims where these are none"""
    found, folder = {}, os.path.dirname(layer.realPath)

    def visit(place):
        attribute = layer.GetAttributeAtPath(place) if place.IsPropertyPath() else None
        if not attribute:
            return
        values = [attribute.default, *(layer.QueryTimeSample(place, t) for t in layer.ListTimeSamplesForPath(place))]
        for value in values:
            assets = value if isinstance(value, Sdf.AssetPathArray) else [value]
            for asset in (asset for asset in assets if isinstance(asset, Sdf.AssetPath) and asset.path):
                file = os.path.realpath(os.path.join(folder, asset.path))
                found.setdefault(file, set()).add(str(_material_of(layer, place.GetPrimPath(), path)))

    layer.Traverse("/", visit)
    return found


def _material_of(layer, prim, path):
    """:returns: path of the material that a prim is part of, else its own; without the variants that hold it"""
    plain = prim.StripAllVariantSelections()
    if plain.HasPrefix(path):
        return path
    while not prim.IsAbsoluteRootPath():
        spec = layer.GetPrimAtPath(prim)
        if spec and spec.typeName == "Material":
            return prim.StripAllVariantSelections()
        prim = prim.GetParentPath()
    return plain


def _layer_of(arguments, base, textures, inputs, warnings):
    """:returns: an anonymous layer that holds the material alone, at /base; textures go to `textures`"""
    layer = Sdf.Layer.CreateAnonymous("baked.usda")
    stage = Usd.Stage.Open(layer)
    material = UsdShade.Material.Define(stage, f"/{base}")
    stage.SetDefaultPrim(material.GetPrim())
    writer = _Preview if arguments.to == "UsdPreviewSurface" else _MaterialX
    shader = writer(stage, material, arguments.to)
    for name in sorted(inputs):
        kind, value = inputs[name]
        if isinstance(value, np.ndarray) and value.ndim == 3:
            file, space = _texture(arguments, textures, name, kind, value, warnings)
            shader.texture(name, kind, file, space)
        elif name in NORMALS:
            shader.normal(name, value)
        else:
            shader.value(name, kind, value)
    return layer


def _merged(arguments, made, base, layer, path):
    """:returns: a copy of OUT's layer with the material in the place of the one that was baked; not saved"""
    changed = Sdf.Layer.CreateAnonymous("merged" + os.path.splitext(arguments.output)[1])
    changed.TransferContent(layer)
    Sdf.CreatePrimInLayer(changed, path)
    if not Sdf.CopySpec(made, Sdf.Path(f"/{base}"), changed, path):
        raise CommandError(f"{path} cannot be replaced in {arguments.output}")
    _check_strength(arguments, layer, changed, path)
    return changed


def _check_strength(arguments, layer, changed, path):
    """:raises CommandError: where what stronger layers say of the material hides what was baked"""
    file = materials.split(arguments.material)[0]
    if materials.is_document(file):
        return
    before = Sdf.Layer.CreateAnonymous()
    before.TransferContent(layer)
    try:
        layer.TransferContent(changed)
        stage = Usd.Stage.Open(file)
        if stage and layer not in stage.GetUsedLayers():
            return
        material = UsdShade.Material(stage.GetPrimAtPath(path)) if stage else None
        context = "" if arguments.to == "UsdPreviewSurface" else "mtlx"
        found = material.ComputeSurfaceSource(context) if material else ()
        shader = found[0] if isinstance(found, tuple) and found else found
        if not shader or shader.GetPath() != path.AppendChild("surface"):
            raise CommandError(f"--in-place: other layers hide what {arguments.output} says of {path}")
    finally:
        layer.TransferContent(before)


def _export(layer, temporary, output):
    good, problem = reader.compat.attempt(layer.Export, temporary)
    if not good:
        raise CommandError(f"cannot write '{output}': {problem or 'no reason was given'}")


def _texture(arguments, textures, name, kind, image, warnings):
    """Writes an image. :returns: its file name beside the stage, and its colour space"""
    color = kind == "color3"
    pixels = image
    if name in NORMALS:
        pixels = image * 0.5 + 0.5
    if pixels.shape[2] == 1:
        pixels = np.repeat(pixels, 3, axis=2)
    png = arguments.format == "png"
    if png and (pixels.max() > 1.0 + 1e-4 or pixels.min() < -1e-4):
        warnings.append(messages.warning(textures.stem, name, "pngCutsOff"))
    if png and color:
        pixels = display_values(pixels)
    # sRGB is applied above, so that no display transform stands between a colour and its file.
    options = {"raw": True, "bits": 16 if name in NORMALS else 8} if png else {"half": True}
    _patina.write_image(textures.add(name), np.ascontiguousarray(pixels, np.float32), options=options)
    return textures.name(name), "sRGB" if png and color else "raw"


def _sdf(kind):
    return Sdf.ValueTypeNames.Find(TYPES[kind])


def _plain(kind, value):
    if kind == "integer":
        return int(round(value))
    if kind == "boolean":
        return bool(value >= 0.5)
    return tuple(value) if isinstance(value, (list, tuple)) else value


class _Network:
    """A material that is one shader with textures; classes below know how these are spelled."""

    def __init__(self, stage, material, model, identifier, output):
        self.stage, self.material = stage, material
        self.shader = UsdShade.Shader.Define(stage, material.GetPath().AppendChild("surface"))
        self.shader.CreateIdAttr(identifier)
        self.shader.CreateOutput(output, Sdf.ValueTypeNames.Token)

    def node(self, name, identifier):
        shader = UsdShade.Shader.Define(self.stage, self.material.GetPath().AppendChild(name))
        shader.CreateIdAttr(identifier)
        return shader

    def input(self, name, kind):
        return self.shader.CreateInput(name, _sdf(kind))

    def value(self, name, kind, value):
        self.input(name, kind).Set(_plain(kind, value))


class _Preview(_Network):
    def __init__(self, stage, material, model):
        super().__init__(stage, material, model, model, "surface")
        self.material.CreateSurfaceOutput().ConnectToSource(self.shader.ConnectableAPI(), "surface")
        self.reader = None

    def normal(self, name, value):
        self.shader.CreateInput(name, Sdf.ValueTypeNames.Normal3f).Set(tuple(value))

    def value(self, name, kind, value):
        if name == "opacityMode":  # a word here, a number in MaterialX
            self.shader.CreateInput(name, Sdf.ValueTypeNames.Token).Set("presence" if value >= 0.5 else "transparent")
        else:
            super().value(name, kind, value)

    def texture(self, name, kind, file, space):
        types = Sdf.ValueTypeNames
        if self.reader is None:
            self.reader = self.node("uv", "UsdPrimvarReader_float2")
            self.reader.CreateInput("varname", types.String).Set("st")
            self.reader.CreateOutput("result", types.Float2)
        node = self.node(name + "_texture", "UsdUVTexture")
        node.CreateInput("file", types.Asset).Set(Sdf.AssetPath("./" + file))
        node.CreateInput("sourceColorSpace", types.Token).Set(space)
        node.CreateInput("wrapS", types.Token).Set("repeat")
        node.CreateInput("wrapT", types.Token).Set("repeat")
        node.CreateInput("st", types.Float2).ConnectToSource(self.reader.ConnectableAPI(), "result")
        if name in NORMALS:
            node.CreateInput("scale", types.Float4).Set((2, 2, 2, 1))
            node.CreateInput("bias", types.Float4).Set((-1, -1, -1, 0))
        output = "r" if kind == "float" else "rgb"
        node.CreateOutput(output, types.Float if kind == "float" else types.Float3)
        target = types.Normal3f if name in NORMALS else _sdf(kind)
        self.shader.CreateInput(name, target).ConnectToSource(node.ConnectableAPI(), output)


class _MaterialX(_Network):
    def __init__(self, stage, material, model):
        super().__init__(stage, material, model, f"ND_{model}_surfaceshader", "out")
        self.material.CreateSurfaceOutput("mtlx").ConnectToSource(self.shader.ConnectableAPI(), "out")

    def normal(self, name, value):
        self._bend(name).CreateInput("in", _sdf("vector3")).Set(tuple(0.5 * x + 0.5 for x in value))

    def _bend(self, name):
        node = self.node(name + "_map", "ND_normalmap_float")
        node.CreateOutput("out", _sdf("vector3"))
        self.input(name, "vector3").ConnectToSource(node.ConnectableAPI(), "out")
        return node

    def texture(self, name, kind, file, space):
        node = self.node(name + "_texture", f"ND_image_{kind}")
        asset = node.CreateInput("file", Sdf.ValueTypeNames.Asset)
        asset.Set(Sdf.AssetPath("./" + file))
        asset.GetAttr().SetColorSpace("srgb_texture" if space == "sRGB" else "lin_rec709" if kind == "color3"
                                      else "raw")
        node.CreateOutput("out", _sdf(kind))
        target = self._bend(name).CreateInput("in", _sdf("vector3")) if name in NORMALS else self.input(name, kind)
        target.ConnectToSource(node.ConnectableAPI(), "out")
