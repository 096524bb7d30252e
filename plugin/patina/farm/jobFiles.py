# SPDX-License-Identifier: Apache-2.0
"""The files that a job reads, as far as the stage and the command name them: workers have to reach them, too."""
import os
import re

from patina import inputs
from patina.cli.usd import Tf, UsdUtils, reader
from patina.farm import identity

_TILE = re.compile(r"<(UDIM|UVTILE)>", re.IGNORECASE)


def of(module, record):
    """:param module: _patina
    :param record: parsed arguments of `patina record`
    :returns: (absolute paths of what is there, names of what is not)"""
    found, missing = set(), set()
    roots = [record.stage, *([record.sessionLayer] if record.sessionLayer else []), *(record.layer or [])]
    with reader.compat.QuietDiagnostics():  # each file that is not there is told here, in other words
        for root in roots:
            _add(root, found, missing)
    for document in [file for file in found if file.endswith(".mtlx")]:
        _note_textures(module, document)
    for file in [*inputs.files(), *(file for files in identity.environment_files().values() for file in files)]:
        (found if os.path.isfile(file) else missing).add(file)
    return sorted(found), sorted(missing)


def _add(root, found, missing):
    """Adds a layer with all that it reaches."""
    try:
        layers, assets, unresolved = UsdUtils.ComputeAllDependencies(root)
    except Tf.ErrorException:  # a layer below is broken: the render tells, and what the stage did open is noted
        layers, assets, unresolved = [], [], []
    files = [root] + [layer.realPath for layer in layers if layer.realPath] + [str(asset) for asset in assets]
    # Files in a package belong to the package.
    found.update(os.path.abspath(inputs.file_of(file)) for file in files)
    missing.update(str(name) for name in unresolved if not _TILE.search(str(name)))


def _note_textures(module, document):
    """A MaterialX document names files itself, and pxr may be without the plugin that would look into it."""
    inputs.note_document(document)
    try:
        networks = module.read_mtlx(document, [])
    except (RuntimeError, OSError):
        return  # the render says why
    for network in networks:
        inputs.note_network(network)
