# SPDX-License-Identifier: Apache-2.0
"""Calls that fail once: the n-th that writes an output (a full disk, a device that fails), maps or reads a file, or asks for a
large piece of memory; the n-th piece, of any size, that Patina's own C++ asks for; and contexts of OpenGL that are lost at the
n-th call. The old image or the new one is there, whole, and the message is one line. Where another library dies
in the very call that failed, Patina could not have known, and no promise is broken (failNthDeath.h)."""
import errno
import json
import os
import random as randoms
import shutil
import subprocess
import sys
import tempfile

import changing
import outcomes

HERE = os.path.dirname(os.path.abspath(__file__))
EXTENSION = ".json"
LINES = False
CPU_SECONDS = 300  # a driver in software compiles before it draws: with all AOVs for a minute and a half
NUMBERS = {"write": ("ENOSPC", "EIO", "EDQUOT", "EROFS"), "read": ("EIO", "EMFILE"), "map": ("ENOMEM", "EACCES"),
           "memory": ("ENOMEM",), "own": ("ENOMEM",), "context": ("EIO",)}
OUTPUTS = (("image.png",), ("image.exr",), ("image.exr", "--keepCheckpoint"),
           ("image.exr", "--part", "1/2", "--partial", "a.part"),
           ("image.tif", "--bits", "32"), ("image.exr", "--aov", "all"), ("image.exr", "--report", "a.html", "--json=b.json"))
# Calls of each kind that a render makes after all is loaded; of memory the rasterizer and its driver make more
CALLS = {"write": 520, "read": 300, "map": 3, "memory": 110, "own": 56000, "context": 12000}
RASTER_CALLS = {"memory": 20000, "own": 210000}
# What tells that a library cannot go on, and no caller could help it; the second is the dynamic linker's
DIED = (b": a library died in the call that failed", b"cannot allocate memory for thread-local data: ABORT")
_library = []


def make(seed):
    """:returns: the bytes of an input: what is rendered, which call fails, and with which error"""
    r = randoms.Random(seed)
    kind = r.choice(("write", "write", "read", "map", "memory", "memory", "own", "own", "context"))
    output, backend = r.choice(OUTPUTS), r.choice(("embree", "embree", "raster"))
    if kind == "context":
        output, backend = r.choice([words for words in OUTPUTS if "--part" not in words]), "raster"
    elif "--part" in output:  # which the rasterizer refuses
        backend = "embree"
    most = RASTER_CALLS[kind] if backend == "raster" and kind in RASTER_CALLS and r.random() < 0.7 else CALLS[kind]
    return json.dumps({"output": output, "kind": kind, "error": r.choice(NUMBERS[kind]),
                       "at": r.randint(1, 60 if kind == "write" and r.random() < 0.5 else
                                       300 if kind == "context" and r.random() < 0.5 else most),
                       "backend": backend}, indent=1).encode() + b"\n"


def library():
    """:returns: the path of the library that makes calls fail; empty without a C compiler"""
    if not _library:
        compiler = shutil.which("cc") or shutil.which("gcc")
        path = os.path.join(tempfile.gettempdir(), f"patinaFailNth-{os.getuid()}.so")
        source = os.path.join(HERE, "failNth.c")
        newest = max(os.stat(file).st_mtime for file in (source, os.path.join(HERE, "failNthDeath.h")))
        if compiler and not (os.path.exists(path) and os.stat(path).st_mtime > newest):
            made = f"{path}.{os.getpid()}"
            subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", made, source, "-ldl", "-lstdc++"], check=True)
            os.replace(made, path)
        _library.append(path if compiler else "")
    return _library[0]


def execute(path, folder):
    """Renders with a call that fails, in a process that may die. :returns: its exit status"""
    with open(path, encoding="utf-8") as file:
        asked = json.load(file)
    if not library():
        return 0
    changing.write_all(folder)
    image, *more = asked["output"]
    old = outcomes.put_old(folder, image)
    words = ["record", "shot.usda", image, *more, "--camera", "/camera", "--backend", asked["backend"], *outcomes.SMALL]
    code = ("import ctypes, os, sys\nfrom patina.cli import main, record\nimport numpy, _patina\nfrom pxr import Usd, UsdGeom\n"
            "f = ctypes.CDLL(sys.argv[1])\nos.chdir(sys.argv[2])\n"
            "f.failNthKind(sys.argv[3].encode())\nf.failNthBegin(sys.argv[2].encode(), int(sys.argv[4]), int(sys.argv[5]))\n"
            "f.failNthWhich.restype = ctypes.c_char_p\nstatus = main.main(sys.argv[6:])\nwhich = f.failNthWhich().decode()\n"
            "f.failNthBegin(b'', 0, 0)\nprint('counted: failing calls' if which else '', file=sys.stderr)\n"
            "sys.stderr.flush()\nos._exit(status)\n")
    environment = dict(os.environ, LD_PRELOAD=library())
    if asked["kind"] == "context":
        environment["PATINA_GL_FAULT"] = f"lostAtCall:{asked['at']}"
    done = subprocess.run([sys.executable, "-X", "faulthandler", "-c", code, library(), folder, asked["kind"], str(asked["at"]),
                           str(getattr(errno, asked["error"])), *words], env=environment,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, preexec_fn=outcomes.end_with_parent)
    # That memory is missing is what was asked for here, and to say so no finding.
    sys.stderr.buffer.write(done.stderr.replace(b"out of memory", b"the memory that fails").replace(b"bad_alloc", b"bad alloc"))
    sys.stderr.flush()
    if b"has reset the OpenGL context" in done.stderr:
        print("counted: lost contexts", file=sys.stderr)
    if b"\ndied after" in b"\n" + done.stderr:
        print("counted: failing calls", file=sys.stderr)
    if done.returncode and any(text in done.stderr for text in DIED):
        return outcomes.LIBRARY
    if done.returncode < 0:
        os.kill(os.getpid(), -done.returncode)
    if not os.path.exists(old):
        return outcomes.broken("the image that was there before is lost")
    with open(old, "rb") as file:
        data = file.read()
    if data != outcomes.SENTINEL:
        import _patina

        try:
            _patina.read_image(old)
        except (OSError, RuntimeError) as error:
            return outcomes.broken(f"the image is neither the old one nor whole: {error}")
        if done.returncode and "--report" not in more and "--part" not in more and "--keepCheckpoint" not in more \
                and not any(word.startswith("--json") for word in more) and done.returncode != 75:
            return outcomes.broken("a render that failed has changed the image")
    elif not done.returncode and "--part" not in more:
        return outcomes.broken("a render that is done has written no image")
    if [name for name in os.listdir(folder) if name.startswith(".")]:
        return outcomes.broken("a temporary file is left over")
    return done.returncode
