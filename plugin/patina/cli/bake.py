"""Writes a material in the words of another shading model, for programs that know only that one.

Inputs that vary over the surface become textures over uv 0 to 1, the others stay values. OUT.usda
gets one Material; the textures lie beside it. Patterns that read positions are baked as they are on
a unit square in the xy plane; primvars other than texture coordinates as their defaults.

Colours are written as 8 bit sRGB PNG or half float EXR, everything else as raw numbers. Normals are
those of the tangent frame. Numbers beyond 1 need EXR.
"""
import os
import re
import sys

import numpy as np

from patina.cli import compiled, materials, statistics
from patina.cli.errors import CommandError, UsageError

TARGETS = ("UsdPreviewSurface", "gltf_pbr", "standard_surface", "open_pbr_surface")
# Vectors that are directions; tangents are left out, because textures of them are of no use.
NORMALS = ("normal", "coat_normal", "clearcoat_normal", "geometry_normal", "geometry_coat_normal")
TANGENTS = ("tangent", "geometry_tangent", "geometry_coat_tangent")
BATCH = 1 << 18


def add_arguments(parser):
    parser.add_argument("material", metavar="MATERIAL", help=materials.MATERIAL_HELP)
    parser.add_argument("output", metavar="OUT.usda", help="stage to write (.usda, .usdc or .usd)")
    parser.add_argument("--to", required=True, choices=TARGETS, metavar="MODEL",
                        help="shading model: " + ", ".join(TARGETS))
    parser.add_argument("--resolution", type=int, default=1024, metavar="N",
                        help="width and height of textures, 1 to 16384 (default: 1024)")
    parser.add_argument("--format", default="png", choices=["png", "exr"], help="of textures (default: png)")
    parser.add_argument("--set", action="append", default=[], metavar="PRIM.INPUT=VALUE",
                        help="change an input before (repeatable)")


def run(arguments):
    if not 1 <= arguments.resolution <= 16384:
        raise UsageError("patina bake: --resolution is 1 to 16384")
    if os.path.splitext(arguments.output)[1].lower() not in (".usda", ".usdc", ".usd"):
        raise UsageError("patina bake: OUT ends in .usda, .usdc or .usd")
    folder = os.path.dirname(arguments.output) or "."
    if not os.path.isdir(folder):
        raise CommandError(f"there is no folder {folder}")
    found, warnings = materials.load(arguments.material, arguments.set)
    name, network = found[0]
    translated = compiled.load().translate_material(network, arguments.to, warnings)
    if translated.empty:
        raise CommandError(f"{arguments.material}: {warnings[-1]['message'] if warnings else 'nothing to bake'}")
    inputs = evaluate(translated, arguments.to, arguments.resolution, warnings)
    base = re.sub(r"\W+", "_", name.rpartition("/")[2]) or "material"
    write(arguments, base, inputs, warnings)
    statistics.tell(warnings, sys.stderr)


def evaluate(network, target, resolution, warnings):
    """Values of the surface's inputs that are not the target's defaults.

    :returns: name -> (type, number, text, tuple, or array of height x width x channels)
    """
    module = compiled.load()
    types = module.node_inputs(target)
    defaults = module.node_defaults(target)
    surface = _surface(network)
    inputs = {}
    for name, value in surface["inputs"].items():
        if name not in surface["connections"] and name in types:
            inputs[name] = (types[name], _compact(value["value"]))
    for name, (source, output) in surface["connections"].items():
        kind = types.get(name)
        if kind is None or name in TANGENTS:
            continue
        image = _image(network, source, output, kind, resolution, warnings)
        if image is not None:
            inputs[name] = (kind, _constant(image, kind))
    straight = np.array([0.0, 0.0, 1.0], np.float32)
    return {name: (kind, value) for name, (kind, value) in inputs.items()
            if not _same(value, straight if name in NORMALS else defaults.get(name))}


