# SPDX-License-Identifier: Apache-2.0
"""Opens a stage, or says in one line why not."""
import os

from pxr import Sdf, Tf, Usd

from . import compat
from .errors import StageError, one_line


def open_stage(path):
    """:returns: the Usd.Stage with everything loaded
    :raises StageError: when there is no such file or it is no USD file"""
    if not os.path.exists(path):
        raise StageError(f"there is no file {path}")
    if os.path.isdir(path):
        raise StageError(f"{path} is a folder")
    with compat.QuietDiagnostics() as quiet:
        try:
            layer = Sdf.Layer.FindOrOpen(path)
            stage = Usd.Stage.Open(layer) if layer else None
            problem = "it is no USD file"
        except Tf.ErrorException as error:
            stage, problem = None, one_line(error)
    if not stage:
        raise StageError(f"{path} cannot be opened: {quiet.texts[0] if quiet.texts else problem}")
    return stage
