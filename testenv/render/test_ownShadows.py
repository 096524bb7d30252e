# SPDX-License-Identifier: Apache-2.0
"""Lights whose shadows are not the shapes in their way: a card that hides nothing changes nothing, however light is found."""
import numpy as np
import pytest

import inProcess
import usda

STAGE = usda.stage(
    usda.camera(lens=(50, 20, 20), at=(0, 2, 0), rotateX=-90),
    usda.floor("floor", 9, bind="looks"),
    usda.preview("looks", diffuseColor=(0.5, 0.5, 0.5), **{"float metallic": "METALLIC", "float roughness": "ROUGHNESS"}),
    metersPerUnit=1)
CARD = usda.floor("card", 9, "bool doubleSided = 1", y=3, color=(0, 0, 0))
LIGHTS = {"dome": ('DomeLight', "    float inputs:intensity = 1\n"),
          "rect": ('RectLight', "    float inputs:intensity = 2\n    float inputs:width = 6\n    float inputs:height = 6\n"
                   "    double3 xformOp:translate = (0, 5, 0)\n    float xformOp:rotateX = -90\n"
                   '    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]\n'),
          "sphere": ('SphereLight', "    float inputs:intensity = 5\n    float inputs:radius = 1\n"
                     "    double3 xformOp:translate = (0, 5, 0)\n"
                     '    uniform token[] xformOpOrder = ["xformOp:translate"]\n'),
          "sun": ('DistantLight', "    float inputs:intensity = 5\n    float inputs:angle = 40\n"
                  "    float xformOp:rotateX = -90\n"
                  '    uniform token[] xformOpOrder = ["xformOp:rotateX"]\n')}
# Ways to have no shadow of the card, beside the last, whose shadow is as bright as the light.
SHADOWS = {"off": "    bool inputs:shadow:enable = 0\n", "short": "    float inputs:shadow:distance = 0.5\n",
           "linked": "    bool collection:shadowLink:includeRoot = 0\n    rel collection:shadowLink:includes = </floor>\n",
           "white": "    color3f inputs:shadow:color = (1, 1, 1)\n"}


def image(folder, light, shadow, card, look, *flags):
    kind, text = LIGHTS[light]
    schemas = 'prepend apiSchemas = ["ShadowAPI", "CollectionAPI:shadowLink"]'
    stage = STAGE.replace("METALLIC", str(look[0])).replace("ROUGHNESS", str(look[1]))
    file = folder / f"{light}{int(card)}.usda"
    light = f'def {kind} "light" ({schemas})\n{{\n{text}{shadow}}}\n'
    file.write_text(stage + (CARD if card else "") + light, encoding="utf-8")
    found = inProcess.Stage(str(file), "--camera", "/camera", "-w", "24", "--samples", "64", "--maxDepth", "1", *flags)
    return found.image(1 + card)[..., :3].astype(np.float64)


@pytest.mark.parametrize("look", [(0, 0.8), (1, 0.3)], ids=["matte", "metal"])
@pytest.mark.parametrize("light, shadow", [*((light, "off") for light in LIGHTS), ("dome", "short"), ("rect", "linked"),
                                           ("sphere", "white")])
def test_a_card_without_a_shadow_changes_nothing(tmp_path, light, shadow, look):
    free, behind = (image(tmp_path, light, SHADOWS[shadow], card, look) for card in (False, True))
    difference = (behind - free).mean(axis=2)
    # Six standard errors of as many pixels, whose noise is their own but for the filter's, which spreads over some four. The
    # rest is for lights that all samples find alike, up to the last digits.
    assert abs(difference.mean()) < 6.0 * 2.0 * difference.std() / np.sqrt(difference.size) + 1e-5 * free.mean()
    assert free.mean() > 0.1
    hidden = image(tmp_path, light, "", True, look)
    assert hidden.mean() < 0.1 * free.mean()  # the card would hide the light


def test_no_shadows_at_all(tmp_path):
    free, behind = (image(tmp_path, "dome", "", card, (1, 0.3), "--disableShadows") for card in (False, True))
    difference = (behind - free).mean(axis=2)
    assert abs(difference.mean()) < 6.0 * 2.0 * difference.std() / np.sqrt(difference.size) + 1e-5 * free.mean()
