"""--method POINT=NAME: forces a method at a choice point of the planner."""
import argparse
import textwrap

from patina.cli import compiled
from patina.cli.errors import UsageError


class _Method(argparse.Action):
    """Collects choices; `list` shows what there is and ends, as --help does."""

    def __call__(self, parser, namespace, value, option_string=None):
        if value == "list":
            print(_listing())
            parser.exit()
        setattr(namespace, self.dest, [*getattr(namespace, self.dest), value])


def add_flag(group):
    group.add_argument("--method", action=_Method, default=[], metavar="POINT=NAME",
                       help="force a method at a choice point (repeatable); --method list shows all of them")


def parse(texts):
    """:returns: dict of choice point -> method"""
    methods = {}
    for text in texts:
        point, equals, name = text.partition("=")
        if not point or not equals or not name:
            raise UsageError(f"--method {text}: write it as POINT=NAME")
        methods[point] = name
    problem = compiled.load().check_methods(methods) if methods else ""
    if problem:
        raise UsageError(f"--method: {problem}")
    return methods


def _listing():
    lines = []
    for point, names in compiled.load().choice_points():
        lines.append(point)
        for i, (name, description) in enumerate(names):
            text = textwrap.wrap(("(the default) " if i == 0 else "") + description, 90)
            lines += [f"  {name:<12}{text[0] if text else ''}"] + [" " * 14 + more for more in text[1:]]
    return "\n".join(lines)
