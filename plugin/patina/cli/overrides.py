# SPDX-License-Identifier: Apache-2.0
"""--set PRIM.INPUT=VALUE: changes inputs of a stage in its session layer, before anything reads it."""
import math
import re

from patina.cli.compiled import _patina
from patina.cli.errors import CommandError, UsageError
from patina.cli.usd import TYPES, Gf, Sdf, Tf, Usd, UsdShade

SET_HELP = ("change an input (repeatable). PRIM is the path of a shader, light, material or any other prim; for a "
            "material the inputs are those of its surface shader. VALUE is 0.5 or 1,0,0 or text; what the input was "
            "connected to is cut off")

_ITEM = re.compile(r"(?P<prim>/[^=]*?)\.(?P<name>[A-Za-z_][\w:]*)=(?P<value>.*)", re.DOTALL)


def parse(texts):
    """:returns: list of (prim path, input, text)"""
    parsed = []
    for text in texts:
        match = _ITEM.fullmatch(text)
        if not match:
            raise UsageError(f"patina: --set {text}: write it as /prim/path.input=value")
        name = match["name"]
        parsed.append((match["prim"], name[len("inputs:"):] if name.startswith("inputs:") else name, match["value"]))
    return parsed


def apply(stage, texts):
    """Authors all overrides in the session layer."""
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        for path, name, value in parse(texts):
            _apply(stage, path, name, value)


def _apply(stage, path, name, text):
    if not Sdf.Path.IsValidPathString(path):
        raise CommandError(f"--set: {path} is no prim path")
    prim = stage.GetPrimAtPath(path)
    if not prim:
        raise CommandError(f"--set: there is no prim {path}")
    if prim.IsInstanceProxy():
        raise CommandError(f"--set: {path} is inside an instance: change the prim that is instanced")
    attribute = _attribute(prim, name)
    if attribute is None:
        raise CommandError(f"--set: {path} has no input {name}")
    try:
        attribute.Set(_value(attribute.GetTypeName(), text, f"{path}.{name}"))
    except (OverflowError, TypeError, ValueError, Tf.ErrorException):  # a byte takes no 300
        raise CommandError(f"--set {path}.{name}: '{text}' is no {attribute.GetTypeName()}") from None
    if UsdShade.Input.IsInput(attribute):
        attribute.SetConnections([])


def _attribute(prim, name):
    """:returns: the attribute that an input's name means, or None"""
    for candidate in ("inputs:" + name, name):
        attribute = prim.GetAttribute(candidate)
        if attribute:
            return attribute
    if prim.IsA(UsdShade.Material):
        # The universal surface, where there is none for this context.
        source = UsdShade.Material(prim).ComputeSurfaceSource("mtlx")
        shader = source[0] if isinstance(source, tuple) else source
        if shader and shader.GetPrim() != prim:
            return _attribute(shader.GetPrim(), name)
    if prim.IsA(UsdShade.Shader):
        kind = _defined_type(UsdShade.Shader(prim).GetIdAttr().Get(), name)
        if kind is not None:
            return UsdShade.Shader(prim).CreateInput(name, kind).GetAttr()
    return None


def _defined_type(node, name):
    """:returns: the Sdf type of an input that is not authored, by the node's definition; or None"""
    kind = _patina.node_inputs(node or "").get(name)
    return Sdf.ValueTypeNames.Find(TYPES[kind]) if kind in TYPES else None


def _value(type_name, text, target):
    """:returns: text as a value of an Sdf type"""
    default = type_name.defaultValue
    plain = text.strip()
    if isinstance(default, str):
        return text
    if isinstance(default, Sdf.AssetPath):
        return Sdf.AssetPath(plain.strip("@"))
    if isinstance(default, bool):
        if plain.lower() in ("1", "true", "on", "yes"):
            return True
        if plain.lower() in ("0", "false", "off", "no"):
            return False
        raise CommandError(f"--set {target}: '{text}' is neither true nor false")
    try:
        numbers = [float(word) for word in plain.strip("()[]").replace(",", " ").split()]
    except ValueError:
        raise CommandError(f"--set {target}: '{text}' is no {type_name}") from None
    if isinstance(default, (int, float)):
        if len(numbers) != 1:
            raise CommandError(f"--set {target}: one number is wanted, not '{text}'")
        if not isinstance(default, int):
            return numbers[0]
        if not math.isfinite(numbers[0]):
            raise CommandError(f"--set {target}: '{text}' is no integer")
        return int(numbers[0])
    if isinstance(default, (Gf.Vec2f, Gf.Vec3f, Gf.Vec4f, Gf.Vec2d, Gf.Vec3d, Gf.Vec4d, Gf.Vec2h, Gf.Vec3h, Gf.Vec4h)):
        size = len(default)
        if len(numbers) == 1:  # a grey
            numbers *= size
        if len(numbers) != size:
            raise CommandError(f"--set {target}: {size} numbers are wanted, not '{text}'")
        return type(default)(*numbers)
    if isinstance(default, (Gf.Matrix3d, Gf.Matrix4d)):
        size = default.dimension[0]
        if len(numbers) != size * size:
            raise CommandError(f"--set {target}: {size * size} numbers are wanted, not '{text}'")
        return type(default)(*numbers)
    raise CommandError(f"--set {target}: inputs of type {type_name} cannot be set here")
