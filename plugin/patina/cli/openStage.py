# SPDX-License-Identifier: Apache-2.0
"""Opens a stage as the flags say, or gives a one-line reason."""
import itertools
import os
import re

from patina import inputs
from patina.cli import interrupts, overrides, tryStage
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError
from patina.cli.usd import Ar, Sdf, Tf, Usd, reader

_LAYERS = (".usd", ".usda", ".usdc", ".usdz")
_MOST_LAYERS = 1000000  # that are looked at; one counts again for each set of variables that it has from others


def open_stage(path, mask=None, session_layer=None, layers=()):
    """:param mask: prim paths separated by commas or spaces, or None
    :param layers: files whose opinions are stronger than the stage's and the session layer's; later ones are stronger
    :returns: the Usd.Stage, whose session layer may be edited"""
    attempt = reader.compat.attempt  # importing pxr prints exceptions and goes on
    interrupts.Endings.check()
    if not os.path.exists(path):
        raise CommandError(f"there is no file {path}")
    try:
        path.encode()
    except UnicodeEncodeError:
        raise CommandError(f"{path.encode(errors='replace').decode()}: USD opens no file whose name is not UTF-8") from None
    inputs.check_regular(path)
    problem = tryStage.why_trial_fails(path)
    if problem:
        raise reader.StageError(f"{path} {problem}")
    # Names that no layer has beside it are looked for beside the stage, as when USD opens it.
    with Ar.ResolverContextBinder(Ar.GetResolver().CreateDefaultContextForAsset(os.path.abspath(path))):
        stage, problem = attempt(_open, path, mask, session_layer, layers)
    interrupts.Endings.check()
    if not stage:
        raise reader.StageError(f"{path} cannot be opened: {problem or 'it is no USD file'}")
    for layer in stage.GetUsedLayers():
        if not layer.anonymous:
            inputs.note(layer.realPath)
    return stage


def scene_of(path, set_texts, **options):
    """:param set_texts: of --set
    :param options: of the reader
    :returns: (Usd.Stage, `_patina.Scene`, what the reader told of it)"""
    stage, scene = open_stage(path), _patina.Scene()
    overrides.apply(stage, set_texts)
    with scene.edit() as edit:
        return stage, scene, reader.read_stage(stage, edit, reader.StageOptions(**options))


def _open(path, mask, session_layer, layers):
    root = Sdf.Layer.FindOrOpen(path)
    if not root:
        return None
    variables = _variables(root)
    held = [_check_waiting(root, {})]  # USD finds them open
    session = Sdf.Layer.CreateAnonymous("session.usda")
    # A layer of its own above the given ones: overrides never reach their files.
    for layer in reversed(layers or ()):
        session.subLayerPaths.append(_above(layer, "--layer", variables, held))
    if session_layer:
        session.subLayerPaths.append(_above(session_layer, "the session layer", variables, held))
    if not mask:
        return Usd.Stage.Open(root, session)
    population = Usd.StagePopulationMask()
    for prim in mask.replace(",", " ").split():
        if not Sdf.Path.IsValidPathString(prim) or not prim.startswith("/"):
            raise CommandError(f"--mask: {prim} is no prim path")
        population.Add(prim)
    return Usd.Stage.OpenMasked(root, session, population)


def _above(layer, what, variables, held):
    """:param variables: of the stage, which hold in the layer
    :param held: list that gets the layers that were opened
    :returns: the absolute path of a layer that is put above the stage
    :raises CommandError: where it cannot be opened"""
    if not os.path.exists(layer):
        raise CommandError(f"{what} {layer}: there is no such file")
    inputs.check_regular(layer)
    problem = tryStage.why_trial_fails(layer)
    if problem:
        raise CommandError(f"{what} {layer} {problem}")
    found = Sdf.Layer.FindOrOpen(layer)
    if not found:
        raise CommandError(f"{what} {layer} cannot be opened")
    held.append(_check_waiting(found, variables))
    return os.path.abspath(layer)


