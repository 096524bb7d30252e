# SPDX-License-Identifier: Apache-2.0
"""Choices for a stage as a whole, by asking the back end itself, which builds the scene and samples one pixel of it."""
from patina.cli import measuredLevels, openStage, overrides
from patina.cli.compiled import _patina
from patina.cli.usd import reader
from patina.experiment import draw

WIDTH = 960


def of_stage(file, set_texts, forced, tolerance, backend, measure_levels=False):
    """:param forced: choice point -> method
    :param tolerance: 0 or more; subdivision is planned for an image of WIDTH pixels from the stage's first camera

    :returns: list of choices as Renderer.progress() tells them, material path -> plan as this back end draws it, and
        measuredLevels.Roots
    """
    stage = openStage.open_stage(file)
    overrides.apply(stage, set_texts)
    scene, options, levels = _patina.Scene(), reader.StageOptions(), []
    if measure_levels:
        levels, tolerance = measuredLevels.choose(stage, options, _size, tolerance)
        options.levels = {root.path: root.chosen for root in levels}
    with scene.edit() as edit:
        info = reader.read_stage(stage, edit, options)
    width, height = _size(scene.camera(info.camera))
    settings = {"width": width, "height": height, "dataWindow": (0, 0, 0, 0), "samples": 1, "tolerance": tolerance,
                "maxDepth": -1, "methods": forced, "checkpointSeconds": 0.0}
    state = draw(_patina.make_renderer(backend), scene, info.camera, settings, _patina.Film())
    return state["sceneChoices"], state["plans"], levels


def _size(camera):
    return WIDTH, max(1, round(WIDTH / camera["image_aspect"]))
