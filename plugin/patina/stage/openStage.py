# SPDX-License-Identifier: Apache-2.0
"""Opens a stage, or says in one line why not."""
import os

from pxr import Sdf, Usd

from . import compat
from .errors import StageError


def open_stage(path):
    """:returns: the Usd.Stage with everything loaded
    :raises StageError: when there is no such file or it is no USD file"""
    if not os.path.exists(path):
        raise StageError(f"there is no file {path}")
    if os.path.isdir(path):
        raise StageError(f"{path} is a folder")
    stage, problem = compat.attempt(_open, path)
    if not stage:
        raise StageError(f"{path} cannot be opened: {problem or 'it is no USD file'}")
    return stage


def _open(path):
    layer = Sdf.Layer.FindOrOpen(path)
    return Usd.Stage.Open(layer) if layer else None
