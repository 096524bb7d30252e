"""UsdLux lights."""
from pxr import Gf, UsdGeom, UsdLux

from . import assets
from .context import number, vector
from .kinds import LIGHTS
from .transforms import transform_of

_FLOATS = ("intensity", "exposure", "diffuse", "specular", "colorTemperature", "angle", "radius", "width",
           "height", "length")
_BOOLS = ("normalize", "enableColorTemperature")
_SHAPING = {"shaping:focus": "shaping_focus", "shaping:cone:angle": "shaping_cone_angle",
            "shaping:cone:softness": "shaping_cone_softness", "shaping:ies:angleScale": "ies_angle_scale"}
_SHADOW = {"shadow:distance": "shadow_distance", "shadow:falloff": "shadow_falloff",
           "shadow:falloffGamma": "shadow_falloff_gamma"}


def emit(context, found, linking):
    prim, group = found.prim, found.state.group
    is_mesh = prim.IsA(UsdGeom.Mesh)
    type_ = "mesh" if is_mesh else LIGHTS.get(prim.GetTypeName())
    fields = {"type": type_, "group": group.name}
    _read(context, prim, fields)
    _read_shaping(context, prim, fields)
    _read_shadow(context, prim, fields)
    fields["light_link"], fields["shadow_link"] = linking.links_of(prim)
    if prim.HasRelationship("light:filters") and prim.GetRelationship("light:filters").GetTargets():
        context.warn(prim.GetPath(), "light:filters", "light filters are not applied")

    after = None
    if type_ == "dome":
        _read_texture(context, prim, fields)
        fields["texture_format"] = str(_input(context, prim, "texture:format") or "automatic")
        after = _dome_pole(context, prim)
    elif type_ == "rect":
        _read_texture(context, prim, fields)
    elif type_ == "mesh":
        fields["geometry"] = found.path if is_mesh else _geometry_of(context, prim, group)
        if not fields["geometry"]:
            return
        fields["material_sync_mode"] = str(_plain(context, prim, "light:materialSyncMode") or "materialGlowTintsLight")
        if is_mesh and _input(context, prim, "intensity", authored=True) is None:
            fields["intensity"] = 1.0
    for name in ("treatAsPoint", "treatAsLine"):
        value = _plain(context, prim, name)
        if value is not None:
            fields["treat_as_point" if name == "treatAsPoint" else "treat_as_line"] = bool(value)
    fields["transform"] = transform_of(context, prim, group.anchor, after)
    path = found.path if not is_mesh else found.path + "/light_of_mesh"
    context.edit.set_light(path, **fields)
    context.count("lights")


def is_mesh_light(prim):
    return prim.HasAPI(UsdLux.MeshLightAPI)


def _input(context, prim, name, authored=False):
    """:returns: value of an input, also under the name that it had before OpenUSD 21.02"""
    for full in ("inputs:" + name, name):
        attribute = prim.GetAttribute(full)
        if attribute and (attribute.HasAuthoredValue() or full.startswith("inputs:") and not authored):
            old = prim.GetAttribute(name)
            if not attribute.HasAuthoredValue() and old and old.HasAuthoredValue():
                continue
            value = attribute.Get(context.time)
            if value is not None:
                return value
    return None


def _plain(context, prim, name):
    attribute = prim.GetAttribute(name)
    return attribute.Get(context.time) if attribute else None


def _set_number(context, prim, name, key, value, fields):
    """Values that are no numbers leave the scene's own fallback, which is the schema's."""
    checked = number(context, prim, "inputs:" + name, None, value)
    if checked is not None:
        fields[key] = checked


def _read(context, prim, fields):
    for name in _FLOATS:
        value = _input(context, prim, name)
        if value is not None:
            _set_number(context, prim, name, _snake(name), value, fields)
    for name in _BOOLS:
        value = _input(context, prim, name)
        if value is not None:
            fields[_snake(name)] = bool(value)
    color = _input(context, prim, "color")
    if color is not None:
        fields["color"] = vector(context, prim, "inputs:color", (1.0, 1.0, 1.0), color)


def _read_texture(context, prim, fields):
    attribute = prim.GetAttribute("inputs:texture:file")
    if not attribute or not attribute.HasAuthoredValue():
        attribute = prim.GetAttribute("texture:file")
    if attribute and attribute.HasAuthoredValue():
        fields["texture_file"] = assets.resolve(context, attribute)
        fields["texture_color_space"] = attribute.GetColorSpace()


def _read_shaping(context, prim, fields):
    """Values count where the ShapingAPI is applied, or authored on stages older than that rule."""
    if not prim.HasAPI(UsdLux.ShapingAPI) and not any(
            prim.HasAttribute("inputs:" + n) or prim.HasAttribute(n) for n in _SHAPING):
        return
    for name, key in _SHAPING.items():
        value = _input(context, prim, name)
        if value is not None:
            _set_number(context, prim, name, key, value, fields)
    tint = _input(context, prim, "shaping:focusTint")
    if tint is not None:
        fields["shaping_focus_tint"] = vector(context, prim, "inputs:shaping:focusTint", (0.0, 0.0, 0.0), tint)
    fields["ies_normalize"] = bool(_input(context, prim, "shaping:ies:normalize") or False)
    attribute = prim.GetAttribute("inputs:shaping:ies:file")
    if attribute and attribute.HasAuthoredValue():
        fields["ies_file"] = assets.resolve(context, attribute)
    fields["shaping_cone_authored"] = True


def _read_shadow(context, prim, fields):
    enable = _input(context, prim, "shadow:enable")
    if enable is not None:
        fields["shadow_enable"] = bool(enable)
    color = _input(context, prim, "shadow:color")
    if color is not None:
        fields["shadow_color"] = vector(context, prim, "inputs:shadow:color", (0.0, 0.0, 0.0), color)
    for name, key in _SHADOW.items():
        value = _input(context, prim, name)
        if value is not None:
            _set_number(context, prim, name, key, value, fields)


def _dome_pole(context, prim):
    """:returns: what turns a dome whose pole is not +Y: the pole of a DomeLight_1 may be the stage's
    up axis; a DomeLight stands on +Y until its own transform says otherwise"""
    if prim.GetTypeName() != "DomeLight_1":
        return None
    pole = _plain(context, prim, "poleAxis") or "scene"
    if pole == "scene":
        pole = UsdGeom.GetStageUpAxis(context.stage)
    if pole != "Z":
        return None
    turn = Gf.Matrix4d().SetRotate(Gf.Rotation(Gf.Vec3d(1, 0, 0), 90.0))
    return lambda offset: turn


def _geometry_of(context, prim, group):
    targets = prim.GetRelationship("geometry").GetForwardedTargets() if prim.HasRelationship("geometry") else []
    target = context.stage.GetPrimAtPath(targets[0]) if targets else None
    if not target or not target.IsA(UsdGeom.Mesh):
        context.warn(prim.GetPath(), "geometry", "names no mesh; the light is left out")
        return ""
    return group.path(target)


def _snake(name):
    return "".join("_" + c.lower() if c.isupper() else c for c in name)
