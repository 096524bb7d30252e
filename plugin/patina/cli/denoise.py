# SPDX-License-Identifier: Apache-2.0
"""Denoises OpenEXR frames that `patina record` wrote, each with the frames around it.

  patina record shot.usda noisy.####.exr --frames 1:48 --samples 16 --denoiseLater
  patina denoise noisy.####.exr shot.####.exr --frames 1:48 --around 2

With --around N the noisy colour of up to N frames before and after comes into each frame, along the vectors of motion, where
these frames see the same surface in the same light. Open Image Denoise then cleans the mean of more samples, and what it takes
for a pattern flickers less. A frame's result depends on its input frames alone: not on threads, nor on which other frames are
asked for. So machines may share the frames, and one frame that is made again fits the others.

Neighbours are found by their names, one time code apart, also beyond --frames. Those that are not there are named and left out.
The noisy colour stays as color.noisy, and a file that has one is denoised from it; all other channels stay as they are.
"""
import os
import time

from patina import inputs, limits
from patina.cli import compiled, denoiser, frames, outputs, sequence, statistics
from patina.cli.errors import CommandError, UsageError
from patina.cli.progress import Progress
from patina.messages import warning

MOST_AROUND = 16


def add_arguments(parser):
    parser.add_argument("file", metavar="FILE", help="the noisy frames (.exr); with --frames the name holds the frame's place "
                                                     "(####, <F4> or %%04d)")
    parser.add_argument("image", metavar="IMAGE", help="the images to write (.exr), named alike")
    parser.add_argument("--frames", "-f", metavar="FRAMESPEC",
                        help="the frames: a number, START:END or START:ENDxSTRIDE, several of them separated by commas")
    parser.add_argument("--around", type=_around, default=0, metavar="N",
                        help=f"also take the colour of up to N frames before and N after, at most {MOST_AROUND} (default: 0)")
    parser.add_argument("--makeOutputPath", "--make-output-path", action="store_true",
                        help="make the folders of what is written, where they are not there")
    parser.add_argument("--threads", type=_threads, default=0, metavar="N", help="threads (default: all cores)")
    limits.add_flag(parser)
    parser.add_argument("--quiet", "-q", action="store_true", help="errors only")


def run(arguments):
    module = compiled.load()
    found = sequence.Sequence(module, arguments.file, arguments.around)
    shots = _plan(arguments, found)
    for frame, _ in shots:
        for path in found.paths(frame):
            inputs.note(path)
    for path in [arguments.file] + [image for _, image in shots]:
        if not path.lower().endswith(".exr"):
            raise CommandError(f"{path}: denoise reads and writes OpenEXR (.exr); `patina merge` makes such an image of parts")
    outputs.need_folders([image for _, image in shots], arguments.makeOutputPath)
    outputs.check_all([image for _, image in shots])
    denoiser.prepare(module, "denoise")
    job = _Job(module, found, arguments)
    job.say_absent(shots)
    for frame, image in shots:
        job.denoise(frame, image)


def _plan(arguments, found):
    """:returns: list of (frame, image)
    :raises CommandError: where an input is missing"""
    if arguments.frames is None:
        if arguments.around:
            raise UsageError("patina denoise: --around needs --frames, and a place for the frame in FILE")
        if frames.has_place(arguments.file):
            raise UsageError(f"patina denoise: {arguments.file} has a place for frames, but there is no --frames")
        times, found.decimals = [None], 0
    else:
        times, found.decimals = frames.expand(arguments.frames, None, None)
        for name in (arguments.file, arguments.image):
            if not frames.has_place(name):
                raise UsageError(f"patina denoise: with --frames {name} needs one place for the frame: image.####.exr")
    shots = [(frame, frames.named(arguments.image, frame, found.decimals)) for frame in dict.fromkeys(times)]
    missing = [found.path(frame) for frame, _ in shots if not os.path.exists(found.path(frame))]
    if missing:
        raise CommandError(f"there is no file {missing[0]}" + (f", nor {len(missing) - 1} more of --frames {arguments.frames}"
                                                               if len(missing) > 1 else ""))
    return shots


class _Job:
    """One call of the command."""

    def __init__(self, module, found, arguments):
        self.module, self.found, self.arguments = module, found, arguments
        self.say = Progress("", arguments.quiet).say
        self.told_of_seeds = False

    def say_absent(self, shots):
        absent = list(dict.fromkeys(path for frame, _ in shots for path in self.found.absent(frame)))
        if absent:
            self.say(f"not there, so left out: {', '.join(absent)}")

    def denoise(self, frame, image):
        started = time.perf_counter()
        own = self.found.read(frame)
        self._look(own)
        color, frames_said, metadata = own.finite("color"), "", {}
        if self.arguments.around:
            around = [self.found.read(other) for other in self.found.around_of(frame)]
            self._look_at_seeds(own, around)
            color, shares = self.module.accumulate([other.arrays for other in around], around.index(own),
                                                   self.arguments.threads)
            frames_said = f"{shares.mean():.2f} of {len(around)} frames in the mean pixel, "
            metadata["patina:around"] = self.found.names_of(frame)
        try:
            clean = self.module.denoise_pixels(
                color, own.finite("denoisingAlbedo"), own.finite("denoisingNormal"),
                own.samples(), self.arguments.threads)
        except RuntimeError as error:
            raise CommandError(f"denoise: {error}") from None
        own.write(self.module, image, clean, metadata)
        self.say(f"{image}: {frames_said}{time.perf_counter() - started:.1f} s")

    def _look(self, own):
        spoiled = own.not_finite()
        if spoiled:
            self.say(f"{own.path}: {spoiled} pixels are not finite" + (
                "; frames around it stand for them, else black" if self.arguments.around else "; they count as black"))
        if (own.arrays["color"] < 0.0).any():
            statistics.report([warning("", "denoise", "pixelsBelowZero")], json=False)

    def _look_at_seeds(self, own, around):
        seed = own.metadata.get("patina:seed")
        same = [other for other in around if other is not own and other.metadata.get("patina:seed", object()) == seed]
        if same and not self.told_of_seeds:
            self.told_of_seeds = True
            self.say(f"{own.path} and {same[0].path} have the same seed, so what stands still has the same noise, and their "
                     "mean has no less (`record --denoiseLater` gives each frame its own)")


def _around(text):
    value = int(text)
    if not 0 <= value <= MOST_AROUND:
        raise ValueError
    return value


def _threads(text):
    value = int(text)
    if value < 0:
        raise ValueError
    return value


_around.__name__, _threads.__name__ = f"number of frames (0 to {MOST_AROUND})", "number (0 or more)"
