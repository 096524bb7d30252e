# SPDX-License-Identifier: Apache-2.0
"""The most that input may ask for in this process: the rows of base/limits.def, and --limit NAME=VALUE."""
import argparse
import functools
import sys

from patina.cli import rows
from patina.cli.compiled import _patina
from patina.cli.errors import UsageError

_TABLE = "base/limits.def"


@functools.lru_cache(maxsize=None)
def table():
    """:returns: dict of name -> (default, least value, largest value, "unit: of what")"""
    return {row.values[0]: (*map(int, row.values[1:4]), row.text(4)) for row in rows.read(_TABLE, "LIMIT")}


def value(name):
    """:returns: the one that holds; the default where the compiled module is missing"""
    module = sys.modules.get("_patina")
    if module is None:
        try:
            import _patina as module
        except ImportError:
            return table()[name][0]
    return module.limits()[name]


class Collect(argparse.Action):
    """Collects values; `list` shows what there is and ends, as --help does."""

    def __init__(self, listing, **keywords):
        super().__init__(**keywords)
        self._listing = listing

    def __call__(self, parser, namespace, value, option_string=None):
        if value == "list":
            print(self._listing())
            parser.exit()
        setattr(namespace, self.dest, [*getattr(namespace, self.dest), value])


def add_flag(group):
    group.add_argument("--limit", action=Collect, listing=listing, default=[], metavar="NAME=VALUE",
                       help="the most that the input may ask for; parts beyond it are left out with a message (repeatable); "
                            "--limit list shows all limits")


def listing():
    """:returns: the limits in lines of text"""
    width = max(map(len, table()))
    return "\n".join(f"{name:<{width}}  {default:>14}  {text}" for name, (default, _, _, text) in table().items())


def apply(texts):
    """Sets those that are named; all others have their defaults again.

    :param texts: NAME=VALUE of each
    :raises UsageError: where one is none"""
    wanted = {}
    for text in texts:
        name, equals, number = text.partition("=")
        if not name or not equals or not number.isascii() or not number.isdigit():
            raise UsageError(f"patina: --limit {text}: write it as NAME=VALUE, with a whole number")
        wanted[name] = int(number)
        if name in table() and not table()[name][1] <= wanted[name] <= table()[name][2]:
            raise UsageError(f"patina: --limit {text}: {name} is from {table()[name][1]} to {table()[name][2]}")
    if not wanted and "_patina" not in sys.modules:
        return
    problem = _patina.set_limits(wanted)
    if problem:
        raise UsageError(f"patina: --limit: {problem}")
