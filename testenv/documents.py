# SPDX-License-Identifier: Apache-2.0
"""The project's documents, for tests that hold them to the code."""
import glob
import os

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))


def paths():
    """:returns: every Markdown file of the root and of docs/, below the root"""
    found = glob.glob(os.path.join(ROOT, "*.md")) + glob.glob(os.path.join(ROOT, "docs", "**", "*.md"), recursive=True)
    return sorted(os.path.relpath(path, ROOT).replace(os.sep, "/") for path in found)


def read(path):
    """:param path: below the root of the checkout"""
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def text():
    """:returns: all of them, one after the other"""
    return "\n".join(read(path) for path in paths())