def _surface(network):
    path = network.terminals()["surface"][0]
    nodes = {node["path"]: node for node in network.nodes()}
    node = nodes[path]
    while "surfaceshader" in node["connections"]:
        node = nodes[node["connections"]["surfaceshader"][0]]
    return node


def _image(network, source, output, kind, resolution, warnings):
    """What an output gives over the unit square, rows from the top; None for text."""
    if kind in ("string", "filename"):
        return None
    probes = [_probe(network, source, output, kind, sign) for sign in (1, -1)]
    for warning in probes[0].warnings:
        if warning not in warnings:
            warnings.append(warning)
    n = resolution
    if all(probe.constant for probe in probes) and not any(probe.uses_uv for probe in probes):
        n = 1
    places = (np.arange(n, dtype=np.float32) + 0.5) / n
    u, v = np.meshgrid(places, places[::-1])
    uv = np.stack([u.ravel(), v.ravel()], axis=1).astype(np.float32)
    positive, negative = (np.concatenate([probe.emission_at(uv[i:i + BATCH], 1.0 / n)
                                          for i in range(0, len(uv), BATCH)]) for probe in probes)
    image = (positive - negative).reshape(n, n, 3)
    return image if kind in ("color3", "vector3") else image[:, :, :1]


def _probe(network, source, output, kind, sign):
    """Light is never negative, so a value is what it gives as light less what its negative gives."""
    module = compiled.load()
    copy = module.Network(network.path)
    for node in network.nodes():
        copy.add_node(node["path"], node["id"])
        for name, value in node["inputs"].items():
            copy.set_input(node["path"], name, value["type"], value["value"], value["color_space"])
        for name, (other, port) in node["connections"].items():
            copy.connect(node["path"], name, other, port)
    top = "/bake"
    if kind in ("integer", "boolean"):
        copy.add_node(top + "/number", f"ND_convert_{kind}_color3")
        copy.connect(top + "/number", "in", source, output)
        source, output = top + "/number", ""
    copy.add_node(top + "/value", "ND_multiply_color3")
    copy.connect(top + "/value", "in1", source, output)
    copy.set_input(top + "/value", "in2", "color3", [sign, sign, sign])
    copy.add_node(top + "/light", "ND_uniform_edf")
    copy.connect(top + "/light", "color", top + "/value")
    copy.add_node(top + "/surface", "ND_surface")
    copy.connect(top + "/surface", "edf", top + "/light")
    copy.set_terminal("surface", top + "/surface")
    return module.MaterialProbe(copy)


def _constant(image, kind):
    """A value where the image is the same everywhere. Modes cannot vary: the highest is taken."""
    first = image[0, 0]
    if kind in ("integer", "boolean"):
        return float(image.max())
    if np.abs(image - first).max() <= 1e-6:
        return _compact(first.tolist())
    return image


def _compact(value):
    return value[0] if isinstance(value, list) and len(value) == 1 else value


def _same(value, default):
    if default is None or (isinstance(value, np.ndarray) and value.ndim == 3):
        return False
    if isinstance(value, str) or isinstance(default, str):
        return value == default
    a, b = np.ravel(value).astype(float), np.ravel(default).astype(float)
    return len(a) == len(b) and bool(np.abs(a - b).max() <= 1e-6)


