# SPDX-License-Identifier: Apache-2.0
"""Patina as a render engine of Blender, by Hydra; `patina hydra --blender` packs this folder with a plugin."""
import json
import os

import bpy

HERE = os.path.dirname(os.path.abspath(__file__))
DELEGATE = "HdPatinaRendererPlugin"
# Blender's pass: channels, their names, kind, Hydra's AOV
PASSES = {"Combined": (4, "RGBA", "COLOR", "color"), "Depth": (1, "Z", "VALUE", "cameraDepth"),
          "Normal": (3, "XYZ", "VECTOR", "normal"), "Position": (3, "XYZ", "VECTOR", "position"),
          "Albedo": (3, "RGB", "COLOR", "albedo")}
_problem = ""  # why the plugin cannot be used here


def _read(name):
    with open(os.path.join(HERE, name), encoding="utf-8") as file:
        return json.load(file)


def _property(setting):
    """:param setting: one of settings.json
    :returns: what Blender shows it by"""
    words = {"name": setting["label"], "description": setting["help"]}
    words["default"] = setting["default"]
    if setting["choices"]:
        return bpy.props.EnumProperty(items=[(name, name, "") for name in setting["choices"]], **words)
    if setting["type"] == "bool":
        return bpy.props.BoolProperty(**words)
    if setting["type"] == "string":
        return bpy.props.StringProperty(**words)
    words.update({name: setting[name] for name in ("min", "max") if setting[name] is not None})
    return bpy.props.IntProperty(**words) if setting["type"] == "int" else bpy.props.FloatProperty(precision=4, **words)


SETTINGS = _read("settings.json")
PatinaSettings = type("PatinaSettings", (bpy.types.PropertyGroup,),
                      {"__annotations__": {setting["key"]: _property(setting) for setting in SETTINGS}})


class PatinaRenderEngine(bpy.types.HydraRenderEngine):
    bl_idname = "PATINA"
    bl_label = "Patina"
    bl_info = "Physically based path tracer of UsdShade networks"
    bl_use_preview = True
    bl_use_gpu_context = False
    bl_use_materialx = True
    bl_delegate_id = DELEGATE

    def render(self, depsgraph):
        if _problem:
            self.report({"ERROR"}, _problem)
            self.error_set(_problem)
            return
        super().render(depsgraph)

    def get_render_settings(self, engine_type):
        scene = bpy.context.scene
        settings = {setting["key"]: getattr(scene.patina, setting["key"]) for setting in SETTINGS}
        if engine_type == "VIEWPORT":
            settings.update(interactive=True, backend=scene.patina.viewportBackend)
            return settings
        layer = bpy.context.view_layer
        settings.update(interactive=False, backend="embree")
        settings.update({"aovToken:" + name: PASSES[name][3] for name in _passes(scene, layer)})
        return settings

    def update_render_passes(self, scene, render_layer):
        for name in _passes(scene, render_layer):
            channels, names, kind, _ = PASSES[name]
            self.register_pass(scene, render_layer, name, channels, names, kind)


def _passes(scene, layer):
    """:returns: names of the passes that a view layer asks for"""
    wanted = {"Combined": True, "Depth": layer.use_pass_z, "Normal": layer.use_pass_normal,
              "Position": layer.use_pass_position, "Albedo": scene.patina.albedoPass}
    return [name for name in PASSES if wanted[name]]


class PatinaPanel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {"PATINA"}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        if _problem:
            layout.label(text=_problem, icon="ERROR")
        for key in self.keys:
            layout.prop(context.scene.patina, key)


def _panel(name, label, keys, parent=""):
    words = {"bl_label": label, "keys": keys, **({"bl_parent_id": parent, "bl_options": {"DEFAULT_CLOSED"}} if parent else {})}
    return type(name, (PatinaPanel, bpy.types.Panel), words)


_FIRST = ("samples", "tolerance", "seconds", "maxDepth", "denoise", "viewportBackend")
_LAYER = ("albedoPass",)
CLASSES = (PatinaSettings, PatinaRenderEngine,
           _panel("PATINA_RENDER_PT_render", "Patina", _FIRST),
           _panel("PATINA_RENDER_PT_more", "More", [s["key"] for s in SETTINGS if s["key"] not in _FIRST + _LAYER],
                  "PATINA_RENDER_PT_render"),
           type("PATINA_RENDER_PT_passes", (PatinaPanel, bpy.types.Panel),
                {"bl_label": "Patina Passes", "bl_context": "view_layer", "keys": _LAYER}))


def _shared_panels():
    """:returns: Blender's own panels that fit any engine"""
    left_out = {"VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes", "RENDER_PT_freestyle", "RENDER_PT_simplify"}
    return [panel for panel in bpy.types.Panel.__subclasses__()
            if "BLENDER_RENDER" in getattr(panel, "COMPAT_ENGINES", ()) and panel.__name__ not in left_out]


def _load():
    """:returns: why the plugin cannot be used in this Blender; empty where it can"""
    host = _read("host.json")
    expose = getattr(bpy.utils, "expose_bundled_modules", None)
    if expose:
        expose()
    try:
        from pxr import Plug, Usd
    except ImportError as error:
        return f"this Blender has no OpenUSD for Python: {error}"
    version = tuple(Usd.GetVersion()[1:])
    if version != tuple(host["version"]):
        return ("the plugin is built for OpenUSD {}.{:02d}, this Blender has {}.{:02d}: another package fits".format(
            *host["version"], *version))
    folder = os.path.join(HERE, "usdPlugin")
    for name in os.listdir(folder):
        if name.startswith("patina"):  # programs that the plugin starts; Blender unpacks files without their modes
            os.chmod(os.path.join(folder, name), 0o755)
    if not Plug.Registry().RegisterPlugins(folder) and not Plug.Registry().GetPluginWithName("hdPatina"):
        return f"OpenUSD finds no plugin in {folder}"
    try:
        return "" if Plug.Registry().GetPluginWithName("hdPatina").Load() else "the plugin cannot be loaded"
    except Exception as error:  # OpenUSD's own errors say why
        return f"the plugin cannot be loaded: {error}"


def register():
    global _problem
    _problem = _load()
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.patina = bpy.props.PointerProperty(type=PatinaSettings)
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.add("PATINA")
    if _problem:
        print(f"Patina: {_problem}")


def unregister():
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.discard("PATINA")
    del bpy.types.Scene.patina
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
