# SPDX-License-Identifier: Apache-2.0
"""The OpenUSD that the plugin was built for: where it is, and how to run programs of it."""
import contextlib
import functools
import glob
import json
import os
import select
import shutil
import signal
import subprocess
import tempfile

import pytest

TIMEOUT = 900  # seconds for one program: a hang fails rather than blocks


def _read():
    path = os.path.join(os.environ.get("PATINA_BUILD_DIR", ""), "hydra.json")
    if not os.environ.get("PATINA_BUILD_DIR") or not os.path.isfile(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def missing():
    """:returns: one line that says why there is no Hydra to test with, else None"""
    build = _read()
    if build is None:
        return "OpenUSD with Hydra not found: the plugin is not built"
    if not os.path.exists(build["host"]) or not os.path.exists(os.path.join(build["plugin"], "hdPatina.so")):
        return "the Hydra plugin and its test host are not built"
    return None


def missing_engine():
    """:returns: one line that says why there is no host with OpenGL, else None"""
    host = _read().get("engineHost")
    return None if host and os.path.exists(host) else "the host with OpenGL is not built: this OpenUSD has no UsdImagingGL"


def folder(name):
    """:param name: root, plugin, host, engineHost or python, as the build wrote them down"""
    return _read()[name]


def skip_before(version, why):
    """Skips a test in an OpenUSD that is older.

    :param version: as PXR_VERSION
    :param why: what the older ones lack"""
    if int(folder("version")) < version:
        pytest.skip(f"before OpenUSD {version // 100}.{version % 100:02d} {why}")


def unreadable(stage):
    """:param stage: an opened Usd.Stage
    :returns: one line that names a layer whose file format this OpenUSD has no plugin for, as it has none for
        MaterialX documents when it was built without MaterialX; else None"""
    for layer in stage.GetUsedLayers():
        for asset in layer.GetCompositionAssetDependencies():
            if asset and not reads(os.path.splitext(asset)[1][1:].lower()):
                return f"this OpenUSD does not read {asset}, which {os.path.basename(layer.realPath)} composes"
    return None


def reads(extension):
    """:returns: whether a plugin of this OpenUSD says that it reads files with this extension"""
    return extension in _formats()


@functools.cache
def _formats():
    found = set()
    for base in ("lib", "plugin"):
        for path in glob.glob(os.path.join(folder("root"), base, "usd", "*", "resources", "plugInfo.json")):
            with open(path, encoding="utf-8") as file:
                text = "".join(line for line in file if not line.lstrip().startswith("#"))
            for plugin in json.loads(text)["Plugins"]:
                for described in plugin.get("Info", {}).get("Types", {}).values():
                    found.update(described.get("extensions", []))
    return found


def environment(scene_index=False, **more):
    """For programs that load the plugin. Nothing of this Python's own pxr may reach them."""
    build = _read()
    values = {name: value for name, value in os.environ.items()
              if name not in ("PYTHONPATH", "PYTHONSAFEPATH", "VIRTUAL_ENV", "PYTHONHOME")}
    values["PXR_PLUGINPATH_NAME"] = build["plugin"]
    values["PYTHONPATH"] = os.path.join(build["root"], "lib", "python")
    libraries = [os.path.join(build["root"], "lib")] + list(filter(None, [os.environ.get("LD_LIBRARY_PATH")]))
    values["LD_LIBRARY_PATH"] = os.pathsep.join(libraries)
    definitions = os.path.join(build["root"], "lib", "materialx", "libraries")
    if os.path.isdir(definitions):  # a program tells its OpenUSD where they are
        values["PXR_MTLX_STDLIB_SEARCH_PATHS"] = definitions
    values["USDIMAGINGGL_ENGINE_ENABLE_SCENE_INDEX"] = "1" if scene_index else "0"
    values["USDIMAGINGGL_ENGINE_ENABLE_SCENE_INDEX_DEPRECATION_WARNING"] = "0"  # since 26.03, of the delegate's way
    values.update(more)
    return values


def run_host(stage, *arguments, scene_index=False, check=True, **more):
    """Runs hydraHost, in a process that stays for the next image unless times and memory are asked for.

    :param more: environment variables, for a process of its own
    :returns: the finished process"""
    words = [str(stage), *map(str, arguments)] + (["--sceneIndex"] if scene_index else [])
    command = [folder("host"), *words]
    if more or "--json" in words:
        return _run(command, environment(scene_index, **more), check)
    return _checked(_served(scene_index, folder("host"), "--serve").run(words), command, check)


class _Server:
    """A program that runs one command after the other, each asked for in a line: see host/main.cpp, usdrecordServer.py."""

    def __init__(self, command, values):
        self.process = subprocess.Popen(command, env=values, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def run(self, words, timeout=TIMEOUT):
        """:returns: a finished process; where the program ended instead, its status
        :raises subprocess.TimeoutExpired: after so many seconds, and ends the program"""
        with tempfile.TemporaryDirectory() as own:
            streams = [os.path.join(own, name) for name in ("out", "err")]
            for path in streams:
                open(path, "w", encoding="utf-8").close()
            with contextlib.suppress(BrokenPipeError):
                self.process.stdin.write("\t".join([*streams, *words]) + "\n")
                self.process.stdin.flush()
            if not select.select([self.process.stdout], [], [], timeout)[0]:
                self.process.kill()
            answer = self.process.stdout.readline()
            said = []
            for path in streams:
                with open(path, encoding="utf-8", errors="replace") as file:
                    said.append(file.read())
        if not answer:
            _served.cache_clear()
            status = self.process.wait()
            if status == -signal.SIGKILL:
                raise subprocess.TimeoutExpired(words, timeout, *said)
        return subprocess.CompletedProcess(words, int(answer) if answer else status, *said)


@functools.lru_cache
def _served(scene_index, *command):
    """:returns: one for all tests of this process; it ends with its standard input"""
    return _Server(command, environment(scene_index))


def run_engine(stage, *arguments, before=(), timeout=TIMEOUT, **more):
    """Runs engineHost: any renderer, with OpenGL. :param before: words before its command
    :param more: environment variables
    :returns: the finished process, failed or not
    :raises subprocess.TimeoutExpired: after so many seconds"""
    return _run([*before, folder("engineHost"), str(stage), *map(str, arguments)], environment(**more), False, timeout)


def run_usdrecord(stage, image, *arguments, scene_index=False, check=True, gl=False, timeout=TIMEOUT,
                  renderer="Patina", **more):
    """Runs usdrecord with our renderer. :param gl: with a GL context, on a screen that no one sees
    :returns: the finished process"""
    build = _read()
    script = os.path.join(build["root"], "bin", "usdrecord")
    words = ["--renderer", renderer, *map(str, arguments), str(stage), str(image)]
    if not gl:
        words.insert(0, "--disableGpu")
    command = [*(xvfb() if gl else []), build["python"], script, *words]
    server = build["python"], os.path.join(os.path.dirname(os.path.abspath(__file__)), "usdrecordServer.py"), script
    for _ in range(3):
        process = (_run(command, environment(scene_index, **more), False, timeout) if gl or more
                   else _served(scene_index, *server).run(words, timeout))
        # OpenUSD clears its caches in the background. When the interpreter ends meanwhile, the thread that wants
        # its lock is ended in a place where C++ allows no such thing. The image is long written then.
        if process.returncode != -6 or "terminate called without an active exception" not in process.stderr:
            break
    return _checked(process, command, check)


def xvfb():
    """:returns: the words that go before a command to give it a screen, None without Xvfb"""
    return ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24"] if shutil.which("xvfb-run") else None


def has_usdrecord():
    build = _read()
    return os.path.exists(os.path.join(build["root"], "bin", "usdrecord")) and os.path.exists(build["python"])


def has_qt():
    """:returns: whether the Python of this OpenUSD can open windows"""
    return _imports("PySide6.QtWidgets")


def has_usdview():
    """:returns: whether this OpenUSD has usdview, and a Python that can open its window"""
    return has_qt() and _imports("pxr.Usdviewq, OpenGL")


def _imports(module):
    build = _read()
    if not os.path.exists(build["python"]):  # it was built without Python
        return False
    return subprocess.run([build["python"], "-c", f"import {module}"], env=environment(),
                          capture_output=True, check=False).returncode == 0


def _run(command, values, check, timeout=TIMEOUT):
    process = subprocess.run(command, env=values, capture_output=True, text=True, errors="replace", timeout=timeout,
                             check=False)
    return _checked(process, command, check)


def _checked(process, command, check):
    if check and process.returncode != 0:
        reason = f"killed by signal {-process.returncode}\n" if process.returncode < 0 else ""
        raise AssertionError(f"{' '.join(command)}\n{reason}{process.stdout[-2000:]}\n{process.stderr[-4000:]}")
    return process


OF_OPENUSD = (
    "Color correction presently unsupported",  # usdrecord without a GPU, of every renderer
    "Found invalid info:implementationSource value ''",  # 24.08, scene indices, of every light: it goes on with the default
    "doesn't support prim type 'PortalLight'", "doesn't support prim type 'LightAPI'",  # 25.08, UsdImagingDelegate, of portals
    "Invalid info:id Pxr",  # light filters of RenderMan, where their shaders are not installed
)


def warnings_of(process):
    """:returns: lines of a finished process that OpenUSD or the renderer warned with, without those of OF_OPENUSD"""
    return [line for line in process.stderr.splitlines() if line.startswith(("Warning:", "Error", "Coding Error"))
            and not any(text in line for text in OF_OPENUSD)]
