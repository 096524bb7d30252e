# SPDX-License-Identifier: Apache-2.0
"""Squares of 4 x 4 units that glow in one colour each, and their pictures by usdrecord and by the command line."""
import subprocess
import sys

import hydraBuild
from rendering import pixels
from usda import card, preview

WIDTH = 40
COLORS = {"a": (1, 0, 0), "b": (0, 1, 0), "c": (0, 0, 1), "d": (1, 1, 0)}


def tile(name):
    """:param name: of one of COLORS"""
    return card("tile", 2, bind=f"World/look{name}")


def looks():
    """:returns: text of their materials, which are children of /World"""
    return "".join(preview(f"look{name}", inside="/World", diffuseColor=(0, 0, 0), useSpecularWorkflow=1,
                           specularColor=(0, 0, 0), emissiveColor=rgb) for name, rgb in COLORS.items())


def pictures(stage, tmp_path, *flags):
    """:returns: (that of usdrecord, that of the command line), each (height, width, 4)"""
    words = ["--imageWidth", str(WIDTH), "--disableCameraLight", "--colorCorrectionMode", "disabled", *flags]
    found, wanted = tmp_path / "hydra.exr", tmp_path / "record.exr"
    hydraBuild.run_usdrecord(stage, found, *words, scene_index=True)
    subprocess.run([sys.executable, "-m", "patina", "record", str(stage), str(wanted), "--samples", "4", "--quiet", *words],
                   check=True)
    return [pixels(path)[..., :4] for path in (found, wanted)]
