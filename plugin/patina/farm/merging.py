# SPDX-License-Identifier: Apache-2.0
"""Makes an image of the parts of a frame, as `patina record` would have made it at once."""
import argparse
import json

from patina.cli import denoiser, statistics
from patina.cli.errors import CommandError
from patina.farm import partial

def merge(module, parts, image, threads=0):
    """Merges all parts and writes the image.

    :param parts: parts.Parts without missing ones
    :returns: statistics.Statistics of the frame
    :raises CommandError: where a file is damaged or the image cannot be written"""
    first = parts.first
    arguments = argparse.Namespace(**first.arguments)
    arguments.image, arguments.threads, arguments.denoise = image, threads, first.denoise
    if arguments.denoise:
        denoiser.prepare(module)
    film, reports = module.Film(), []
    try:
        for description in parts.in_order():
            report = module.merge_partial(film, description.file, description.noise, first.settings["minSamples"])
            reports.append(json.loads(report))
    except RuntimeError as error:
        raise CommandError(str(error)) from error
    except (KeyError, TypeError, ValueError) as error:
        raise CommandError(f"{description.file} is of another version of Patina") from error
    merged = _MergedStatistics(arguments, first.frame, image, reports)
    merged.rendered(_state(reports), film)
    if arguments.denoise:
        denoiser.run(module, film, threads)
    try:
        module.write_images(film, image, first.options,
                            merged.metadata(arguments, first.settings, first.camera))
    except RuntimeError as error:
        raise CommandError(str(error)) from error
    merged.end_frame()
    return merged


def _state(reports):
    """:returns: what the renderer of a whole frame would have said at its end"""
    sums = {}
    for report in reports:
        partial.add_up(sums, report["statistics"])
    return {"statistics": {**reports[0]["statistics"], **sums, "secondsBuild": 0.0},
            "plans": reports[0]["plans"], "sceneChoices": reports[0]["sceneChoices"],
            "backend": reports[0]["backend"], "materialSeconds": {}, "converged": True}


class _MergedStatistics(statistics.Statistics):
    """The numbers of a frame whose parts were rendered elsewhere."""

    def __init__(self, arguments, frame, image, reports):
        super().__init__(arguments)
        self.begin_frame(frame, [image])
        for report in reports:
            for phase, seconds in report["seconds"].items():
                self.seconds[phase] = self.seconds.get(phase, 0.0) + seconds
            known = [(one["prim"], one["input"], one["message"]) for one in self._own]
            self._own += [one for one in report["warnings"] if (one["prim"], one["input"], one["message"]) not in known]
