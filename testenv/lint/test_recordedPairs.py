# SPDX-License-Identifier: Apache-2.0
"""The recorded pairs of docs/measurements/rasterPairs.md, read and not rendered: a lint of committed numbers."""
import os

import pairs
import recordedPairs

HELD = recordedPairs.load()


def test_every_scene_has_more_than_a_picture():
    """That the back ends agree does not say that they are right."""
    assert sorted(HELD["scenes"]) == pairs.names()
    for name, entry in HELD["scenes"].items():
        assert entry["checks"], name
        assert entry["same"] or entry.get("why"), name
        for check in entry["checks"]:
            assert os.path.isfile(os.path.join(pairs.ROOT, *check.split("/"))), (name, check)


def test_recorded_pairs_with_the_same_answer_look_alike():
    """The difference at 1024 samples, where that was measured. Where the path tracer's own noise is above the bound, both are
    held against many more of its samples: the rasterizer is within the bound there, or not farther off than the path tracer."""
    for name, entry in HELD["scenes"].items():
        if not entry["same"] or entry.get("full", {}).get("flip", 0) <= recordedPairs.LARGEST_FLIP:
            continue
        truth = entry["truth"]
        assert entry["why"] and truth["samples"] >= 16384, name
        assert truth["raster"] <= max(recordedPairs.LARGEST_FLIP, truth["traced"]), (name, truth)
