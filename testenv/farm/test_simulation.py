# SPDX-License-Identifier: Apache-2.0
"""The simulated farm, against what can be said without one."""
import math

import pytest

from patina.farm import simulation


@pytest.mark.parametrize("workers", [1, 3, 8, 100])
def test_equal_frames_take_whole_rounds(workers):
    costs = simulation.Costs((), (2.0,), 0.0)
    one = simulation.run(costs, 24, 1, workers)
    assert one.seconds == pytest.approx(2.0 * math.ceil(24 / workers))
    assert one.busy == pytest.approx(24 / (workers * math.ceil(24 / workers)))


def test_parts_and_merges_follow_each_other():
    costs = simulation.Costs((3.0,), (0.5,), 0.0)
    assert simulation.run(costs, 1, 4, 4).seconds == pytest.approx(3.5)
    assert simulation.run(costs, 1, 4, 2).seconds == pytest.approx(6.5)
    assert simulation.run(costs, 5, 4, 1).seconds == pytest.approx(5 * 12.5)


def test_a_busy_sender_ends_the_growth():
    costs = simulation.Costs((), (1.0,), 0.01)
    assert simulation.limit(costs, 1) == pytest.approx(100.0)
    few, many = simulation.run(costs, 5000, 1, 50), simulation.run(costs, 5000, 1, 1000)
    # 5000 tasks of 10 ms are 50 s, whatever the workers do; the last image then takes 1 s.
    assert 50.0 <= many.seconds <= 52.0 and many.sender_busy > 0.95
    assert few.seconds == pytest.approx(100.0, rel=0.03)


def test_the_same_seed_gives_the_same_events():
    costs = simulation.Costs((1.0, 2.0, 3.0), (0.1,), 0.001)
    assert simulation.run(costs, 10, 4, 7, seed=2) == simulation.run(costs, 10, 4, 7, seed=2)
