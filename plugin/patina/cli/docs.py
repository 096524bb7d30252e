# SPDX-License-Identifier: Apache-2.0
"""Builds the site: documents, tutorials, gallery, measurements, and the reference of the Python and C++ interfaces.

  patina docs site                  then open site/index.html

The pages are read without a server and without a network, search included. They are part of a checkout (docs/site). To build
them, ./patina docs installs MkDocs. It also needs npm for the script that draws diagrams, and Doxygen for the C++ pages. If one
of these two is missing, a line says which part is left out.
"""
import importlib.util
import os

from patina.cli import checkout
from patina.cli.errors import CommandError


def add_arguments(parser):
    parser.add_argument("folder", metavar="FOLDER", help="where the site goes: a new or empty folder, or one that holds an "
                                                         "earlier site")
    parser.add_argument("--strict", action="store_true",
                        help="exit with 1 where a page links to nothing, or a part is left out")


def run(arguments):
    checkout.require("docs/site/build.py", "docs", "the documents are")
    if importlib.util.find_spec("mkdocs") is None:
        raise CommandError("PyPI's mkdocs-material is not installed (./patina docs installs it where it may)")
    return checkout.module("docs/site", "build").main(os.path.abspath(arguments.folder), arguments.strict)
