# SPDX-License-Identifier: Apache-2.0
"""The rasterizer draws glass that disperses as glass that does not, and says so."""
import numpy as np
import pytest

import inProcess

pytestmark = pytest.mark.usefixtures("opengl")

GLASS = ("flint", "diamond", "frosted")


@pytest.fixture(scope="module")
def plain():
    return [x for name in GLASS for x in ("--set", f"/World/materials/{name}/surface.transmission_dispersion_scale=0")]


def test_glass_has_the_ior_of_the_d_line(plain):
    stage = inProcess.scene("prism")
    drawn = {}
    for name, arguments in (("dispersed", []), ("plain", plain)):
        picture = inProcess.Stage(stage, "--backend", "raster", "--imageWidth", 48, "--samples", 4, *arguments)
        drawn[name] = picture.image(1)
        told = sorted(w.partition(":")[0] for w in picture.warnings() if "dispersion" in w)
        assert told == ([] if arguments else sorted(f"/World/materials/{glass}" for glass in GLASS))
    # A program of its own rounds otherwise: by some units in the last place of half floats.
    assert np.abs(drawn["dispersed"] - drawn["plain"]).max() < 0.01 * drawn["plain"].max()


def test_the_path_tracer_shows_the_spectrum(plain):
    def most_colourful(*arguments):
        pixels = inProcess.Stage(inProcess.scene("prism"), "--imageWidth", 48, "--samples", 64, *arguments).image(1)
        pixels = pixels[pixels.mean(-1) > 1.0]  # the strip, brighter than all of the sky
        return (pixels.max(-1) / pixels.mean(-1)).max()

    assert most_colourful() > 2.0  # two of three channels see next to nothing of some wavelengths
    assert most_colourful(*plain) < 1.2
