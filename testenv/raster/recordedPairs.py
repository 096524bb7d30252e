# SPDX-License-Identifier: Apache-2.0
"""Measurements of each test scene with many samples: recordedPairs.json beside this file, the table of
docs/measurements/rasterPairs.md.

Nothing is held against these numbers but themselves: a lint reads them (test_recordedPairs.py). `settings` are samples and
width; `scenes` maps a name to
  same    true where both back ends have the same answer to direct light
  why     what the rasterizer leaves out, where they differ by design; or why FLIP is not below LARGEST_FLIP yet
  checks  what else stands for the scene: tests against other renderers or closed forms
  full    what was measured: FLIP against direct light and against all light, RMSE, bias, seconds; `flipSeeds` between two
          seeds of the path tracer
  truth   the same direct light beside many more path traced samples: how many, and FLIP of both back ends' images from
          them. Where FLIP is above LARGEST_FLIP the rasterizer's is below it, or no larger than the path tracer's
"""
import json
import os

FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "recordedPairs.json")
LARGEST_FLIP = 0.01  # where both have the same answer


def load():
    with open(FILE, encoding="utf-8") as file:
        return json.load(file)


def save(recorded):
    """A line for each scene."""
    scenes = ",\n".join(f" {json.dumps(name)}: {json.dumps(entry)}" for name, entry in recorded["scenes"].items())
    with open(FILE, "w", encoding="utf-8") as file:
        file.write(f'{{"settings": {json.dumps(recorded["settings"])},\n"scenes": {{\n{scenes}\n}}}}\n')


def rounded(value):
    return float(f"{value:.3g}")
