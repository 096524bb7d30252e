# SPDX-License-Identifier: Apache-2.0
"""Renders small stages in the process of the test."""
import time

import numpy as np

from patina import experiment


def open_text(text):
    from pxr import Sdf, Usd

    layer = Sdf.Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString("#usda 1.0\n" + text)
    return Usd.Stage.Open(layer)


def render_text(text, aovs=("color",), backend="embree", **settings):
    """:param text: of a usda layer
    :param settings: of the renderer; 32 x 32 pixels, 16 samples and one thread where they say nothing else
    :returns: dict of float arrays (height, width, channels), warnings as text, processor seconds of the render"""
    import _patina

    from patina.stage import StageOptions, read_stage

    scene, film = _patina.Scene(), _patina.Film()
    with scene.edit() as edit:
        info = read_stage(open_text(text), edit, StageOptions(headlight=False))
    renderer = _patina.make_renderer(backend)
    start = time.process_time()
    experiment.draw(renderer, scene, info.camera, {"width": 32, "height": 32, "samples": 16, "threads": 1, "tolerance": 0.0,
                                                   "aovs": list(aovs), **settings}, film)
    seconds = time.process_time() - start
    warnings = [f"{w['prim']} {w['input']}: {w['message']}" for w in scene.warnings()]
    return {name: np.array(film.resolve(name)) for name in aovs}, warnings, seconds
