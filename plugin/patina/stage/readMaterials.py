# SPDX-License-Identifier: Apache-2.0
"""The materials of a stage alone."""
import _patina
from pxr import Usd, UsdShade

from . import compat, mtlxFiles
from .context import Context, Guard
from .networks import network_of
from .options import StageOptions


def read_materials(stage, warnings=None, frame=None):
    """:param warnings: list that gets dicts of prim, input, message and count
    :returns: list of (path, `_patina.Network`) of every material of the stage, bound or not"""
    scene, networks = _patina.Scene(), []
    with scene.edit() as edit:
        context = Context(stage, edit, StageOptions(frame=frame))
        with compat.QuietDiagnostics() as quiet:
            mtlxFiles.supply(context, stage, compat.composition_errors(stage))
            for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
                if prim.IsA(UsdShade.Material):
                    path = str(prim.GetPath())
                    with Guard(context, prim):
                        networks.append((path, network_of(context, UsdShade.Material(prim), path)))
        for text in quiet.texts:
            context.warn("/", "", "stageProblem", text)
    if warnings is not None:
        warnings.extend(scene.warnings())
    return networks
