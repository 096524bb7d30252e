# SPDX-License-Identifier: Apache-2.0
"""The shots that `patina record` renders, one after the other."""
import os

import numpy as np

from patina.cli import denoiser, frames, products, recordFlags, settingFlags
from patina.cli.errors import CommandError, UsageError
from patina.cli.shot import Output, Shot

DEFAULT_WIDTH = 960


def plan(arguments, stage, settings_prim=None):
    """:param settings_prim: renderSettings.SettingsPrim, or None
    :returns: list of Shots, frame by frame"""
    if settings_prim is None:
        own = tuple(["color", "alpha"] + recordFlags.aovs_of(arguments))
        size = arguments.imageWidth, arguments.imageHeight
        planned = [Shot(frame, [Output(image, own, arguments.half)], arguments.camera, size)
                   for frame, image in frames.plan(arguments, stage)]
        if arguments.deep:
            _add_deep(planned, arguments, stage)
        return planned
    times, decimals = frames.times(arguments, stage)
    if arguments.image and (arguments.frames or frames.has_place(arguments.image)):
        frames.plan(arguments, stage)  # complains where the name does not fit
    shots = [shot for time in times for shot in products.shots_at(settings_prim, arguments, time, decimals)]
    if not shots:
        raise CommandError(f"{settings_prim.path} has no product that can be written")
    known = {}
    for shot in shots:
        for image in shot.images:
            place = os.path.realpath(image)
            if place in known:
                raise CommandError(f"{image} would be written twice" + (
                    f": for frames {known[place]:g} and {shot.frame:g} (its name needs a place such as ####)"
                    if shot.frame != known[place] else ": two products have this name"))
            known[place] = shot.frame
    return shots


def _add_deep(planned, arguments, stage):
    if len(planned) > 1 and not frames.has_place(arguments.deep):
        raise UsageError(f"patina record: --deep {arguments.deep} has no place for the frame (deep.####.exr)")
    _, decimals = frames.times(arguments, stage)
    for shot in planned:
        shot.outputs.append(Output(frames.named(arguments.deep, shot.frame, decimals), (), deep=True))


def size_of(shot, camera, pixel_aspect):
    """:param camera: dict of the scene
    :param pixel_aspect: width of a pixel over its height
    :returns: width and height in pixels: what is not given follows from the camera's aperture or field of view
    :raises CommandError: where they are too large"""
    width, height = shot.size
    aspect = camera["image_aspect"] / pixel_aspect
    most = recordFlags.LARGEST_SIZE + 1  # an aspect may be near 0 or infinite
    if width is None:
        width = DEFAULT_WIDTH if height is None else max(1, round(min(height * aspect, most)))
    if height is None:  # cut in single precision, as usdrecord does
        single = np.float32(aspect)
        height = max(1, int(min(np.float32(width) / single, most))) if single > 0 else most
    if width * height > recordFlags.MAX_PIXELS or max(width, height) > recordFlags.LARGEST_SIZE:
        told = (f"more than {most - 1}" if n >= most else str(n) for n in (width, height))
        raise CommandError(f"an image of {' x '.join(told)} pixels is too large")
    return width, height


def place(settings, size, camera, warn):
    """Sets the film's size, and the aspect of its pixels where that follows from the camera. Where the data window reaches
    beyond the frame, the film is that window.

    :param settings: dict of render settings, changed
    :param size: of the frame, pixels
    :param warn: takes an input's name, the id of a message and its fields"""
    width, height = settings["width"], settings["height"] = size
    if settings.get("aspectRatioConformPolicy") == "adjustPixelAspectRatio":
        least, most = settingFlags.table()["pixelAspectRatio"].words["flagRange"]
        settings["pixelAspectRatio"] = min(max(camera["image_aspect"] * height / width, least), most)
    window = settings.get("dataWindow")
    if not window or window[0] >= 0 and window[1] >= 0 and window[2] < width and window[3] < height:
        return
    film = window[2] - window[0] + 1, window[3] - window[1] + 1
    if camera["has_overscan"] and film[0] * film[1] <= recordFlags.MAX_PIXELS and max(film) <= recordFlags.LARGEST_SIZE:
        x, y = window[:2]
        settings.update(width=film[0], height=film[1], frameWindow=[-x, -y, width - 1 - x, height - 1 - y])
        del settings["dataWindow"]
        return
    warn("dataWindowNDC", "windowBeyondImage")
    window = [max(window[0], 0), max(window[1], 0), min(window[2], width - 1), min(window[3], height - 1)]
    settings["dataWindow"] = window
    if window[2] < window[0] or window[3] < window[1]:
        del settings["dataWindow"]


def image_options(arguments, shot, output, settings):
    """:param settings: of the render
    :returns: dict of image options of a file"""
    options = dict(recordFlags.image_options_of(arguments), aovs=list(output.aovs), half=output.half, deep=output.deep,
                   pixel_aspect_ratio=settings["pixelAspectRatio"])
    frame = settings.get("frameWindow")
    if frame:
        x, y = -frame[0], -frame[1]
        options.update(display_width=frame[2] - frame[0] + 1, display_height=frame[3] - frame[1] + 1,
                       data_window=[x, y, x + settings["width"] - 1, y + settings["height"] - 1])
    elif "dataWindow" in settings:
        options["data_window"] = settings["dataWindow"]
    if arguments.denoise and "color" in output.aovs and output.image.lower().endswith(".exr"):
        options["aovs"].append(denoiser.NOISY)
    return options


def check_usage(arguments):
    """:raises UsageError: where neither an image nor settings say what to write, or both say where"""
    if arguments.deep and (arguments.settings or arguments.renderPassPrimPath):
        raise UsageError("patina record: --deep is of IMAGE alone; with --settings a product of type deepRaster is such a file")
    for flag in ("resume", "keepCheckpoint") if arguments.deep else ():
        if getattr(arguments, flag):
            raise UsageError(f"patina record: --deep with --{flag}: a checkpoint has no depths")
    if arguments.denoiseLater and (arguments.settings or arguments.renderPassPrimPath):
        raise UsageError("patina record: --denoiseLater is of IMAGE alone; a product's orderedVars name such AOVs")
    if arguments.settings and arguments.renderPassPrimPath:
        raise UsageError("patina record: --renderPassPrimPath names its own settings; --settings cannot be beside it")
    if not arguments.image and not arguments.settings and not arguments.renderPassPrimPath:
        raise UsageError("patina record: name an IMAGE, or --settings PRIM to write its products")
    if arguments.image and arguments.outputFolder:
        raise UsageError("patina record: --outputFolder is of products, which are written where there is no IMAGE")
