# SPDX-License-Identifier: Apache-2.0
"""The wedge pictures of docs/gallery.md can be made: no stage of them fails or warns."""
import pytest

from rendering import pixels
import wedges


@pytest.mark.parametrize("name", wedges.WEDGES)
def test_wedges_render(name, tmp_path):
    image = tmp_path / "wedge.exr"
    wedges.render(name, str(image), 70, 1)
    rows = len(wedges.WEDGES[name]())
    assert pixels(image).shape[:2] == (10 * rows, 70)
