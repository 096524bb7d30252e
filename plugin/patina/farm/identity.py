# SPDX-License-Identifier: Apache-2.0
"""The identity of a part: everything that the bits of a frame depend on. Parts with the same go together."""
import contextlib
import functools
import hashlib
import json
import os

from patina import __version__, inputs
from patina.cli.compiled import _patina
from patina.farm import digests

FORMAT = 2
_OF_PARTS = ("sampleBegin", "sampleEnd", "tilePart", "tileParts")
# Settings that the back end decides for every part alike, or that concern one machine's run alone.
_OF_RUNS = ("threads", "seconds", "checkpointFile", "checkpointSeconds", "interactive")


_REPLACED = " (deleted)"  # what Linux adds to the name of a file in whose place another came
ENVIRONMENT = ("OCIO", "PATINA_MODEL_PATH", "PXR_AR_DEFAULT_SEARCH_PATH")  # variables that images depend on
MACHINE = ("version", "build", "instruction set")  # of two machines, these must be equal for equal bits


def of_machine(module):
    """:returns: dict of what this process computes with"""
    build = "".join(digests.of_file(file) for file in [module.__file__, *_libraries()])
    return {"version": __version__, "build": hashlib.sha256(build.encode()).hexdigest()[:16],
            "instruction set": module.instruction_set()}


@functools.lru_cache(maxsize=None)
def of_process():
    """:returns: of_machine() at the first call: files of a build may be replaced while their process renders"""
    return of_machine(_patina)


def _libraries():
    """:returns: paths of Patina's own library where it is apart from the module: the loader chooses it by the processor"""
    try:
        with open("/proc/self/maps", encoding="utf-8", errors="surrogateescape") as file:
            paths = {line.split(maxsplit=5)[-1].rstrip("\n") for line in file if "/libpatina.so" in line}
            paths = {path[:-len(_REPLACED)] if path.endswith(_REPLACED) else path for path in paths}
    except OSError:  # not Linux: one library for all processors
        paths = set()
    return sorted(path for path in paths if os.path.isfile(path))


def environment():
    """:returns: dict of the variables that images depend on; None for those that are not set"""
    return {name: os.environ.get(name) or None for name in ENVIRONMENT}


def environment_files():
    """:returns: dict of variable -> files that it leads to: the colour configuration, and models in the order they are read"""
    found = {}
    config = os.environ.get("OCIO", "")
    if config and "://" not in config:  # ocio://... is built in
        found["OCIO"] = [os.path.abspath(config)]
    for folder in filter(None, os.environ.get("PATINA_MODEL_PATH", "").split(":")):
        with contextlib.suppress(OSError):
            found.setdefault("PATINA_MODEL_PATH", []).extend(
                os.path.join(os.path.abspath(folder), name) for name in sorted(os.listdir(folder)) if name.endswith(".mtlx"))
    return found


def of_environment():
    """:returns: dict of variable -> what it leads to: digests of files, or what it says"""
    found = {}
    for name, files in environment_files().items():
        found[name] = [_digest(file) for file in files]
    config = os.environ.get("OCIO", "")
    return {"OCIO": config, **found} if config else found


def _digest(path):
    try:
        return digests.of_file(path)
    except (OSError, ValueError):  # a name that no file can have
        return "missing"


def of_render(stage, settings, camera, others):
    """:param settings: dict of render settings
    :param others: dict of what else was asked for
    :returns: dict that JSON can hold"""
    kept = {name: value for name, value in settings.items() if name not in (*_OF_PARTS, *_OF_RUNS)}
    what = {"format": FORMAT, **of_process(), "camera": camera, "files": _files(stage),
            "environment": of_environment(), "settings": kept, **others}
    return json.loads(json.dumps(what, default=str))


def _files(stage):
    """:returns: dict of name, relative to the stage's folder, -> digest: all layers, textures and documents that were read"""
    root = stage.GetRootLayer().realPath
    folder = os.path.dirname(root)
    found = {}
    for layer in stage.GetUsedLayers():
        if layer.anonymous and layer != stage.GetSessionLayer():  # overrides are told by --set
            found[f"anonymous {len(found)}"] = hashlib.sha256(layer.ExportToString().encode()).hexdigest()
    for path in inputs.files():
        found[os.path.relpath(path, folder)] = _digest(path)
    return found


def difference(a, b, where=""):
    """:returns: in a few words the first thing in which two identities differ; an empty text where they do not"""
    if isinstance(a, dict) and isinstance(b, dict):
        for name in [*a, *(name for name in b if name not in a)]:
            inner = difference(a.get(name), b.get(name), name if not where else f"{where} {name}")
            if inner:
                return inner
        return ""
    if a == b:
        return ""
    if where.startswith("environment "):
        return f"${where[len('environment '):]} leads to something else"
    if where.startswith("files "):
        name = where[len("files "):]
        return f"{name} is another" if a and b else f"{name} is read by one of them alone"
    return f"{where} is {_shown(a)}, not {_shown(b)}"


def _shown(value):
    text = "nothing" if value is None else str(value)
    return text if len(text) <= 80 else text[:77] + "..."


def still_true(module, what, stage):
    """:returns: whether a part that was made earlier is of this Patina and of the files as they are now"""
    if any(what.get(name) != value for name, value in {**of_machine(module), "environment": of_environment()}.items()):
        return False
    folder = os.path.dirname(os.path.realpath(stage))
    for name, digest in what.get("files", {}).items():
        if name.startswith("anonymous "):
            continue
        if _digest(os.path.join(folder, name)) != digest:
            return False
    return True
