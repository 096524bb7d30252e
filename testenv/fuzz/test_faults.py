# SPDX-License-Identifier: Apache-2.0
"""Every call that writes an output fails once, as on a full disk: the old file or the new one is there, whole, nothing else is
left over, and the message names the file and the reason."""
import errno
import json
import os
import shutil
import subprocess
import sys

import pytest

import faults

HERE = os.path.dirname(os.path.abspath(__file__))
STAGE = '#usda 1.0\ndef Sphere "ball"\n{\n}\n'
SMALL = ("-w", "8", "--samples", "1", "--maxDepth", "1", "--threads", "1", "--quiet")


@pytest.fixture(scope="module")
def library():
    return faults.library() or pytest.skip("no C compiler to build the library that makes calls fail")


CARELESS = """#include <stdlib.h>
#include <string.h>
char* take(void) { return malloc(1 << 20); }
char* fill(char* piece) { return memset(piece, 1, 1 << 20); }
void careless(void) { fill(take()); }
"""


@pytest.mark.parametrize("words, whose", [("taker.careless()", "a library died in the call that failed"),
                                          ("user.fill(taker.take())", ""), ("print(taker.take())", "lives")])
def test_a_library_that_dies_of_its_own_call_is_told_apart(words, whose, library, tmp_path):
    """From a caller that hands on what it did not get."""
    (tmp_path / "careless.c").write_text(CARELESS)
    for name in ("taker", "user"):
        subprocess.run([shutil.which("cc") or "gcc", "-shared", "-fPIC", "-O0", "-o", str(tmp_path / f"{name}.so"),
                        str(tmp_path / "careless.c")], check=True)
    code = ("import ctypes, sys\nf = ctypes.CDLL(sys.argv[1])\ntaker, user = map(ctypes.CDLL, sys.argv[2:])\n"
            "taker.take.restype = user.fill.restype = ctypes.c_void_p\nuser.fill.argtypes = [ctypes.c_void_p]\n"
            f"f.failNthKind(b'memory')\nf.failNthBegin(b'/', 1, 12)\n{words}\n")
    done = subprocess.run([sys.executable, "-c", code, library, *(str(tmp_path / f"{name}.so") for name in ("taker", "user"))],
                          capture_output=True, text=True, env=dict(os.environ, LD_PRELOAD=library))
    if whose == "lives":
        assert done.returncode == 0 and done.stdout == "None\n" and not done.stderr
        return
    assert done.returncode < 0 and "died after malloc failed, called by taker.so" in done.stderr, done.stderr
    assert done.stderr.strip().endswith(whose or "in user.so"), done.stderr


def told(library, tmp_path, outputs, number):
    """:returns: what became of a render with each call failing in turn, the last with none"""
    (tmp_path / "stage.usda").write_text(STAGE)
    folder = tmp_path / "out"
    folder.mkdir()
    words = [word.replace("OUT", str(folder)).replace("TMP", str(tmp_path)) for word in outputs]
    environment = dict(os.environ, LD_PRELOAD=library)
    done = subprocess.run([sys.executable, os.path.join(HERE, "faultyHost.py"), library, str(folder), str(number), "record",
                           str(tmp_path / "stage.usda"), *words, *SMALL], capture_output=True, text=True, env=environment,
                          timeout=300)
    assert done.returncode == 0, done.stderr
    return [json.loads(line) for line in done.stdout.splitlines()]


@pytest.mark.parametrize("outputs, functions", [
    (("OUT/a.png",), {"open", "fsync", "rename"}),
    (("OUT/a.exr", "--keepCheckpoint"), {"open", "fwrite", "fflush", "fclose", "fsync", "rename"}),
    (("TMP/unwritten.exr", "--part", "1/1", "--partial", "OUT/a.part"),
     {"open", "fwrite", "fflush", "fclose", "fsync", "rename"}),
], ids=("png", "checkpoint", "part"))
def test_a_call_that_fails_loses_nothing(outputs, functions, library, tmp_path):
    runs = told(library, tmp_path, outputs, errno.ENOSPC)
    *failing, last = runs
    assert last["status"] == 0 and not last["which"] and "old" not in last["images"].values()
    assert functions <= {run["which"] for run in failing}
    for run in failing:
        assert run["whole"], run
        case = f"{run['which']} {run['at']}: {run}"
        # The bits of the whole file, or those that were there before.
        assert all(state == "old" or state == last["images"][name] or run["status"] == 0
                   for name, state in run["images"].items()), case
        assert not [name for name in run["files"] if name.startswith(".")], case  # no temporary
        if run["status"]:
            assert run["status"] in (1, 75) and os.strerror(errno.ENOSPC) in run["error"], case
            assert str(tmp_path) in run["error"] and run["error"].count("\n") == 1, case


AGAIN = """import ctypes, os, sys
import numpy as np, _patina
from pxr import Usd
from patina import stage as reader
f = ctypes.CDLL(sys.argv[1])
f.failNthWhich.restype = ctypes.c_char_p


def read():
    scene = _patina.Scene()
    with scene.edit() as edit:
        reader.read_stage(Usd.Stage.Open(sys.argv[2]), edit, reader.StageOptions(frame=0.0, camera="/camera"))
    return scene


def render(scene, renderer, at):
    film = _patina.Film()
    f.failNthKind(b"own")
    f.failNthBegin(b"/", at, 12)
    try:
        renderer.start(scene, "/camera", {"width": 16, "height": 12, "samples": 1, "maxDepth": 2, "threads": 2}, film)
        renderer.wait()
    except MemoryError:
        return 0, True, None
    finally:
        count, which = f.failNthCount(), f.failNthWhich()
        f.failNthBegin(b"", 0, 0)
    state = renderer.progress()
    assert which or not state["failed"], state["error"]
    assert not state["failed"] or state["error"] == "out of memory", state["error"]
    return count, state["failed"], None if state["failed"] else np.array(film.resolve("color"))


scene = read()
count, _, plain = render(scene, _patina.make_renderer(sys.argv[3]), 1 << 30)
failed = 0
for k in range(int(sys.argv[4])):
    renderer = _patina.make_renderer(sys.argv[3])
    failed += render(scene, renderer, 1 + k * count // int(sys.argv[4]))[1]
    if any("memory" in warning["message"] for warning in scene.warnings()):
        scene = read()  # a texture or field stays left out, as the warning says
    assert np.array_equal(render(scene, renderer, 1 << 30)[2], plain), k
print(failed)
"""


@pytest.mark.parametrize("backend, times", [("embree", 16), ("raster", 6)])
def test_a_render_without_memory_spoils_none_after_it(backend, times, library, tmp_path):
    """Each allocation of Patina's own may fail, on each thread: the render says so, and the next one is whole."""
    import changing
    import inProcess

    inProcess.needs_opengl(backend)
    changing.write_all(str(tmp_path))
    done = subprocess.run([sys.executable, "-X", "faulthandler", "-c", AGAIN, library, str(tmp_path / "shot.usda"), backend,
                           str(times)], capture_output=True, text=True, env=dict(os.environ, LD_PRELOAD=library), timeout=1200)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) > times // 4, done.stdout
