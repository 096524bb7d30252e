# SPDX-License-Identifier: Apache-2.0
"""The test that holds the back ends together finds what it says that it finds, and no more often than it says."""
import numpy as np
import pytest

import equivalence
from equivalence import MARGIN, Power, compare, decide, tiles

POWER = Power(widest=0.02, samples=1, traced=1, looks=(12, 24, 48))


def noisy(generator, noise, shape=(16, 24), change=None):
    """:returns: function of seeds -> images around 0.5 with so much relative noise of a tile; `change` scales pixels"""
    def render(seeds):
        per_tile = generator.normal(1.0, noise, (len(seeds), shape[0] // 8, shape[1] // 8, 3))
        images = 0.5 * np.repeat(np.repeat(per_tile, 8, axis=1), 8, axis=2)
        if change is not None:
            images = images * change
        return images
    return render


def changed(by, shape=(16, 24)):
    """One tile, blue alone."""
    change = np.ones((*shape, 3))
    change[8:, 16:, 2] += by
    return change


def test_equal_means_are_rejected_no_more_often_than_stated():
    """400 stages of nothing but noise, at the margin's very edge in one tile: at 1 % each, more than 12 rejections have a
    probability below 0.001 (binomial); seed 5. Without margin the same holds of equal means."""
    generator = np.random.default_rng(5)
    rejected = 0
    for _ in range(400):
        edge = changed(MARGIN)  # a difference of at most the margin, for a value of at least 1
        verdict = decide(noisy(generator, 0.02, change=edge), noisy(generator, 0.02), POWER)[0]
        rejected += verdict.differs.any()
    assert rejected <= 12


@pytest.mark.parametrize("by", [-0.47, -0.05, 0.05, 1.24])
def test_a_difference_above_margin_and_power_is_found(by):
    generator = np.random.default_rng(7)
    for _ in range(20):
        verdict, first, _ = decide(noisy(generator, 0.02, change=changed(by)), noisy(generator, 0.02), POWER)
        found = np.argwhere(verdict.differs)
        assert [1, 2, 2] in found.tolist(), verdict.text()
        assert "row 1 column 2 B differs" in verdict.text()


def test_noise_takes_more_renders_and_is_never_called_equal():
    generator = np.random.default_rng(9)
    verdict, first, second = decide(noisy(generator, 0.001), noisy(generator, 0.001), POWER)
    assert len(first) == len(second) == 12 and not verdict.undecided.any()
    verdict, first, _ = decide(noisy(generator, 0.015), noisy(generator, 0.015), POWER)
    assert len(first) in (24, 48) and not verdict.undecided.any()
    verdict, first, _ = decide(noisy(generator, 0.5), noisy(generator, 0.5), POWER)
    assert len(first) == 48 and verdict.undecided.any() and "is undecided" in verdict.text()


def test_what_does_not_vary_is_compared_too():
    still = np.full((12, 1, 1, 3), 0.25)
    assert not compare(still, still, POWER).differs.any()
    assert not compare(still * 1.005, still, POWER).differs.any()
    assert compare(still * 1.02, still, POWER).differs.all()
    assert not compare(0 * still, 0 * still, POWER).undecided.any()


def test_what_may_stay_undecided_still_may_not_differ():
    generator = np.random.default_rng(11)
    spare = Power(widest=0.02, samples=1, traced=1, looks=(12,), spare=0.2)
    noise = lambda seeds: noisy(generator, 0.001)(seeds) * (1 + np.where(changed(1.0) > 1, 1.0, 0.0)
                                                           * generator.normal(0.0, 0.3, (len(seeds), 1, 1, 1)))  # noqa: E731
    verdict = decide(noise, noisy(generator, 0.001), spare)[0]
    assert verdict.undecided.sum() == 1 and not verdict.open and not verdict.differs.any()
    verdict = decide(lambda seeds: 3 * noise(seeds), noisy(generator, 0.001), spare)[0]
    assert verdict.differs.any()


def test_tiles_cover_every_pixel():
    images = np.random.default_rng(1).random((2, 27, 50, 3))
    found = tiles(images)
    assert found.shape == (2, 3, 6, 3)
    assert found[0, 0, 0] == pytest.approx(images[0, :9, :9].mean(axis=(0, 1)))
    whole = np.zeros((1, 27, 50, 3))
    for y in range(27):
        whole[:] = 0.0
        whole[0, y] = 1.0
        assert tiles(whole).sum() > 0.0


def test_a_coarse_tile_decides_what_noise_hides_from_fine_ones():
    """Pixels' noise is 30 %: 12 renders know a tile of 8 pixels to about 5 %, and the whole image to a tenth of that."""
    generator = np.random.default_rng(13)
    render = lambda seeds, light=0.5: light * (1 + 0.3 * generator.normal(size=(len(seeds), 64, 64, 3)))  # noqa: E731
    fine = Power(widest=0.02, samples=1, traced=1, looks=(12,))
    coarse = Power(widest=0.02, samples=1, traced=1, looks=(12,), tile=64)
    assert tiles(render([1]), 64).shape == (1, 1, 1, 3)
    assert decide(render, render, fine)[0].open
    verdict = decide(render, render, coarse)[0]
    assert not verdict.open and not verdict.differs.any()
    assert decide(lambda seeds: render(seeds, 0.53), render, coarse)[0].differs.all()


def test_the_margin_is_one_percent_for_all():
    assert equivalence.MARGIN == 0.01 and equivalence.SIGNIFICANCE == 0.01
    assert equivalence.LONG.widest <= equivalence.MARGIN <= equivalence.FULL.widest
