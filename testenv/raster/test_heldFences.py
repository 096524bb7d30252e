# SPDX-License-Identifier: Apache-2.0
"""llvmpipe frees no fence that a thread of its own is still at work with: see hdDelegate/raster/gl/heldFences.h."""
import os
import shutil
import subprocess
import sys

import pytest

import bothBackEnds

HERE = os.path.dirname(os.path.abspath(__file__))


@pytest.fixture(scope="module")
def slow_signals(tmp_path_factory):
    """:returns: the path of a library by which llvmpipe's threads are slow to let go of a fence"""
    bothBackEnds.needs_opengl()
    compiler = shutil.which("cc") or shutil.which("gcc")
    if not compiler:
        pytest.skip("no C compiler to build the library that slows llvmpipe's threads")
    path = str(tmp_path_factory.mktemp("preload") / "slowSignals.so")
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", path, os.path.join(HERE, "slowSignals.c"), "-ldl"], check=True)
    return path


# One with framebuffers in turn and little else, one with textures so large that llvmpipe ends a batch at each draw.
@pytest.mark.parametrize("name", ["diffuseBox", "roughGlass"])
def test_no_fence_is_freed_while_it_is_signalled(slow_signals, tmp_path, name):
    counts = tmp_path / "counts"
    environment = dict(os.environ, LD_PRELOAD=slow_signals, PATINA_SLOW_SIGNALS=str(counts),
                       PYTHONPATH=os.pathsep.join(path for path in sys.path if path))
    done = subprocess.run([sys.executable, "-m", "patina", "record", os.path.join(bothBackEnds.SCENES, name + ".usda"),
                           str(tmp_path / "image.exr"), "-w", "96", "--backend", "raster", "--samples", "2"],
                          env=environment, text=True, capture_output=True, timeout=900)
    assert done.returncode == 0, done.stderr
    signals, freed = map(int, counts.read_text().split())
    if signals == 0:
        pytest.skip("no thread named llvmpipe-N signalled a fence: OpenGL here is another driver's")
    assert signals > 100
    assert freed == 0
