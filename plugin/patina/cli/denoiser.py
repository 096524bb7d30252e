# SPDX-License-Identifier: Apache-2.0
"""Open Image Denoise: where its library is, and a film's colour cleaned by it."""
import importlib.util
import os

from patina.cli.errors import CommandError

GUIDES = ("denoisingAlbedo", "denoisingNormal")  # AOVs that lead it
MOTION = ("motionForward", "motionBackward", "depth")  # AOVs by which frames of a sequence find each other
SAMPLES_OF_CLEAN_GUIDES = 4.0  # as hdDelegate/film/denoiser.cpp has it
NOISY = "color.noisy"  # what it started from, once a film is denoised


def prepare(module, asked="--denoise"):
    """Finds the library before anything slow.

    :param asked: what asks for it
    :raises CommandError: where there is none"""
    if not os.environ.get("PATINA_OIDN_LIBRARY"):
        module.set_denoiser_library(of_wheel())
    missing = module.denoiser_missing()
    if missing:
        raise CommandError(f"{asked}: {missing}; `pip install pyoidn` has it, or PATINA_OIDN_LIBRARY names the library")


def run(module, film, threads=0, aovs=False):
    """:param aovs: of light, too
    :raises CommandError: in one line; the film is as before"""
    try:
        module.denoise(film, threads, aovs)
    except RuntimeError as error:
        raise CommandError(f"--denoise: {error}") from None


def takes_away(film):
    """:returns: whether pixels are negative, as lights of negative intensity make them"""
    import numpy as np

    return bool((np.asarray(film.resolve("color")) < 0.0).any())


def of_wheel():
    """:returns: the library in PyPI's pyoidn, or an empty text"""
    found = importlib.util.find_spec("pyoidn")
    for folder in (found.submodule_search_locations or ()) if found else ():
        path = os.path.join(folder, "oidn", "lib", "libOpenImageDenoise.so.2")
        if os.path.exists(path):
            return path
    return ""
