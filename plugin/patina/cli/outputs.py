# SPDX-License-Identifier: Apache-2.0
"""The one way in which commands write files: whole or not at all, and over nothing that they read."""
import contextlib
import json
import os
import sys

from patina import inputs
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError

# Documents that only commands which make such ones may replace.
_DOCUMENTS = (".usd", ".usda", ".usdc", ".usdz", ".mtlx")


def check(path, makes=()):
    """Says early why a file could not be written.

    :param makes: extensions of documents that the command writes
    :raises CommandError: where the folder is missing, something other than a regular file is there, or it is a
        file that this command reads"""
    try:
        os.fspath(path).encode()
    except UnicodeEncodeError:
        shown = os.fsencode(path).decode(errors="replace")
        raise CommandError(f"cannot write '{shown}': names that are not UTF-8 are not written") from None
    try:
        _patina.check_output(os.fspath(path))
    except RuntimeError as error:
        raise CommandError(str(error)) from error
    _refuse_input(path, makes)


def _refuse_input(path, makes=()):
    found = inputs.read_by(path)
    if found:
        same = "" if os.path.abspath(path) == found else f", which is {path}"
        raise CommandError(f"cannot write '{path}': this command reads {found}{same}; name another file")
    extension = os.path.splitext(path)[1].lower()
    if extension in _DOCUMENTS and extension not in makes and os.path.exists(path):
        raise CommandError(f"cannot write '{path}': it is a stage or a MaterialX document; name another file")


def check_all(paths):
    """The same for several files of one command, which must differ.

    :param paths: None and - (standard output) are left out"""
    known = {}
    for path in paths:
        if path in (None, "", "-"):
            continue
        check(path)
        place = os.path.realpath(path)
        if place in known:
            raise CommandError(f"cannot write '{path}': {known[place]} is the same file")
        known[place] = path


def make_folder(folder):
    """Makes the folder that --out names, before anything slow; nothing for ''."""
    if not folder:
        return
    try:
        folder.encode()
        os.makedirs(folder, exist_ok=True)
    except UnicodeEncodeError:
        shown = os.fsencode(folder).decode(errors="replace")
        raise CommandError(f"cannot make the folder {shown}: names that are not UTF-8 are not written") from None
    except OSError as error:
        raise CommandError(f"cannot make the folder {folder}: {error.strerror}") from error


def need_folders(files, make):
    """Of what `patina record` writes.

    :param files: None and - (standard output) are left out
    :param make: makes those that are missing
    :raises CommandError: where one is missing, or cannot be made"""
    for file in files:
        folder = os.path.dirname(file or "")
        if not folder or os.path.isdir(folder):
            continue
        if not make:
            raise CommandError(f"cannot write '{file}': the folder '{folder}' does not exist (--makeOutputPath makes it)")
        make_folder(folder)


class Together:
    """Several files that appear together, when the block ends without an error."""

    def __init__(self):
        self._files = []
        self._paths = {}  # of a temporary -> the path that it stands for

    def __enter__(self):
        return self

    def add(self, path, in_place=False, makes=()):
        """:param in_place: it may be a file that this command reads
        :returns: the path to write to, with the same extension"""
        if not in_place:
            _refuse_input(path, makes)
        try:
            self._files.append(_patina.AtomicFile(os.fspath(path)))
        except RuntimeError as error:
            raise CommandError(str(error)) from error
        temporary = self._files[-1].temporary_path
        self._paths[temporary] = os.fspath(path)
        return temporary

    def _named(self, error):
        """:returns: what an error says, with paths in the place of their temporaries; None where it names none of these"""
        text = said = str(error)
        for temporary, path in self._paths.items():
            text = text.replace(temporary, path)
        return text if text != said else None

    def __exit__(self, kind, error, trace):
        try:
            if kind is None:
                for file in self._files:
                    file.commit()
            elif isinstance(error, (RuntimeError, CommandError)) and self._named(error):
                raise CommandError(self._named(error)) from error
        except RuntimeError as reason:
            raise CommandError(str(reason)) from reason
        finally:
            for file in self._files:
                file.discard()
        return False


@contextlib.contextmanager
def writing(path, newline=None):
    """Yields a text file that takes its place when the block ends without an error."""
    with Together() as files:
        temporary = files.add(path)
        try:
            with open(temporary, "w", encoding="utf-8", errors="backslashreplace", newline=newline) as file:
                yield file
        except OSError as error:
            raise CommandError(f"cannot write '{path}': {error.strerror or error}") from error


def write_text(path, text):
    with writing(path) as file:
        file.write(text)


def write_json(target, value):
    """The target of --json: - for standard output, else a file; nothing for None.

    :returns: whether it took standard output"""
    if not target:
        return False
    text = json.dumps(value, indent=2) + "\n"
    if target == "-":
        sys.stdout.write(text)
        return True
    write_text(target, text)
    return False
