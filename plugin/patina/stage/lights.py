# SPDX-License-Identifier: Apache-2.0
"""UsdLux lights."""
import _patina
import numpy as np
from pxr import Gf, UsdGeom, UsdLux, UsdShade

from . import assets, kinds, lightFilters, portals
from .context import get, number, shown, targets, vector
from .networks import network_of_light
from .primvars import text
from .transforms import transform_of

_TINTS = "materialGlowTintsLight"
_INPUTS = _patina.light_inputs()  # (group, input, key of the scene, type) each, of hdDelegate/scene/lightTypes.inc


def emit(context, found, linking):
    prim, group = found.prim, found.state.group
    is_mesh = prim.IsA(UsdGeom.Mesh)
    type_ = "mesh" if is_mesh else kinds.LIGHTS.get(kinds.schema_among(prim, kinds.LIGHTS))
    fields = {"type": type_, "group": group.name}
    if context.options.render_pass and found.state.marks.get("patina:visibility:camera") == 0.0 and not is_mesh:
        fields["camera_visible"] = False
    _read_inputs(context, prim, type_, fields)
    fields["light_link"], fields["shadow_link"] = linking.links_of(found)
    fields["light_group"] = _light_group(context, found)
    fields["filters"] = lightFilters.of(context, prim, group)
    _report_network(context, prim, is_mesh)
    if any(a.HasAuthoredConnections() for a in prim.GetAuthoredAttributes() if a.GetName().startswith("inputs:")):
        fields["network"] = network_of_light(context, prim, found.path)
    after = None
    if type_ == "dome":
        fields["portals"] = portals.of(context, prim, group)
        after = _dome_pole(context, prim)
    elif type_ == "mesh":
        fields["geometry"] = found.path if is_mesh else _geometry_of(context, prim, group)
        if not fields["geometry"]:
            return
        mode = get(prim, "light:materialSyncMode", context.time) or _TINTS
        fields["material_sync_mode"] = str(shown(mode))
        if is_mesh and _input(context, prim, "intensity", authored=True) is None:
            fields["intensity"] = 1.0
    fields["transform"] = transform_of(context, prim, group.anchor, after)
    path = found.path if not is_mesh else found.path + "/light_of_mesh"
    context.edit.set_light(path, **fields)
    context.count("lights")


def glow_of(context, prim):
    """:returns: what lights others of the glow of a volume that is a light, over what its material gives off"""
    fields = {}
    _read_inputs(context, prim, "volume", fields)
    mode = get(prim, "light:materialSyncMode", context.time)
    radiance = _patina.light_radiance(**fields)
    if mode not in (None, _TINTS) or min(radiance) < 0.0 or not np.isfinite(radiance).all():
        context.warn(prim.GetPath(), "light:materialSyncMode", "volumeLightIgnored")
        return None
    return radiance


def _report_network(context, prim, is_mesh):
    """Of a light's network the nodes that its inputs are connected to are evaluated, shaders in its place are not."""
    for name in ("light:shaderId", "mtlx:light:shaderId"):
        attribute = prim.GetAttribute(name)
        value = attribute.Get() if attribute and attribute.HasAuthoredValue() and not is_mesh else None
        own = prim.GetPrimDefinition().GetAttributeFallbackValue(name)  # "DomeLight" of a DomeLight_1
        if value is not None and value not in (*kinds.schemas_of(prim), own):
            context.warn(prim.GetPath(), name, "lightShaderIgnored", shown(value))
    for attribute in prim.GetAuthoredAttributes():
        name = attribute.GetName()
        target = next(iter(attribute.GetConnections()), None)
        if target and name.startswith(("outputs:light", "outputs:mtlx:light")):
            context.warn(prim.GetPath(), name, "lightOutputConnected", target)


def _light_group(context, found):
    """:returns: its label in light path expressions; that of RenderMan stands above the primvar"""
    own = _input(context, found.prim, "ri:light:lightGroup")
    if isinstance(own, str) and own:
        return own
    return text(context, found.prim, found.state.primvars, "lightGroup") if found.has_primvars() else ""


def _input(context, prim, name, authored=False):
    """:returns: value of an input, also under the name that it had before OpenUSD 21.02"""
    if context.light_fallbacks.is_authored(prim, name):
        attribute = _attribute_of(context, prim, name, authored)
        return attribute.Get(context.time) if attribute else None
    return None if authored else context.light_fallbacks.of(name, lambda: _attribute_of(context, prim, name))


