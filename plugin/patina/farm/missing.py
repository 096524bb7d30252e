"""Renders a part with the flags that another part was made with."""
import argparse

from patina import inputs
from patina.cli.errors import CommandError


def render(description, part, file, arguments):
    """:param description: partial.Description of a part of the same frame
    :param file: takes the part
    :param arguments: of the command that asks for it
    :raises CommandError: where it cannot be rendered, or would be another frame's"""
    from patina.cli import record

    inputs.forget()  # parts that were merged are no inputs of the render
    flags = argparse.Namespace(**description.arguments)
    flags.image, flags.part, flags.partial, flags.json = arguments.image, part, file, None
    flags.threads, flags.quiet = arguments.threads, arguments.quiet
    try:
        record.run(flags)
    except CommandError as error:
        raise CommandError(f"part {part} is missing, and cannot be rendered: {error}") from error