def _texture(arguments, base, name, kind, image, warnings):
    """Writes an image. :returns: its file name beside the stage, and its colour space"""
    module = compiled.load()
    color = kind == "color3"
    pixels = image
    if name in NORMALS:
        pixels = image * 0.5 + 0.5
    if pixels.shape[2] == 1:
        pixels = np.repeat(pixels, 3, axis=2)
    png = arguments.format == "png"
    if png and (pixels.max() > 1.0 + 1e-4 or pixels.min() < -1e-4):
        warnings.append({"prim": base, "input": name, "count": 1,
                         "message": "numbers outside 0 to 1 are cut off in PNG (take --format exr)"})
    if png and color:
        pixels = np.where(pixels <= 0.0031308, 12.92 * pixels,
                          1.055 * np.power(np.maximum(pixels, 0.0031308), 1 / 2.4) - 0.055)
    stem = os.path.splitext(os.path.basename(arguments.output))[0]
    file = f"{stem}_{name}.{arguments.format}"
    path = os.path.join(os.path.dirname(arguments.output), file)
    # sRGB is applied above, so that no display transform stands between a colour and its file.
    options = {"raw": True, "bits": 16 if name in NORMALS else 8} if png else {"half": True}
    module.write_image(path, np.ascontiguousarray(pixels, np.float32), options=options)
    return file, "sRGB" if png and color else "raw"


def write(arguments, base, inputs, warnings):
    """Writes the stage and its textures."""
    from pxr import Sdf, Usd, UsdShade

    if os.path.exists(arguments.output):
        os.remove(arguments.output)
    layer = Sdf.Layer.CreateNew(arguments.output)
    if layer is None:
        raise CommandError(f"{arguments.output} cannot be written")
    stage = Usd.Stage.Open(layer)
    base = base if Sdf.Path.IsValidIdentifier(base) else "_" + base
    material = UsdShade.Material.Define(stage, f"/{base}")
    stage.SetDefaultPrim(material.GetPrim())
    writer = _Preview if arguments.to == "UsdPreviewSurface" else _MaterialX
    shader = writer(stage, material, arguments.to)
    for name in sorted(inputs):
        kind, value = inputs[name]
        if isinstance(value, np.ndarray) and value.ndim == 3:
            file, space = _texture(arguments, base, name, kind, value, warnings)
            shader.texture(name, kind, file, space)
        elif name in NORMALS:
            shader.normal(name, value)
        else:
            shader.value(name, kind, value)
    layer.Save()


def _sdf(kind):
    from pxr import Sdf

    return {"float": Sdf.ValueTypeNames.Float, "color3": Sdf.ValueTypeNames.Color3f,
            "vector2": Sdf.ValueTypeNames.Float2, "vector3": Sdf.ValueTypeNames.Float3,
            "integer": Sdf.ValueTypeNames.Int, "boolean": Sdf.ValueTypeNames.Bool,
            "string": Sdf.ValueTypeNames.String}[kind]


def _plain(kind, value):
    if kind == "integer":
        return int(round(value))
    if kind == "boolean":
        return bool(value >= 0.5)
    return tuple(value) if isinstance(value, (list, tuple)) else value


class _Network:
    """A material that is one shader with textures; classes below know how these are spelled."""

    def __init__(self, stage, material, model, identifier, output):
        from pxr import Sdf, UsdShade

        self.stage, self.material = stage, material
        self.shader = UsdShade.Shader.Define(stage, material.GetPath().AppendChild("surface"))
        self.shader.CreateIdAttr(identifier)
        self.shader.CreateOutput(output, Sdf.ValueTypeNames.Token)

    def node(self, name, identifier):
        from pxr import UsdShade

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
        from pxr import Sdf

        self.shader.CreateInput(name, Sdf.ValueTypeNames.Normal3f).Set(tuple(value))

    def texture(self, name, kind, file, space):
        from pxr import Sdf

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
        from pxr import Sdf

        node = self.node(name + "_texture", f"ND_image_{kind}")
        asset = node.CreateInput("file", Sdf.ValueTypeNames.Asset)
        asset.Set(Sdf.AssetPath("./" + file))
        asset.GetAttr().SetColorSpace("srgb_texture" if space == "sRGB" else "lin_rec709" if kind == "color3"
                                      else "raw")
        node.CreateOutput("out", _sdf(kind))
        target = self._bend(name).CreateInput("in", _sdf("vector3")) if name in NORMALS else self.input(name, kind)
        target.ConnectToSource(node.ConnectableAPI(), "out")
