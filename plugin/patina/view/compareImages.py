# SPDX-License-Identifier: Apache-2.0
"""The path-traced pictures of --compare: each material on the first shape, or on every one, from the first camera."""
import numpy as np

from patina.cli import openStage
from patina.cli.compiled import _patina
from patina.view import images, reference, stageScene


def lit_scene(file, set_texts=()):
    """:returns: a scene with the direct lights of a stage that the page has, and nothing else; an empty one without a stage"""
    if not file:
        return _patina.Scene()
    _, scene, _ = openStage.scene_of(file, set_texts, headlight=False)
    kept = {path for path, _ in _patina.web_lights(scene)["lights"][:stageScene.MAX_LIGHTS]}
    kept |= set(_patina.web_light_meshes(scene))
    with scene.edit() as edit:
        for kind in ("geometry", "instancers", "lights", "cameras", "materials"):
            for path in scene.paths(kind):
                if path not in kept:
                    edit.remove(path)
    return scene


def made(builder):
    """:returns: list of {material, shape, image} for the page"""
    arguments = builder.arguments
    if not (arguments.compare or arguments.compareShapes):
        return []
    width, samples = arguments.compareWidth, arguments.compareSamples
    environment = {**builder.environments[0], "pixels": images.unpacked(builder.environments[0])}
    file = builder.scene.file if builder.scene else None
    set_texts = () if arguments.stage else arguments.set
    found = []
    for at, (_, mesh, _, to_world) in enumerate(builder.shapes if arguments.compareShapes else builder.shapes[:1]):
        for i, network in enumerate(builder.networks):
            picture = reference.render(network, mesh, to_world, environment, builder.camera, builder.eye, width, samples,
                                       "embree", lit_scene(file, set_texts), methods=builder.methods)
            image = {**images.half_rgb(np.nan_to_num(picture)), "wrap": ["clamp", "clamp"]}
            found.append({"material": i, "shape": at, "image": image})
    return found
