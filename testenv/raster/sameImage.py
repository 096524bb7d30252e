# SPDX-License-Identifier: Apache-2.0
"""The picture of a stage by the rasterizer beside the path tracer's direct light of it or of another, by equivalence.py."""
import functools

import equivalence
import inProcess
import pairs

WIDTH = 48


@functools.lru_cache(maxsize=2)
def _drawn(path, arguments, width, samples):
    """:returns: function of a list of seeds -> images; each is rendered once"""
    stage = inProcess.Stage(path, "--backend", "raster", "-w", width, "--samples", samples, *arguments)
    image = functools.lru_cache(maxsize=None)(stage.image)
    return lambda seeds: [image(seed) for seed in seeds]


def decide(drawn, traced=None, *arguments, depth=pairs.DIRECT, width=WIDTH, power=equivalence.FULL):
    """:param drawn: path of the stage that is rasterized
    :param traced: of the one that is path traced, the same by default
    :param arguments: those of `patina record`, for both
    :param depth: of the path tracer
    :returns: (the Verdict, images of the rasterizer, images of the path tracer)"""
    flags = ["-w", width, "--samples", power.traced, "--maxDepth", depth, *arguments]
    return equivalence.decide(_drawn(str(drawn), arguments, width, power.samples),
                              lambda seeds: inProcess.references(str(traced or drawn), seeds, *flags), power)


def assert_same(drawn, traced=None, *arguments, **more):
    """:returns: (mean image of the rasterizer, mean image of the path tracer)
    :raises AssertionError: where they differ, where that cannot be said, and where there is no light"""
    verdict, raster, truth = decide(drawn, traced, *arguments, **more)
    assert truth.mean() > 1e-3, "the light is off"
    assert not verdict.differs.any() and not verdict.open, verdict.text()
    return raster.mean(axis=0), truth.mean(axis=0)
