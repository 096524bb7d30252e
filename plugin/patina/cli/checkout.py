# SPDX-License-Identifier: Apache-2.0
"""What a checkout has and an installation lacks: tests, benchmarks, fuzzers, the site."""
import importlib
import os
import sys

from patina.cli.errors import CommandError

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))


def require(file, command, what):
    """:param file: that a checkout has, named from its root
    :param command: of patina that needs it
    :param what: as in "the tests are"
    :raises CommandError: where there is none"""
    if not os.path.isfile(os.path.join(ROOT, file)):
        raise CommandError(f"{what} in a checkout only: run ./patina {command} there")


def module(folder, name):
    """:returns: module `name` of `folder`, which is named from the root. The modules beside it can be imported from then on"""
    folder = os.path.join(ROOT, folder)
    if folder not in sys.path:
        sys.path.insert(0, folder)
    return importlib.import_module(name)
