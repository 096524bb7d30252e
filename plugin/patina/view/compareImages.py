"""The path-traced pictures of --compare: each material on the first shape, from the first camera."""
import numpy as np

from patina.cli import compiled
from patina.view import images, reference, shapes


def lit_scene(file, set_texts=()):
    """:returns: a scene with the direct lights of a stage and nothing else; an empty one without a stage"""
    module = compiled.load()
    scene = module.Scene()
    if not file:
        return scene
    from patina import stage as reader
    from patina.cli import openStage, overrides

    stage = openStage.open_stage(file)
    overrides.apply(stage, set_texts)
    with scene.edit() as edit:
        reader.read_stage(stage, edit, reader.StageOptions(headlight=False))
    kept = {path for path, _ in module.web_lights(scene)["lights"]}
    with scene.edit() as edit:
        for kind in ("geometry", "instancers", "lights", "cameras", "materials"):
            for path in scene.paths(kind):
                if path not in kept:
                    edit.remove(path)
    return scene


def made(builder):
    """:returns: list of {material, image} for the page"""
    if not builder.arguments.compare:
        return []
    width, samples = builder.arguments.compareWidth, builder.arguments.compareSamples
    environment = builder.environments[0]
    file = builder.scene.file if builder.scene else None
    set_texts = () if builder.arguments.stage else builder.arguments.set
    found = []
    for i, network in enumerate(builder.networks):
        picture = reference.render(network, shapes.sphere(), builder.shapes[0]["toWorld"],
                                   {**environment, "pixels": images.unpacked(environment)}, builder.camera, builder.eye,
                                   width, samples, "embree", lit_scene(file, set_texts), methods=builder.methods)
        image = {**images.half_rgb(np.nan_to_num(picture)), "wrap": ["clamp", "clamp"]}
        found.append({"material": i, "image": image})
    return found
