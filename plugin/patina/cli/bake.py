# SPDX-License-Identifier: Apache-2.0
"""Writes a material as another shading model, for programs that know only that one.

Inputs that vary over the surface become textures over uv 0 to 1, the others stay values. OUT.usda
gets one Material, and the textures are written beside it. Patterns that read positions are baked as on
a unit square in the xy plane. Primvars other than texture coordinates have their defaults.

Colours are written as 8 bit sRGB PNG or half float EXR, everything else as raw numbers. Normals are in
the tangent frame. Numbers above 1 need EXR.

OUT.usda may not be a file that the command reads, unless --in-place is given. Then the material is
replaced in that file, and everything else in it stays.
"""
import os

import numpy as np

from patina import limits, networks
from patina.cli import bakeOutput, materials, outputs, statistics
from patina.cli.compiled import _patina
from patina.cli.bakeOutput import NORMALS
from patina.cli.errors import CommandError, UsageError

TARGETS = ("UsdPreviewSurface", "gltf_pbr", "standard_surface", "open_pbr_surface")
# Directions whose textures are of no use.
TANGENTS = ("tangent", "geometry_tangent", "geometry_coat_tangent")
BATCH = 1 << 18
_MOST_MATERIAL_NODES = 8  # between a terminal and its surface, as the translation follows them


def add_arguments(parser):
    parser.add_argument("material", metavar="MATERIAL", help=materials.MATERIAL_HELP)
    parser.add_argument("output", metavar="OUT.usda", help="stage to write (.usda, .usdc or .usd)")
    parser.add_argument("--to", required=True, choices=TARGETS, metavar="MODEL",
                        help="shading model: " + ", ".join(TARGETS))
    parser.add_argument("--resolution", type=int, default=1024, metavar="N",
                        help="width and height of textures, 1 to 16384 (default: 1024)")
    parser.add_argument("--format", default="png", choices=["png", "exr"], help="format of the textures (default: png)")
    parser.add_argument("--in-place", action="store_true", dest="in_place",
                        help="OUT may be the stage itself, one of its layers or any other: all other prims in it stay")
    limits.add_flag(parser)
    parser.add_argument("--set", action="append", default=[], metavar="PRIM.INPUT=VALUE",
                        help="change an input before (repeatable)")


def run(arguments):
    if not 1 <= arguments.resolution <= 16384:
        raise UsageError("patina bake: --resolution is 1 to 16384")
    if os.path.splitext(arguments.output)[1].lower() not in bakeOutput.EXTENSIONS:
        raise UsageError("patina bake: OUT ends in .usda, .usdc or .usd")
    if arguments.in_place:
        bakeOutput.check_in_place(arguments.output)
    found, warnings = materials.load(arguments.material, arguments.set)
    name, network = found[0]
    if not arguments.in_place:
        outputs.check(arguments.output, bakeOutput.EXTENSIONS)
    translated = _patina.translate_material(network, arguments.to, warnings)
    if translated.empty:
        raise CommandError(f"{arguments.material}: {warnings[-1]['message'] if warnings else 'nothing to bake'}")
    inputs = evaluate(translated, arguments.to, arguments.resolution, warnings)
    bakeOutput.write(arguments, name, inputs, warnings)
    statistics.report(warnings, json=False)


def evaluate(network, target, resolution, warnings):
    """Values of the surface's inputs that are not the target's defaults.

    :returns: name -> (type, number, text, tuple, or array of height x width x channels)
    """
    types = _patina.node_inputs(target)
    defaults = _patina.node_defaults(target)
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
    for _ in range(_MOST_MATERIAL_NODES):
        if "surfaceshader" not in node["connections"]:
            break
        node = nodes[node["connections"]["surfaceshader"][0]]
    if "surfaceshader" in node["connections"]:
        raise CommandError(f"{network.path}: more than {_MOST_MATERIAL_NODES} connections of surfaceshader follow each other, "
                           f"or they lead back to {path}")
    return node


def _image(network, source, output, kind, resolution, warnings):
    """The values of an output over the unit square, rows from the top; None for text."""
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
    copy, read = networks.copied(network), (source, output)
    if kind in ("integer", "boolean"):
        read = networks.add(copy, "/bake/number", f"ND_convert_{kind}_color3", **{"in": read})
    value = networks.add(copy, "/bake/value", "ND_multiply_color3", {"in2": ("color3", [sign, sign, sign])}, in1=read)
    light = networks.add(copy, "/bake/light", "ND_uniform_edf", color=value)
    copy.set_terminal("surface", networks.add(copy, "/bake/surface", "ND_surface", edf=light))
    return _patina.MaterialProbe(copy)


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
