# SPDX-License-Identifier: Apache-2.0
"""MATERIAL arguments: FILE[:/prim/path] of a stage, FILE.mtlx[:name], or library:NAME."""
import os

from patina import inputs, limits
from patina.cli import methods, openStage, overrides
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError
from patina.cli.usd import reader
from patina.library import catalog

MATERIAL_HELP = ("FILE[:/prim/path] of a stage, FILE.mtlx[:name], or library:NAME of Patina's own (patina view --library shows "
                 "them); without a path or name: the only material of the file")
EVERY_HELP = MATERIAL_HELP.replace("the only material", "every material")


def add_flags(parser):
    """Those that change what a material is, and how it is computed."""
    parser.add_argument("--set", action="append", default=[], metavar="PRIM.INPUT=VALUE",
                        help="change an input before (repeatable)")
    limits.add_flag(parser)
    methods.add_flag(parser)


def split(text):
    """:returns: the file, and the path or name behind it and a colon ('' when there is none); a name may hold colons itself,
    of namespaces"""
    if os.path.exists(text):
        return text, ""
    if text.startswith(catalog.PREFIX):
        return catalog.path_of(text[len(catalog.PREFIX):]), ""
    for at in (i for i in range(len(text) - 1, 0, -1) if text[i] == ":"):
        if os.path.isfile(text[:at]):
            return text[:at], text[at + 1:]
    file, colon, name = text.rpartition(":")
    if not colon:
        return text, ""
    return file, name


def is_document(file):
    return file.lower().endswith(".mtlx")


def load(text, set_texts=(), every=False):
    """Reads the networks that an argument means, with --set done.

    :param every: all materials of the file where none is named; otherwise there must be one
    :returns: list of (name, network), and the list of warnings that reading gave
    """
    file, name = split(text)
    if not os.path.exists(file):
        raise CommandError(f"there is no file {file}")
    inputs.check_regular(file)
    warnings = list(_patina.model_warnings())
    found = _of_document(file, warnings) if is_document(file) else _of_stage(file, set_texts, warnings)
    if name:
        chosen = [pair for pair in found if pair[0] == name or pair[0].rpartition("/")[2] == name]
        if not chosen:
            raise CommandError(f"{file} has no material {name}" + _list(found))
        found = chosen[:1]
    if not found:
        reason = warnings[0]["message"] if warnings else "it holds no materials"
        raise CommandError(f"{file}: {reason}")
    if len(found) > 1 and not every:
        raise CommandError(f"{file} holds {len(found)} materials, name one" + _list(found))
    if is_document(file) and set_texts:
        found = [(label, _override(network, set_texts)) for label, network in found]
    for _, network in found:
        inputs.note_network(network)
    return found, warnings


def _list(found):
    names = [label for label, _ in found]
    return f" (there are: {', '.join(names[:12])}{', ...' if len(names) > 12 else ''})" if names else ""


def _of_document(file, warnings):
    inputs.note_document(file)
    networks = _patina.read_mtlx(file, warnings)
    return [(network.path[len(file) + 1:], network) for network in networks]


def _of_stage(file, set_texts, warnings):
    stage = openStage.open_stage(file)
    overrides.apply(stage, set_texts)
    return reader.read_materials(stage, warnings)


def _override(network, set_texts):
    inputs = {}
    for text in set_texts:
        target, equals, value = text.partition("=")
        if not equals:
            raise CommandError(f"--set {text}: write it as NODE.INPUT=VALUE")
        inputs[target] = value
    try:
        return _patina.override_material(network, inputs)
    except ValueError as error:
        raise CommandError(f"--set: {error}") from error