def _check_waiting(root, variables):
    """:param variables: of expressions, stronger than the layer's own
    :returns: the layers that were opened
    :raises InputError: where a layer, or one that it leads to, names a pipe or a device: USD would wait for it"""
    waiting, seen, named = [(root, {**_variables(root), **variables})], set(), {}
    for layer, known in itertools.islice(waiting, _MOST_LAYERS):  # grows as it goes
        if layer not in named:
            named[layer] = (_names(layer), set(layer.subLayerPaths))
            for path in _clips(layer):
                _check(path)
        names, below = named[layer]
        for authored in names:
            name = _evaluated(authored, known)
            path = _check(layer.ComputeAbsolutePath(name)) if name else None
            more = _opened(path) if path else None
            if more:
                # Of a stack of layers only the first one's variables count, and those of what names the stack stand above.
                inherited = known if authored in below else {**_variables(more), **known}
                key = (path, str(sorted(inherited.items())))
                if key not in seen:
                    seen.add(key)
                    waiting.append((more, inherited))
    return [layer for layer, _ in waiting]


def _check(path):
    """:param path: that a layer names, absolute where it is found beside the layer
    :returns: where USD finds the layer that it means; None where it finds none
    :raises InputError: where that is there and no regular file"""
    path = path.partition(":SDF_FORMAT_ARGS:")[0]
    outer = inputs.file_of(path)
    file = str(Ar.GetResolver().Resolve(outer)) if outer else ""
    if os.path.splitext(outer)[1].lower() not in _LAYERS or not os.path.exists(file) or os.path.isdir(file):
        return None  # USD says so itself
    inputs.check_regular(file)
    return file + path[len(outer):]


def _opened(path):
    try:
        return Sdf.Layer.FindOrOpen(path)
    except Tf.ErrorException:
        return None  # USD says so itself, and goes on without it


def _names(layer):
    """:returns: list of what a layer names as layers, as it is authored"""
    external = getattr(layer, "GetExternalAssetDependencies", list)  # of formats that have files besides
    return [*layer.GetCompositionAssetDependencies(), *map(str, external())]


def _variables(layer):
    return dict(getattr(layer, "expressionVariables", {}))


def _evaluated(name, variables):
    """:returns: what an expression in backticks comes to; empty where that is no text, and other names as they are"""
    if not name.startswith("`") or not hasattr(Sdf, "VariableExpression"):
        return name
    value = Sdf.VariableExpression(name).Evaluate(variables).value
    return value if isinstance(value, str) else ""


def _clips(layer):
    """Yields the files of value clips that a layer names: USD opens the first one with the stage."""
    paths = []
    layer.Traverse("/", paths.append)
    for prim in (path for path in paths if path.IsPrimPath() or path.IsPrimVariantSelectionPath()):
        spec = layer.GetObjectAtPath(prim)
        clips = spec.GetInfo("clips") if spec and spec.HasInfo("clips") else {}
        for fields in clips.values():
            if isinstance(fields, dict):
                yield from _clip_files(layer, fields)


def _clip_files(layer, fields):
    assets = [fields.get("manifestAssetPath")]
    assets += fields["assetPaths"] if hasattr(fields.get("assetPaths"), "__len__") else []
    yield from (layer.ComputeAbsolutePath(asset.path) for asset in assets if getattr(asset, "path", ""))
    template = fields.get("templateAssetPath")
    parts = re.split("#+", os.path.basename(template)) if isinstance(template, str) else []
    if len(parts) not in (2, 3):  # with one or two numbers, as USD takes them
        return
    folder = os.path.dirname(layer.ComputeAbsolutePath(template))
    pattern = re.compile("-?[0-9]+".join(map(re.escape, parts)))
    if os.path.isdir(folder):
        yield from (os.path.join(folder, file) for file in os.listdir(folder) if pattern.fullmatch(file))
