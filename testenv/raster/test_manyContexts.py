# SPDX-License-Identifier: Apache-2.0
"""Many rasterizers in one process, each with a context of its own: at once, one after the other, on any thread."""
import os
import threading

import numpy as np
import pytest

import bothBackEnds
from patina import experiment

SETTINGS = {"width": 32, "height": 24, "samples": 3}


@pytest.fixture(scope="module")
def scene():
    bothBackEnds.needs_opengl()
    import _patina
    from patina import stage as reader
    from pxr import Usd

    scene = _patina.Scene()
    with scene.edit() as edit:
        reader.read_stage(Usd.Stage.Open(os.path.join(bothBackEnds.SCENES, "lightRect.usda")), edit,
                          reader.StageOptions())
    return scene


def render(renderer, scene):
    import _patina

    film = _patina.Film()
    assert experiment.draw(renderer, scene, "/World/camera", SETTINGS, film, "raster")["converged"]
    return film.resolve("color")


def test_renderers_at_once_make_the_same_image(scene):
    import _patina

    alone = render(_patina.make_renderer("raster"), scene)
    found = [None] * 3

    def work(i):
        renderer = _patina.make_renderer("raster")
        found[i] = [render(renderer, scene), render(renderer, scene)]

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(found))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for images in found:
        for image in images:
            np.testing.assert_array_equal(image, alone)


def test_one_that_ends_leaves_the_others_alone(scene):
    import _patina

    first, second = _patina.make_renderer("raster"), _patina.make_renderer("raster")
    before = render(first, scene)
    np.testing.assert_array_equal(render(second, scene), before)
    del second
    np.testing.assert_array_equal(render(first, scene), before)
