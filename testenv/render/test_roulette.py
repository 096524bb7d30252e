# SPDX-License-Identifier: Apache-2.0
"""Roulette changes the noise and the time of an image, not its mean."""
import pytest

from rendering import assert_same_mean

NEVER = 4096  # surfaces, more than any path has


@pytest.mark.parametrize("name", ["diffuseBox", "lightDome", "media"])
def test_roulette_does_not_change_the_mean(name):
    always, never = assert_same_mean(name, "--rouletteDepth", 1, NEVER, "--maxDepth", 12)
    assert always != never
