# SPDX-License-Identifier: Apache-2.0
"""Volumes that are lights (VolumeLightAPI): their inputs scale what lights others of the glow, not what is seen of it."""
import numpy as np
import pytest

from inProcess import Stage
from rendering import scene
import usda

COLOR = (1.0, 0.5, 0.25)


def rendered(folder, lines):
    """:returns: an image of the puff and its floor, lit by nothing but its glow"""
    over = folder / "over.usda"
    apis = ("VolumeLightAPI",) if lines is not None else ()
    over.write_text(usda.stage(
        usda.prim("", "World", usda.prim("", "sun", meta=("active = false",), specifier="over"),
                  usda.prim("", "sky", meta=("active = false",), specifier="over"),
                  usda.prim("", "puff", lines or "", apis=apis, specifier="over"), specifier="over"),
        up="", subLayers=f"[@{scene('volume')}@]"))
    stage = Stage(over, "--imageWidth", 32, "--samples", 16)
    assert not stage.scene.warnings()
    return stage.image(1)


def test_light_of_a_glow_follows_its_inputs(tmp_path):
    """All pictures have the same paths, so that they are linear in the light: I(k) - I(0) = k (I(1) - I(0))."""
    plain = rendered(tmp_path, None)
    one, none = rendered(tmp_path, ""), rendered(tmp_path, "float inputs:intensity = 0")
    assert np.array_equal(plain, one)
    lit = one - none
    assert lit.max() > 1e-3 and none.max() > 0.1  # the floor is lit, and the puff is seen without light of its own
    assert lit.min() > -1e-6
    given = rendered(tmp_path, f"float inputs:intensity = 2\nfloat inputs:exposure = 1\ncolor3f inputs:color = {COLOR}")
    assert given == pytest.approx(none + lit * 4 * np.array(COLOR), rel=1e-4, abs=1e-6)
