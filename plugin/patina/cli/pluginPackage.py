# SPDX-License-Identifier: Apache-2.0
"""A Hydra plugin with all that it needs beside its host, for machines without the packages that it was built with."""
import contextlib
import os
import shutil
import tarfile
import tempfile

from patina.cli import bundledLibraries
from patina.cli.errors import CommandError

_PROGRAMS = ("patinaTryImage", "patinaReadField")  # the plugin starts them; they lie beside it


@contextlib.contextmanager
def whole(built):
    """:param built: a hydraHosts.Built
    :returns: the context of a folder for PXR_PLUGINPATH_NAME, which is removed afterwards
    :raises CommandError: where a library or a tool is missing"""
    with tempfile.TemporaryDirectory() as place:
        folder = os.path.join(place, f"hdPatina-{built.version[0]}.{built.version[1]:02d}")
        shutil.copytree(built.plugin, folder)
        files = [os.path.join(folder, "hdPatina.so")]
        for name in _PROGRAMS:
            program = os.path.join(built.programs, name)
            if os.path.exists(program):
                files.append(shutil.copy(program, folder))
        bundledLibraries.bundle(files, folder, [built.libraries])
        yield folder


def pack(built, file):
    """:param file: the .tar.gz, which unpacks to one folder
    :raises CommandError: where it cannot be written"""
    with whole(built) as folder:
        try:
            with tarfile.open(file, "w:gz") as archive:
                archive.add(folder, os.path.basename(folder))
        except OSError as error:
            raise CommandError(f"cannot write {file}: {error.strerror or error}") from None
