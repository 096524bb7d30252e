"""Opens a stage as the flags say, or gives a one-line reason."""
import os

from patina.cli.errors import CommandError


def open_stage(path, mask=None, session_layer=None):
    """:param mask: prim paths separated by commas or spaces, or None
    :returns: the Usd.Stage, whose session layer may be edited"""
    from pxr import Sdf, Tf, Usd

    if not os.path.exists(path):
        raise CommandError(f"there is no file {path}")
    if os.path.isdir(path):
        raise CommandError(f"{path} is a folder")
    try:
        root = Sdf.Layer.FindOrOpen(path)
        if not root:
            raise CommandError(f"{path} cannot be opened: it is no USD file")
        session = Sdf.Layer.CreateAnonymous("session.usda")
        if session_layer:
            if not Sdf.Layer.FindOrOpen(session_layer):
                raise CommandError(f"the session layer {session_layer} cannot be opened")
            # A layer of its own above the given one: overrides never reach the file.
            session.subLayerPaths.append(os.path.abspath(session_layer))
        if mask:
            population = Usd.StagePopulationMask()
            for prim in mask.replace(",", " ").split():
                if not Sdf.Path.IsValidPathString(prim) or not prim.startswith("/"):
                    raise CommandError(f"--mask: {prim} is no prim path")
                population.Add(prim)
            stage = Usd.Stage.OpenMasked(root, session, population)
        else:
            stage = Usd.Stage.Open(root, session)
    except Tf.ErrorException as error:
        raise CommandError(f"{path} cannot be opened: {reason(error)}") from error
    if not stage:
        raise CommandError(f"{path} cannot be opened")
    return stage


def reason(error):
    """:returns: the text of pxr's errors, without where in its code they were met"""
    texts = []
    for item in error.args:
        texts.append(str(getattr(item, "commentary", item)))
    return " ".join(" ".join(texts).split()) or type(error).__name__
