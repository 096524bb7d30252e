# SPDX-License-Identifier: Apache-2.0
"""renderingColorSpace of the active UsdRenderSettings: usdrecord writes the product that the command line writes."""
import numpy as np
import pytest

import hydraBuild
from rendering import color, patina
import usda

pytestmark = pytest.mark.skipif(not hydraBuild.missing() and not hydraBuild.has_usdrecord(),
                                reason="this OpenUSD has no usdrecord")
# A floor whose colour is a primvar, a card with a colour and a glow of a temperature, a coloured and a warm light.
STAGE = usda.stage(
    usda.camera(flat=(60, 60), clippingRange=(1, 100), at=(0, 0, 20)),
    usda.card("floor", 9, z=-2, color=(0.7, 0.2, 0.1)),
    usda.mesh("card", [(-2, -2, 0), (2, -2, 0), (2, 1, 0), (-2, 2, 0)], bind="paint"),
    usda.material("paint", {
        "surface": ("ND_standard_surface_surfaceshader",
                    {"base_color": (0.1, 0.7, 0.3), "specular": 0.2, "emission": 0.1,
                     "color3f emission_color": "<glow>"}),
        "glow": ("ND_blackbody", {"temperature": 2500}, "color3f out")}),
    usda.prim("DistantLight", "sun", "color3f inputs:color = (0.3, 0.9, 0.6)", intensity=1, rotateX=-30),
    usda.prim("DomeLight", "sky", intensity=0.5, enableColorTemperature=True, colorTemperature=3500),
    usda.prim("Scope", "Render",
        usda.prim("RenderSettings", "settings", 'uniform token renderingColorSpace = "@space@"', "rel camera = </camera>",
                  "rel products = </Render/product>", "custom int patina:samples = 16"),
        usda.prim("RenderProduct", "product", "rel camera = </camera>", "uniform int2 resolution = (32, 32)",
                  "rel orderedVars = </Render/color>", productName="@product@"),
        usda.prim("RenderVar", "color", 'uniform token dataType = "color3f"', 'uniform string sourceName = "color"')),
    up="", renderSettingsPrimPath="/Render/settings")


def written(folder, space, host):
    """:returns: pixels and chromaticities of the product"""
    stage, product = folder / f"{host.__name__}.usda", folder / f"{host.__name__}{space}.exr"
    stage.write_text(STAGE.replace("@space@", space).replace("@product@", str(product)))
    warnings = host(stage)
    data = product.read_bytes()
    start = data.index(b"chromaticities\0chromaticities\0") + 34
    return color(product), np.frombuffer(data[start:start + 32], "<f4"), warnings


def command_line(stage):
    patina("record", stage, "--settings", "/Render/settings", "--outputFolder", "/")


@pytest.mark.parametrize("scene_index", [False, True], ids=["delegate", "sceneIndex"])
def test_products_are_those_of_the_command_line(tmp_path, scene_index):
    def usdrecord(stage):
        process = hydraBuild.run_usdrecord(stage, tmp_path / "view.png", "--renderSettingsPrimPath", "/Render/settings",
                                           "--disableCameraLight",
                                           scene_index=scene_index)
        return hydraBuild.warnings_of(process)

    images = {}
    for space in ("lin_rec709_scene", "lin_ap1_scene"):
        (wanted, primaries, _), (images[space], found, warnings) = (
            written(tmp_path, space, host) for host in (command_line, usdrecord))
        np.testing.assert_allclose(images[space], wanted, rtol=1e-4, atol=1e-6)  # of rounding in a few bounces
        assert (found == primaries).all() and not warnings
    plain, aces = images.values()
    assert np.abs(plain - aces).mean() > 0.05 * plain.mean()


def test_a_space_that_is_none_is_told(tmp_path):
    def usdrecord(stage):
        return hydraBuild.warnings_of(hydraBuild.run_usdrecord(stage, tmp_path / "view.png", "--renderSettingsPrimPath",
                                                               "/Render/settings", scene_index=True))

    _, primaries, warnings = written(tmp_path, "srgb_texture", usdrecord)
    assert primaries[0] == pytest.approx(0.64)
    told = "/Render/settings.renderingColorSpace: 'srgb_texture' is no linear colour space that is known"
    assert any(told in line for line in warnings), warnings
