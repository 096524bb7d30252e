"""`patina record --report`: which page each shot has, and what it is made from."""
import os

from patina.cli import frames, outputs
from patina.cli.errors import UsageError

AOVS = ("albedo", "normal", "depth", "primId")  # that the page shows beside those that are asked for
EXTENSIONS = (".html", ".htm")


def check_usage(arguments):
    """:raises UsageError: where --report names no page"""
    if arguments.report and os.path.splitext(arguments.report)[1].lower() not in EXTENSIONS:
        raise UsageError(f"patina record: --report {arguments.report}: a page ends in .html")


def path_of(arguments, shot):
    """:returns: the page of a shot, or None; the last has it where its name has no place for the frame"""
    if not arguments.report:
        return None
    return frames.named(arguments.report, shot.frame, 0)


def write(job, film, shot, settings, info):
    """Writes the page of a shot whose image is written.

    :param job: record's
    :param info: what the reader told of the stage"""
    from patina.report import page

    outputs.write_text(path_of(job.arguments, shot), page.document(job, film, shot, settings, info))
