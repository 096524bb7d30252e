# SPDX-License-Identifier: Apache-2.0
"""Choices for a stage as a whole, by asking the back end itself, which builds the scene and samples one pixel of it."""
from patina.cli import compiled, openStage, overrides
from patina.cli.errors import CommandError

WIDTH = 960


def of_stage(file, set_texts, forced, tolerance, backend):
    """:param forced: choice point -> method
    :param tolerance: 0 or more; subdivision is planned for an image of WIDTH pixels from the stage's first camera

    :returns: list of choices as Renderer.progress() tells them, and material path -> plan as this back end draws it
    """
    from patina import stage as reader

    module = compiled.load()
    stage = openStage.open_stage(file)
    overrides.apply(stage, set_texts)
    scene = module.Scene()
    with scene.edit() as edit:
        info = reader.read_stage(stage, edit, reader.StageOptions())
    aspect = scene.camera(info.camera)["image_aspect"]
    renderer = module.make_renderer(backend)
    renderer.start(scene, info.camera, {"width": WIDTH, "height": max(1, round(WIDTH / aspect)), "dataWindow": (0, 0, 0, 0),
                                        "samples": 1, "tolerance": tolerance, "maxDepth": -1, "methods": forced,
                                        "checkpointSeconds": 0.0}, module.Film())
    while not renderer.wait(0.2):  # signals are heard in between
        pass
    state = renderer.progress()
    if state["failed"]:
        raise CommandError(state["error"])
    return state["sceneChoices"], state["plans"]
