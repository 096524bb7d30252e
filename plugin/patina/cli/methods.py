"""--method: which way is taken where something can be computed in several ways."""
import argparse

from patina.cli import compiled
from patina.cli.errors import UsageError


class _Append(argparse.Action):
    """Collects POINT=NAME; `list` prints every choice point and ends."""

    def __call__(self, parser, namespace, value, option_string=None):
        if value == "list":
            for point, choices in compiled.load().choice_points():
                print(point)
                for i, (name, description) in enumerate(choices):
                    print(f"  {name}{' (default)' if i == 0 else ''}: {description}")
            parser.exit(0)
        setattr(namespace, self.dest, getattr(namespace, self.dest) + [value])


def add_argument(group):
    group.add_argument("--method", action=_Append, default=[], metavar="POINT=NAME",
                       help="force a method at a choice point (repeatable); `--method list` shows them all")


def parse(texts):
    """:returns: dict of choice point to method
    :raises UsageError: for what does not exist"""
    chosen = {}
    for text in texts:
        point, equals, name = text.partition("=")
        if not point or not equals or not name:
            raise UsageError(f"--method {text}: write it as POINT=NAME")
        chosen[point] = name
    problem = compiled.load().check_methods(chosen) if chosen else ""
    if problem:
        raise UsageError(f"--method: {problem}")
    return chosen
