# SPDX-License-Identifier: Apache-2.0
"""Memory of a viewport's session: short ones, and how the hour is judged."""
import numpy as np
import pytest

import hydraBuild
import viewportSession

IMAGE = 64 * 48 * 16  # bytes: the colour of the session's image, the least that a cycle that leaks images forgets
needs_hydra = pytest.mark.skipif(bool(hydraBuild.missing()), reason=str(hydraBuild.missing()))


def samples(per_edit, noise, count=120):
    random = np.random.default_rng(5)
    return [{"seconds": 10.0 * i, "edits": 54 * i, "lost": 0, "heap": 4e7 + 54 * i * per_edit + noise * random.normal(),
             "resident": 6e7} for i in range(1, count + 1)]


def test_what_grows_and_what_is_flat():
    for per_edit, noise, expected in ((0.0, 2e4, "flat"), (8.0, 2e4, "flat"), (100.0, 2e4, "grows"), (0.0, 1e6, "undecided")):
        found = viewportSession.report(samples(per_edit, noise))
        assert found["heap"]["verdict"] == expected, found
        assert found["resident"]["verdict"] == "flat"
        assert viewportSession.row("embree", 1, found)["counts"] == (
            {"growth": 1, "fine": 54 * 120 - 1} if expected == "grows" else {"fine": 54 * 120})
    assert viewportSession.report(samples(1e3, 0.0, count=4))["heap"]["verdict"] == "undecided"


def test_what_comes_and_goes_is_no_growth():
    """Two of five counts have up to 30 MB more, as a driver has that keeps what it compiled for some cycles."""
    random = np.random.default_rng(6)
    for per_edit, expected in ((0.0, "flat"), (100.0, "grows")):
        found = samples(per_edit, 2e4)
        for sample in found:
            sample["heap"] += 3e7 * random.random() if random.random() < 0.4 else 0.0
        assert viewportSession.report(found)["heap"]["verdict"] == expected


def per_cycle(found, key):
    """:returns: the lower limit of growth, in bytes per cycle, by all counts: those of the path tracer do not come and go"""
    return viewportSession.growth(viewportSession.settled(found), key, counts=1)[1] * found[0]["edits"]


@needs_hydra
@pytest.mark.parametrize("flags", [(), ("--sceneIndex",)], ids=["delegate", "sceneIndex"])
def test_a_short_session_forgets_no_images(flags):
    found = viewportSession.run("--set", "backend=embree", "--cycles", 20, *flags, seconds=600)
    assert len(found) == 20 and found[-1]["edits"] >= 20 * 50
    for key in ("heap", "resident"):
        assert per_cycle(found, key) < IMAGE, key


@needs_hydra
def test_what_is_forgotten_shows():
    flags = ("--set", "backend=embree", "--cycles", 16, "--only", "dragCamera")
    kept = viewportSession.run(*flags, seconds=600)
    assert per_cycle(kept, "heap") < IMAGE / 2
    forgotten = viewportSession.run(*flags, "--forget", IMAGE, seconds=600)
    assert per_cycle(forgotten, "heap") > IMAGE / 2


@needs_hydra
def test_an_edit_that_is_none():
    with pytest.raises(AssertionError, match="ends with 1$"):
        viewportSession.run("--only", "noSuchEdit", seconds=1)