def _attribute_of(context, prim, name, authored=False):
    """:returns: the attribute that has the value of an input, None where there is no value"""
    for full in ("inputs:" + name, name):
        attribute = prim.GetAttribute(full)
        if attribute and (attribute.HasAuthoredValue() or full.startswith("inputs:") and not authored):
            old = prim.GetAttribute(name)
            if not attribute.HasAuthoredValue() and old and old.HasAuthoredValue():
                continue
            source = _source_of(attribute)
            if source.Get(context.time) is not None:
                return source
    return None


def _color(context, prim, name):
    """:returns: three numbers for the scene, None where its own fallback, the schema's, is to stay"""
    attribute = _attribute_of(context, prim, name) if context.light_fallbacks.is_authored(prim, name) else None
    value = attribute.Get(context.time) if attribute else _input(context, prim, name)
    color = vector(context, prim, "inputs:" + name, None, value)
    space = context.color_spaces.space_of(attribute) if color and attribute and attribute.HasAuthoredValue() else ""
    rendering = context.options.rendering_color_space
    if not color or not space and not rendering:
        return color
    converted = _patina.color_to_rendering(list(color), space, rendering)
    if converted is None:
        context.warn(prim.GetPath(), "inputs:" + name, "valueSpaceUnknown", space)
        return color
    # Of what the rendering space does not reach. A light that takes light away has no space of its own.
    return tuple(max(x, 0.0) for x in converted) if space else converted


def _source_of(attribute):
    """:returns: the attribute that an input's connections lead to, itself where they lead to none or to a node's output"""
    if not attribute.GetName().startswith("inputs:") or not attribute.HasAuthoredConnections():
        return attribute
    sources = UsdShade.Utils.GetValueProducingAttributes(UsdShade.Input(attribute))
    is_input = sources and UsdShade.Utils.GetType(sources[0].GetName()) == UsdShade.AttributeType.Input
    return sources[0] if is_input else attribute


def _is_shaped(prim):
    """:returns: whether the ShapingAPI is applied, or authored on stages older than that rule"""
    names = [name for group, name, _, _ in _INPUTS if group == "Shaping"]
    return prim.HasAPI(UsdLux.ShapingAPI) or any(prim.HasAttribute("inputs:" + n) or prim.HasAttribute(n) for n in names)


def _report_shaping(context, prim):
    """Tells of the inputs that shape other lights."""
    for name, idle in (("shaping:cone:angle", 180.0), ("shaping:focus", 0.0), ("shaping:ies:file", "")):
        value = _input(context, prim, name, authored=True)
        if value is not None and getattr(value, "path", value) != idle:
            context.warn(prim.GetPath(), "inputs:" + name, "inputIgnored", shown(value))


def _read_inputs(context, prim, light_type, fields):
    """Values that are none leave the scene's own fallback, which is the schema's."""
    shaped = fields["shaping_cone_authored"] = _is_shaped(prim)
    if light_type == "mesh":
        _report_shaping(context, prim)
    for group, name, key, type_ in _INPUTS:
        if group == "Shaping" and not shaped or group == "Image" and light_type not in ("dome", "rect"):
            continue
        if type_ == "std::string":
            _read_text(context, prim, name, key, fields)
            continue
        value = _color(context, prim, name) if type_ == "vec3" else _input(context, prim, name)
        if value is not None and type_ == "float":
            value = number(context, prim, "inputs:" + name, None, value)
        if value is not None:
            fields[key] = bool(value) if type_ == "bool" else value


def _read_text(context, prim, name, key, fields):
    """A token, or the file that an asset names."""
    if not context.light_fallbacks.is_authored(prim, name):
        return
    attribute = _attribute_of(context, prim, name, authored=True)
    if attribute and name.endswith(":file"):
        fields[key] = assets.resolve(context, attribute)
        if name == "texture:file":
            fields["texture_color_space"] = context.color_spaces.space_of(attribute)
    elif attribute:
        fields[key] = str(shown(attribute.Get(context.time)))


def _dome_pole(context, prim):
    """:returns: what turns a dome whose pole is not +Y: the pole of a DomeLight_1 may be the stage's
    up axis; a DomeLight stands on +Y until its own transform says otherwise"""
    if "DomeLight_1" not in kinds.schemas_of(prim):
        return None
    pole = get(prim, "poleAxis", context.time) or "scene"
    if pole == "scene":
        pole = UsdGeom.GetStageUpAxis(context.stage)
    if pole != "Z":
        return None
    turn = Gf.Matrix4d().SetRotate(Gf.Rotation(Gf.Vec3d(1, 0, 0), 90.0))
    return lambda offset: turn


def _geometry_of(context, prim, group):
    target = next(map(context.stage.GetPrimAtPath, targets(prim, "geometry")), None)
    if not target or not target.IsA(UsdGeom.Mesh):
        context.warn(prim.GetPath(), "geometry", "lightNamesNoMesh")
        return ""
    return group.path(target)
