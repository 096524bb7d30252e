# SPDX-License-Identifier: Apache-2.0
"""Reads USD stages with pxr (usd-core 23.11 and later) into the renderer's own scene.

open_stage(path) opens a file or raises StageError. read_stage(stage, edit, options) translates one
frame into an edit of a `_patina.Scene` and tells in a StageInfo what it found; what is wrong with
the stage becomes warnings of the scene. read_materials(stage) gives the networks alone.
"""
from .errors import StageError
from .options import StageInfo, StageOptions
from .openStage import open_stage
from .readMaterials import read_materials
from .readStage import read_stage

__all__ = ["StageError", "StageInfo", "StageOptions", "open_stage", "read_materials", "read_stage"]
