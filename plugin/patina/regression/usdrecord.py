# SPDX-License-Identifier: Apache-2.0
"""Renders by another Hydra delegate, through the usdrecord of any OpenUSD."""
import os
import re
import shlex
import subprocess
import tempfile

from patina.cli.usd import UsdLux, reader
from patina.regression.golden import RenderError, checked_color

# Flags of `patina record` that usdrecord has too; all take a value.
_SHARED = {"--imageWidth": "--imageWidth", "-w": "--imageWidth", "--camera": "--camera", "-cam": "--camera",
           "--complexity": "--complexity", "-c": "--complexity", "--purposes": "--purposes",
           "--settings": "--renderSettingsPrimPath", "--renderSettingsPrimPath": "--renderSettingsPrimPath",
           "-rs": "--renderSettingsPrimPath", "--mask": "--mask", "--sessionLayer": "--sessionLayer"}


def _seen(file):
    """Where usdrecord has other habits than `patina record`: it frames a stage whose cameras have unusual names, and lights it
    from the camera beside its own lights.

    :returns: path of the camera that `patina record` takes, or None; whether the stage has lights
    :raises RenderError: where the stage cannot be opened"""
    try:
        stage = reader.open_stage(file)
    except reader.StageError as error:
        raise RenderError(str(error)) from None
    found = reader.cameras.chosen_before(reader.context.Context(stage, None, reader.StageOptions()))
    return found and found.path, any(prim.HasAPI(UsdLux.LightAPI) for prim in stage.Traverse())


class UsdRecord:
    """One delegate."""

    def __init__(self, renderer, command):
        """:param renderer: name that usdrecord shows, or that of the plugin: Storm, HdStormRendererPlugin
        :param command: usdrecord with its arguments, as in a shell
        :raises RenderError: where it does not run, or has no such renderer"""
        self._command = shlex.split(command)
        said = self._run(["--help"], 60)
        self._has_headlight_flag = "--disableCameraLight" in said
        choices = re.search(r"--renderer \{([^}]*)\}", said)
        names = [name.strip() for name in choices[1].split(",")] if choices else []
        plain = re.sub(r"^Hd|RendererPlugin$", "", renderer).lower()
        found = [name for name in names if name == renderer] or [name for name in names if name.lower() == plain]
        if not found:
            raise RenderError(f"{command} has no renderer {renderer} (there are: {', '.join(names) or 'none'})")
        self._renderer = found[0]

    def _run(self, words, seconds):
        """:returns: what it printed"""
        try:
            done = subprocess.run([*self._command, *words], capture_output=True, text=True, timeout=seconds, check=False)
        except subprocess.TimeoutExpired:
            raise RenderError(f"{self._command[0]} took more than {seconds} s") from None
        except OSError as error:
            raise RenderError(f"{self._command[0]} cannot be run: {error.strerror}; --usdrecord names another") from None
        if done.returncode != 0:
            raise RenderError("\n".join((done.stderr or done.stdout).strip().splitlines()[-12:])
                              or f"{self._command[0]} ended with {done.returncode}")
        return done.stdout

    def __call__(self, stage, seed, arguments):
        """As golden.render(); delegates are not told the seed."""
        words, left = [], list(arguments)
        while left:
            name, equals, value = left.pop(0).partition("=")
            if name in _SHARED and (equals or left):
                words += [_SHARED[name], value if equals else left.pop(0)]
        camera, lit = _seen(stage)
        if camera and not {"--camera", "--renderSettingsPrimPath"} & set(words):
            words += ["--camera", camera]
        if lit and self._has_headlight_flag:
            words.append("--disableCameraLight")
        with tempfile.TemporaryDirectory(prefix="patina-") as folder:
            image = os.path.join(folder, "image.exr")
            said = self._run(["--renderer", self._renderer, "--colorCorrectionMode", "disabled", *words, stage, image], 3600)
            if not os.path.exists(image):
                raise RenderError(said.strip() or f"{self._command[0]} wrote no image")
            return checked_color(image)
