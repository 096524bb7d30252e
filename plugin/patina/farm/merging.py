# SPDX-License-Identifier: Apache-2.0
"""Makes an image of the parts of a frame, as `patina record` would have made it at once."""
import argparse
import json

from patina import messages
from patina.cli import denoiser, planText, statistics
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError
from patina.farm import partial


def merge(parts, image, threads=0):
    """Merges all parts and writes the image.

    :param parts: parts.Parts without missing ones
    :returns: statistics.Statistics of the frame
    :raises CommandError: where a file is damaged or the image cannot be written"""
    try:
        return _merge(parts, image, threads)
    except partial.FOREIGN as error:
        raise partial.foreign(parts.first.file) from error


def _merge(parts, image, threads):
    first = parts.first
    arguments = argparse.Namespace(**first.arguments)
    arguments.image, arguments.threads, arguments.denoise = image, threads, first.denoise
    if arguments.denoise:
        denoiser.prepare(_patina)
    errors, limit = _patina.PartialErrors() if first.noise > 0.0 else None, 0
    film, reports = _film(parts, 0, errors)
    if errors:  # the whole was done before tiles that did not know it
        limit = errors.samples_of_whole(first.noise, int(first.settings["minSamples"]))
        if limit:
            film, reports = _film(parts, limit, None)
    if errors and arguments.denoise:
        film = _within_denoised(parts, threads, errors, limit) or film
    merged = _MergedStatistics(arguments, first.frame, image, reports)
    merged.rendered(_state(reports), film)
    if arguments.denoise:
        error = _patina.denoised_error(film, threads)
        if error >= 0.0:
            merged.current()["denoisedError"] = error
        left = denoiser.run_where_it_helps(_patina, film, merged.current(), threads)
        merged.note([left] if left else [])
    try:
        _patina.write_images(film, image, first.options,
                            merged.metadata(arguments, first.settings, first.camera))
    except RuntimeError as error:
        raise CommandError(str(error)) from error
    merged.end_frame()
    return merged


def _within_denoised(parts, threads, errors, limit):
    """:param limit: the count at which it was done by its means; 0: at none
    :returns: the film at the count at which the image rendered at once was done, since it would be within the tolerance
        when denoised; None where it never was"""
    first = parts.first
    for samples in errors.steps_of_whole(int(first.settings["minSamples"])):
        if 0 < limit <= samples:
            break
        film = _film(parts, samples, None)[0]
        if 0.0 <= _patina.denoised_error(film, threads) <= first.noise:
            return film
    return None


def _film(parts, samples, errors):
    """:param samples: the most of a tile; 0: all
    :param errors: _patina.PartialErrors that is told those of the tiles, or None
    :returns: the film of all parts, and their reports"""
    film, reports = _patina.Film(), []
    for description in parts.in_order():
        try:
            text = _patina.merge_partial(film, description.file, description.noise, int(description.settings["minSamples"]),
                                        samples, errors)
            reports.append(_report(text))
        except RuntimeError as error:
            raise CommandError(str(error)) from error
        except partial.FOREIGN as error:
            raise partial.foreign(description.file) from error
    return film, reports


def _report(text):
    """Looks at all that is used after the image is written, too: it is then too late to refuse a part.

    :returns: the report of a part
    :raises Exception: one of partial.FOREIGN, where it is none"""
    report = json.loads(text)
    warnings = report["warnings"]
    made = [messages.warning(one["prim"], one["input"], one["id"], *one["fields"].values()) for one in warnings]
    numbers = [report["seconds"]["render"], *report["seconds"].values(), *report["statistics"].values(),
               *(one["count"] for one in warnings)]
    if not isinstance(report["backend"], str) or not all(isinstance(number, (int, float)) for number in numbers):
        raise TypeError
    if any({**one, "count": own["count"]} != own for own, one in zip(made, warnings)):
        raise ValueError
    planText.of_scene(report["plans"], report["sceneChoices"])
    return report


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
        spent = self.current()["seconds"]
        for report in reports:
            for phase, seconds in report["seconds"].items():
                spent[phase] = spent.get(phase, 0.0) + seconds
            known = [(one["prim"], one["input"], one["message"]) for one in self._own]
            self._own += [one for one in report["warnings"] if (one["prim"], one["input"], one["message"]) not in known]
