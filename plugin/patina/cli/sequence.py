# SPDX-License-Identifier: Apache-2.0
"""Frames of a sequence as OpenEXR files that `patina record` wrote: their names, and what a denoiser reads of them."""
import collections
import math
import os

import numpy as np

from patina.cli import denoiser, frames
from patina.cli.errors import CommandError

# Of AOVs that files name otherwise than NAME.X, NAME.Y, NAME.Z.
_CHANNELS = {"alpha": ["A"], "depth": ["depth.Z"], "sampleCount": ["sampleCount"],
             "denoisingAlbedo": ["denoisingAlbedo." + c for c in "RGB"]}
_COMPONENTS = {"motionForward": 2, "motionBackward": 2}
# Of the file itself: they are written anew.
_OF_FILES = ("screenWindowCenter", "screenWindowWidth", "compression", "PixelAspectRatio", "DateTime")


class Sequence:
    """Files by their frames, of which the last that were read are kept."""

    def __init__(self, module, pattern, around):
        self._module, self._pattern, self._around = module, pattern, around
        self.decimals = 0
        self._kept = collections.OrderedDict()  # path -> Image
        self._first = None  # whose size all have

    def path(self, frame):
        return frames.named(self._pattern, frame, self.decimals)

    def _reach(self, frame, step):
        """:returns: frames to one side, from the nearest on, and the path that ends them: None where none is missing"""
        reached = []
        for k in range(1, self._around + 1):
            if not os.path.exists(self.path(frame + k * step)):
                return reached, self.path(frame + k * step)
            reached.append(frame + k * step)
        return reached, None

    def around_of(self, frame):
        """:returns: the frames that take part in one, itself among them, in order; those behind a missing one do not"""
        if not self._around:
            return [frame]
        return [*reversed(self._reach(frame, -1.0)[0]), frame, *self._reach(frame, 1.0)[0]]

    def paths(self, frame):
        return [self.path(other) for other in self.around_of(frame)]

    def absent(self, frame):
        """:returns: paths of the nearest frames that are missing"""
        if not self._around:
            return []
        return [path for path in (self._reach(frame, -1.0)[1], self._reach(frame, 1.0)[1]) if path]

    def names_of(self, frame):
        """:returns: the frames around, as text"""
        return " ".join(f"{other:g}" for other in self.around_of(frame) if other != frame)

    def read(self, frame):
        """:raises CommandError: where a file is none, has not what it needs, or another size than the others"""
        path = self.path(frame)
        image = self._kept.pop(path, None) or Image(self._module, path, bool(self._around))
        self._kept[path] = image
        while len(self._kept) > 2 * self._around + 1:
            self._kept.popitem(last=False)
        self._first = self._first or (path, image.window)
        if self._around and image.window != self._first[1]:
            raise CommandError(f"{path} has {_size(image.window)}, but {self._first[0]} has {_size(self._first[1])}: "
                               "frames around each other need the same")
        return image


class Image:
    """A frame: arrays of what a denoiser reads. The file's other channels are read once more when they are written."""

    def __init__(self, module, path, moves):
        """:param moves: whether other frames are to be taken along its motion"""
        image = module.read_image(path)
        self.path, self.metadata = path, image.metadata
        self.window = (image.width, image.height, image.x, image.y, image.display_width, image.display_height)
        self._aspect = image.pixel_aspect_ratio
        needed = (*denoiser.GUIDES, *(denoiser.MOTION if moves else ()))
        self.arrays = {"color": _found(image, [denoiser.NOISY + "." + c for c in "RGB"]), "alpha": _found(image, ["A"])}
        if self.arrays["color"] is None:
            self.arrays["color"] = _found(image, list("RGB"))
        if self.arrays["alpha"] is None:
            self.arrays["alpha"] = np.ones((image.height, image.width), np.float32)
        for name in (*needed, "sampleCount"):
            self.arrays[name] = _found(image, _CHANNELS.get(name) or [
                f"{name}.{c}" for c in "XYZ"[:_COMPONENTS.get(name, 3)]])
        missing = [name for name in ("color", *needed) if self.arrays[name] is None]
        if missing:
            raise CommandError(f"{path} has no {', '.join(missing)}: record it with --denoiseLater, or with "
                               + " ".join(f"--aov {name}" for name in missing))
        if self.arrays["sampleCount"] is None:
            del self.arrays["sampleCount"]

    def finite(self, name):
        return np.where(np.isfinite(self.arrays[name]), self.arrays[name], np.float32(0))

    def not_finite(self):
        """:returns: how many pixels' colour is"""
        return int((~np.isfinite(self.arrays["color"])).any(axis=-1).sum())

    def samples(self):
        """:returns: how many samples the mean pixel has, of those that have any"""
        counts = self.arrays.get("sampleCount")
        if counts is None:
            return float(self.metadata.get("patina:samples", math.inf))
        return float(counts[counts > 0].mean()) if (counts > 0).any() else 0.0

    def write(self, module, path, color, metadata):
        """All channels with another colour; the noisy one is kept."""
        image = module.read_image(self.path)
        pixels, channels = np.array(image.pixels), list(image.channels)
        pixels[..., [channels.index(c) for c in "RGB"]] = color
        noisy = [denoiser.NOISY + "." + c for c in "RGB"]
        if not set(noisy) <= set(channels):
            pixels, channels = np.concatenate([pixels, self.arrays["color"]], axis=-1), channels + noisy
        width, height, x, y, *display = self.window
        options = {"data_window": [x, y, x + width - 1, y + height - 1], "display_width": display[0],
                   "display_height": display[1], "pixel_aspect_ratio": self._aspect,
                   "compression": str(self.metadata.get("compression", "zip"))}
        kept = {name: value for name, value in self.metadata.items()
                if name not in _OF_FILES and not name.startswith("oiio:")}
        module.write_image(path, pixels, channels, options, {**kept, "patina:denoised": 1, **metadata})


def _found(image, names):
    """:returns: the channels of these names as an array, of one channel without a third axis; None where one is missing"""
    if not all(name in image.channels for name in names):
        return None
    found = image.pixels[..., [image.channels.index(name) for name in names]]
    return np.ascontiguousarray(found[..., 0] if len(names) == 1 else found)


def _size(window):
    return "{} x {} pixels at {}, {} of {} x {}".format(*window)
