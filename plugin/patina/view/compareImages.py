"""The path-traced pictures of --compare: each material on the first shape, from the first camera."""
import numpy as np

from patina.cli import compiled
from patina.view import images, reference, shapes


def _lit_scene(builder):
    """A scene with the stage's direct lights and nothing else."""
    module = compiled.load()
    if not builder.scene:
        return module.Scene()
    from patina import stage as reader
    from patina.cli import openStage, overrides

    stage = openStage.open_stage(builder.scene.file)
    overrides.apply(stage, () if builder.arguments.stage else builder.arguments.set)
    scene = module.Scene()
    kept = {path for path, _ in module.web_lights(builder.scene.scene)["lights"]}
    with scene.edit() as edit:
        reader.read_stage(stage, edit, reader.StageOptions(headlight=False))
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
    found = []
    for i, network in enumerate(builder.networks):
        picture = reference.render(network, shapes.sphere(), builder.shapes[0]["toWorld"],
                                   {**environment, "pixels": images.unpacked(environment)}, builder.camera, builder.eye,
                                   width, samples, "embree", _lit_scene(builder), builder.methods)
        image = {**images.half_rgb(np.nan_to_num(picture)), "wrap": ["clamp", "clamp"]}
        found.append({"material": i, "image": image})
    return found
