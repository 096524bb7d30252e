# SPDX-License-Identifier: Apache-2.0
"""Packs the Hydra plugin as an extension for one Blender: a zip that its preferences install."""
import json
import os
import re
import zipfile

import patina
from patina.cli import hostSettings, rows
from patina.cli.errors import CommandError

_FILES = os.path.join(rows.ROOT, "plugin", "blender")
_DATES = (1980, 1, 1, 0, 0, 0)  # the same files make the same zip


def blender_version(folder):
    """:returns: "5.0" of a folder of Blender's, or of the module `bpy`
    :raises CommandError: where it is none"""
    names = [name for name in os.listdir(folder) if re.fullmatch(r"\d+\.\d+", name)]
    if len(names) != 1:
        raise CommandError(f"{folder} is no Blender: it has no folder of its version")
    return names[0]


def pack(host, plugin, version, file):
    """:param host: Blender's folder
    :param plugin: the folder for PXR_PLUGINPATH_NAME
    :param version: of its OpenUSD: minor and patch
    :param file: the zip
    :raises CommandError: where it cannot be written"""
    with open(os.path.join(_FILES, "blender_manifest.toml.in"), encoding="utf-8") as opened:
        manifest = opened.read().format(version=patina.__version__, blender=blender_version(host))
    texts = {"blender_manifest.toml": manifest, "settings.json": json.dumps(hostSettings.shown(), indent=1),
             "host.json": json.dumps({"version": version})}
    files = {"__init__.py": os.path.join(_FILES, "__init__.py")}
    for folder, _, names in os.walk(plugin):
        files.update({os.path.join("usdPlugin", os.path.relpath(os.path.join(folder, name), plugin)): os.path.join(folder, name)
                      for name in names})
    try:
        with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, text in sorted(texts.items()):
                archive.writestr(zipfile.ZipInfo(name, _DATES), text, zipfile.ZIP_DEFLATED)
            for name, path in sorted(files.items()):
                with open(path, "rb") as opened:
                    archive.writestr(zipfile.ZipInfo(name, _DATES), opened.read(), zipfile.ZIP_DEFLATED)
    except OSError as error:
        raise CommandError(f"cannot write {file}: {error.strerror or error}") from None
