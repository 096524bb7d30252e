# SPDX-License-Identifier: Apache-2.0
"""The stages of the classic BRDFs: what their documentation says of them."""
import json
import os

import pytest

from rendering import SCENES, patina


def albedo(stage, material, angle="0,0,1"):
    path = os.path.join(SCENES, "classic", stage + ".usda")
    process = patina("bsdf", "albedo", f"{path}:/World/materials/{material}", "--wo", angle, "--json")
    assert not process.stderr
    return json.loads(process.stdout.splitlines()[-1])["albedo"]


@pytest.mark.parametrize("angle", ("0,0,1", "0.8,0,0.6"))
def test_steel_rusts_to_hematite(angle):
    assert albedo("rustedSteel", "clean", angle) == pytest.approx(albedo("polishedSteel", "cookTorrance", angle), rel=1e-5)
    rust = albedo("rustedSteel", "rust", angle)
    assert rust[0] > 1.5 * rust[2]  # the powder is red; hematite's own reflection is nearly grey
    clean, half = albedo("rustedSteel", "clean", angle), albedo("rustedSteel", "rusting", angle)
    assert half != pytest.approx(clean, rel=0.01) and half != pytest.approx(rust, rel=0.01)
