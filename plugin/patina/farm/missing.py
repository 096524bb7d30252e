# SPDX-License-Identifier: Apache-2.0
"""Renders a part with the flags that another part was made with."""
import contextlib
import os

from patina import inputs
from patina.cli import main, record, recordFlags
from patina.cli.errors import CommandError, UsageError
from patina.farm import partial


def render(description, part, file, arguments):
    """:param description: partial.Description of a part of the same frame
    :param file: takes the part
    :param arguments: of the command that asks for it
    :raises CommandError: where it cannot be rendered, or would be another frame's"""
    inputs.forget()  # parts that were merged are no inputs of the render
    flags = _flags(description.arguments)
    flags.image, flags.part, flags.partial, flags.json = os.path.abspath(arguments.image), part, os.path.abspath(file), None
    flags.threads, flags.quiet = arguments.threads, arguments.quiet
    try:
        with _inside(description.home):
            record.run(flags)
    except (CommandError, UsageError) as error:
        raise CommandError(f"part {part} is missing, and cannot be rendered: {error}") from error
    except partial.FOREIGN as error:
        raise partial.foreign(description.file) from error


def _flags(typed):
    """:param typed: dict of a part's arguments
    :returns: arguments of `patina record` with these values; names that this version does not know are left out"""
    parser = main._Parser(prog="patina record")
    recordFlags.add_arguments(parser)
    flags = parser.parse_intermixed_args(["stage"])
    for name, value in typed.items():
        if name in flags:
            setattr(flags, name, value)
    flags.given = typed.get("given", ())
    return flags


@contextlib.contextmanager
def _inside(folder):
    """The block runs in the folder that the flags were typed in: stage, layers and search paths are named relative to it. Where
    it is not there, as on another machine, the block runs where it is."""
    before = os.getcwd()
    with contextlib.suppress(OSError):
        os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)
