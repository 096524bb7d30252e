# SPDX-License-Identifier: Apache-2.0
"""`patina record --report`: which page each shot has, and what it is made from."""
import os

from patina.cli import frames, outputs
from patina.cli.errors import CommandError, UsageError
from patina.report import page

AOVS = ("albedo", "normal", "depth", "primId")  # that the page shows beside those that are asked for
EXTENSIONS = (".html", ".htm")


def check_usage(arguments):
    """:raises UsageError: where --report names no page"""
    if arguments.report and os.path.splitext(arguments.report)[1].lower() not in EXTENSIONS:
        raise UsageError(f"patina record: --report {arguments.report}: a page ends in .html")


def plan(arguments, shots, stage):
    """Gives each shot its page. Frames share one where its name has no place for the frame: the last has it. Further renders
    of one frame, as of products with other cameras, have theirs beside it: page.2.html.

    :raises CommandError: where two frames would have the same page, though its name has a place"""
    if not arguments.report:
        return
    decimals = frames.times(arguments, stage)[1]
    place, (stem, extension) = frames.has_place(arguments.report), os.path.splitext(arguments.report)
    renders, known = {}, {}
    for shot in shots:
        number = renders[shot.frame] = renders.get(shot.frame, 0) + 1
        shot.page = frames.named(stem + (f".{number}" if number > 1 else "") + extension, shot.frame, decimals)
        if place and known.setdefault(shot.page, shot.frame) != shot.frame:
            raise CommandError(f"{shot.page} would be the page of frames {known[shot.page]:g} and {shot.frame:g}")


def write(job, film, shot, settings, info):
    """Writes the page of a shot whose image is written.

    :param job: record's
    :param info: what the reader told of the stage
    :returns: None, or why there is no page: the image is there all the same"""
    try:
        outputs.write_text(shot.page, page.document(job, film, shot, settings, info))
    except Exception as error:
        return str(error) or type(error).__name__
    return None
