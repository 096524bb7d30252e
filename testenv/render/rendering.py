"""Helpers of the image tests: render a stage with the command line, read pixels back."""
import os
import subprocess
import sys

import numpy as np

SCENES = os.path.normpath(os.path.join(os.path.dirname(__file__), "..", "scenes"))


def scene(name):
    return os.path.join(SCENES, name + ".usda")


def patina(*arguments, check=True, **keywords):
    """Runs the command line. :returns: the finished process, with text output"""
    process = subprocess.run([sys.executable, "-m", "patina", *map(str, arguments)], capture_output=True,
                             text=True, **keywords)
    if check and process.returncode != 0:
        raise AssertionError(f"patina {' '.join(map(str, arguments))}\n{process.stderr}")
    return process


def record(stage, image, *arguments, check=True):
    return patina("record", stage, image, "--quiet", *arguments, check=check)


def pixels(image):
    """:returns: float array (height, width, channels) of all channels, linear for EXR"""
    import _patina

    return np.array(_patina.read_image(str(image)).pixels)


def color(image, channels="RGB"):
    """:returns: float array (height, width, 3) of the named channels"""
    import _patina

    found = _patina.read_image(str(image))
    return np.array(found.pixels)[..., [found.channels.index(c) for c in channels]]
