# SPDX-License-Identifier: Apache-2.0
"""More light samples where the camera looks change the noise, not the image: they and samples of the BSDF stay weighted to
one."""
import numpy as np
import pytest

from rendering import assert_same_mean, color, record, scene


@pytest.mark.parametrize("name", ["lightMesh", "lightDome", "media"])
def test_light_samples_do_not_change_the_mean(name):
    assert_same_mean(name, "--lightSamples", 1, 5, "--maxDepth", 3)


@pytest.mark.parametrize("name, count", [("lightRect", 1), ("lightDome", 2), ("manyLights", 4)])
def test_the_lights_decide_how_many_samples_are_taken(name, count, tmp_path):
    """One lamp, a sky, 200 lamps."""
    def image(file, *more):
        record(scene(name), tmp_path / file, "--imageWidth", 16, "--imageHeight", 9, "--samples", 2, "--maxDepth", 2, *more)
        return color(tmp_path / file)

    own = image("own.exr")
    assert np.array_equal(own, image("same.exr", "--lightSamples", count))
    assert not np.array_equal(own, image("other.exr", "--lightSamples", count + 1))
