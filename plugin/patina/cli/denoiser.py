# SPDX-License-Identifier: Apache-2.0
"""Open Image Denoise: where its library is, and a film's colour cleaned by it."""
import importlib.util
import os

from patina.cli.errors import CommandError

GUIDES = ("denoisingAlbedo", "denoisingNormal")  # AOVs that lead it
HALVES = ("denoisingHalfColor", "denoisingHalfAlbedo", "denoisingHalfNormal")  # and those that tell how far off it is
MOTION = ("motionForward", "motionBackward", "depth")  # AOVs by which frames of a sequence find each other
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


def aovs(settings, backend):
    """:param settings: of the render
    :returns: AOVs that it needs to be denoised. Halves tell nothing of photons or light that they share"""
    methods = settings["methods"]
    shares = methods.get("caustics") == "photons" or methods.get("indirectLight") == "shared"
    tells = settings["tolerance"] > 0.0 and backend == "embree" and not shares
    return GUIDES + (HALVES if tells else ())


def run(module, film, threads=0, aovs=False):
    """:param aovs: of light, too
    :raises CommandError: in one line; the film is as before"""
    try:
        module.denoise(film, threads, aovs)
    except RuntimeError as error:
        raise CommandError(f"--denoise: {error}") from None


def run_where_it_helps(module, film, numbers, threads=0, aovs=False):
    """Leaves an image as it is whose means are nearer to their limit than the denoiser would come.

    :param numbers: statistics of the frame
    :returns: None, or what was decided, in words
    :raises CommandError: as run() does"""
    left, clean = numbers.get("estimatedError"), numbers.get("denoisedError")
    if left is None or clean is None or clean <= left:
        return run(module, film, threads, aovs)
    module.keep_noisy(film)
    return (f"{numbers['image']}: not denoised, since its noise of {100.0 * left:.2g} % is less than the error of "
            f"{100.0 * clean:.2g} % that the denoiser would leave")


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
