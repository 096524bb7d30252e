# SPDX-License-Identifier: Apache-2.0
"""Patina: renders USD stages with physically based shading networks.

    import patina

    scene, film = patina.Scene(), patina.Film()
    with scene.edit() as edit:
        info = patina.read_stage(patina.open_stage("shot.usda"), edit)
    renderer = patina.make_renderer("embree")
    renderer.start(scene, info.camera, {"samples": 64}, film)
    renderer.wait()
    patina.write_images(film, "shot.exr")

These names are those that programs use. Behind them are `_patina`, the compiled module, and `patina.stage`, which reads stages
with pxr. Nothing is imported before it is asked for, so that help and usage errors need no build.
"""
import importlib

__version__ = "1.0.0"

_NAMES = {
    "_patina": ("Scene", "SceneEdit", "Network", "Film", "Renderer", "MaterialProbe", "ImageData", "TemporaryFailure",
                "make_renderer", "default_render_settings", "read_image", "write_image", "write_images"),
    "patina.stage": ("open_stage", "read_stage", "read_materials", "StageOptions", "StageInfo", "StageError"),
}
__all__ = [name for names in _NAMES.values() for name in names]


def __getattr__(name):
    for module, names in _NAMES.items():
        if name in names:
            return getattr(importlib.import_module(module), name)
    if name == "_patina":
        return importlib.import_module(name)
    raise AttributeError(f"module 'patina' has no attribute '{name}'")


def __dir__():
    return [*globals(), *__all__]
