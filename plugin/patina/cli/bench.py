# SPDX-License-Identifier: Apache-2.0
"""Runs benchmarks, beside peers where these are installed.

  patina bench             lists them
  patina bench hydra --json out.json

They are part of a checkout (testenv/bench), as the tests are. Figures drift between runs and machines;
the ratios of one run count.
"""
from patina.cli import checkout
from patina.cli.errors import UsageError

PASSES_ON = AS_TYPED = True  # benchmarks read their own flags, --json FILE among them
# name -> (module of testenv/bench that has main(arguments), what it measures)
BENCHMARKS = {
    "denoise": ("denoiseBench", "denoised images: seconds until they look like the reference; beside Cycles"),
    "features": ("featureBench", "features beside the renderer without them: processor time, and error over time as charts"),
    "frame": ("frameBench", "the processor's share of a viewport's frame, with a driver that draws nothing; beside Storm"),
    "growth": ("growthBench", "growth with triangles, instances, prims, prototypes, lights, materials and textures: seconds "
                                 "to the first image, of a sample, and memory"),
    "hydra": ("hydraBench", "frames in Hydra: first, after a camera move, rays per second, memory; beside "
                               "hdEmbree and Storm"),
    "lobes": ("lobeBench", "what the lobes of a constant material cost at a vertex of a path; beside Mitsuba 3"),
    "path": ("pathBench",
             "path tracing: seconds until the error is small, what a sample takes; beside Mitsuba 3 and Cycles"),
    "plan": ("planBench", "the plan: time to a tolerance with planned methods, beside the same tolerance without a plan"),
    "raster": ("rasterBench", "frames of the rasterizer: first, after an edit, after a camera move, and where their time "
                                 "goes; beside Storm"),
    "rays": ("rayBench", "rays per second of a path traced frame, beside the same rays traced with nothing around"),
    "view": ("viewBench",
             "pages of `patina view` in headless Chromium: size, seconds to the first picture and to 64 samples"),
    "viewport": ("viewportBench", "first images, and images after edits, in UsdImagingGLEngine; beside Storm, hdEmbree and "
                                     "Cycles"),
}


def add_arguments(parser):
    parser.usage = "patina bench [BENCHMARK [its arguments]]"


def run(arguments):
    if not arguments.passed_on:
        for name, (_, summary) in BENCHMARKS.items():
            print(f"  {name:<10}{summary}")
        return 0
    name, *rest = arguments.passed_on
    if name not in BENCHMARKS:
        raise UsageError(f"patina bench: there is no benchmark '{name}' (there are: {', '.join(BENCHMARKS)})")
    return _load(BENCHMARKS[name][0]).main(rest)


def _load(module):
    checkout.require(f"testenv/bench/{module}.py", "bench", "the benchmarks are")
    return checkout.module("testenv/bench", module)
