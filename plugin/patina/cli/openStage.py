# SPDX-License-Identifier: Apache-2.0
"""Opens a stage as the flags say, or gives a one-line reason."""
import os

from patina import inputs
from patina.cli import interrupts, tryStage
from patina.cli.errors import CommandError

_LAYERS = (".usd", ".usda", ".usdc", ".usdz")


def open_stage(path, mask=None, session_layer=None, layers=()):
    """:param mask: prim paths separated by commas or spaces, or None
    :param layers: files whose opinions are stronger than the stage's and the session layer's; later ones are stronger
    :returns: the Usd.Stage, whose session layer may be edited"""
    from pxr import Sdf, Tf, Usd

    from patina.stage import StageError, compat, errors

    interrupts.Endings.check()  # importing pxr prints exceptions and goes on
    if not os.path.exists(path):
        raise CommandError(f"there is no file {path}")
    try:
        path.encode()
    except UnicodeEncodeError:
        raise CommandError(f"{path.encode(errors='replace').decode()}: USD opens no file whose name is not UTF-8") from None
    inputs.check_regular(path)
    problem = tryStage.why_trial_fails(path)
    if problem:
        raise StageError(f"{path} {problem}: the file is damaged")
    with compat.QuietDiagnostics() as quiet:
        try:
            stage = _open(path, mask, session_layer, layers, Sdf, Usd)
            problem = "it is no USD file"
        except Tf.ErrorException as error:
            stage, problem = None, errors.one_line(error)
    interrupts.Endings.check()
    if not stage:
        raise StageError(f"{path} cannot be opened: {quiet.texts[0] if quiet.texts else problem}")
    for layer in stage.GetUsedLayers():
        if not layer.anonymous:
            inputs.note(layer.realPath)
    return stage


def _open(path, mask, session_layer, layers, Sdf, Usd):
    root = Sdf.Layer.FindOrOpen(path)
    if not root:
        return None
    _check_waiting(root, Sdf)
    session = Sdf.Layer.CreateAnonymous("session.usda")
    # A layer of its own above the given ones: overrides never reach their files.
    for layer in reversed(layers or ()):
        session.subLayerPaths.append(_above(layer, "--layer", Sdf))
    if session_layer:
        session.subLayerPaths.append(_above(session_layer, "the session layer", Sdf))
    if not mask:
        return Usd.Stage.Open(root, session)
    population = Usd.StagePopulationMask()
    for prim in mask.replace(",", " ").split():
        if not Sdf.Path.IsValidPathString(prim) or not prim.startswith("/"):
            raise CommandError(f"--mask: {prim} is no prim path")
        population.Add(prim)
    return Usd.Stage.OpenMasked(root, session, population)


def _above(layer, what, Sdf):
    """:returns: the absolute path of a layer that is put above the stage
    :raises CommandError: where it cannot be opened"""
    if not os.path.exists(layer):
        raise CommandError(f"{what} {layer}: there is no such file")
    inputs.check_regular(layer)
    problem = tryStage.why_trial_fails(layer)
    if problem:
        raise CommandError(f"{what} {layer} {problem}: the file is damaged")
    found = Sdf.Layer.FindOrOpen(layer)
    if not found:
        raise CommandError(f"{what} {layer} cannot be opened")
    _check_waiting(found, Sdf)
    return os.path.abspath(layer)


def _check_waiting(root, Sdf):
    """:raises InputError: where a layer, or one below it in its stack, names a pipe or a device as a layer: USD would wait for
    it"""
    waiting, seen = [root], {root.identifier}
    for layer in waiting:  # grows as it goes
        below = set(layer.subLayerPaths)
        for name in layer.GetCompositionAssetDependencies():
            path = layer.ComputeAbsolutePath(name).partition(":SDF_FORMAT_ARGS:")[0]
            if os.path.splitext(path)[1].lower() not in _LAYERS or path in seen or not os.path.exists(path):
                continue
            seen.add(path)
            if not os.path.isdir(path):  # USD says so itself
                inputs.check_regular(path)
            if name in below:
                more = Sdf.Layer.FindOrOpen(path)
                waiting += [more] if more else []
