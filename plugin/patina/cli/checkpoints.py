# SPDX-License-Identifier: Apache-2.0
"""Checkpoints of a render: IMAGE.checkpoint, and the token that says whether one fits."""
import contextlib
import hashlib
import json
import os

from patina.cli import settingFlags
from patina.farm import identity


def path_of(image):
    return image + ".checkpoint"


def token(stage, settings, others, backend):
    """BACKEND:HASH of everything that the samples depend on: version and build, the stage's layers, the settings, and
    others.

    A render that falls back to another back end replaces the part before the colon.

    Textures are not looked at: one that was painted over between the halves of a render is not
    noticed.
    """
    layers = []
    for layer in stage.GetUsedLayers():
        if layer.anonymous:
            layers.append(layer.ExportToString())
            continue
        try:
            status = os.stat(layer.realPath)
            layers.append([layer.identifier, status.st_size, status.st_mtime_ns])
        except OSError:
            layers.append([layer.identifier])
    free = settingFlags.of_resumed_renders()
    kept = {name: value for name, value in settings.items() if name not in free}
    made = identity.of_process()
    text = json.dumps([made["version"], made["build"], sorted(layers, key=str), kept, others], sort_keys=True, default=str)
    return backend + ":" + hashlib.sha256(text.encode()).hexdigest()


def resume(film, path, expected):
    """Loads a checkpoint if there is one that fits.

    :returns: None, or id and field of a message why the render starts anew
    """
    if not os.path.exists(path):
        return None
    try:
        film.load_checkpoint(path)
    except RuntimeError as error:
        return "checkpointUnreadable", error
    if film.resume_token != expected:
        return "checkpointOfAnother", path
    return None


def remove(path):
    with contextlib.suppress(FileNotFoundError):
        os.remove(path)
