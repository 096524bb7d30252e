# SPDX-License-Identifier: Apache-2.0
"""Commands that read a stage or a document call no other machine, whatever addresses these name."""
import os
import shutil
import subprocess
import sys

import pytest

import mtlx
from usda import camera, material, prim, stage


HERE = os.path.dirname(os.path.abspath(__file__))
STAGE = stage(
    camera(at=(0, 0, 6)),
    prim("DomeLight", "dome", "asset inputs:texture:file = @https://example.org/sky.exr@"),
    prim("SphereLight", "lamp", "asset inputs:shaping:ies:file = @//example.org/lamp.ies@"),
    prim("", "many",
         meta=("prepend references = @http://example.org/many.usd@</many>", "prepend payload = @ftp://example.org/more.usdz@")),
    prim("Sphere", "ball", bind="look"),
    material("look", {
        "s": ("UsdPreviewSurface", {"color3f diffuseColor": "<t>"}),
        "t": ("UsdUVTexture", {"file": "https://example.org/color.<UDIM>.png"}, "color3f rgb")}, surface="s"),
    up="", subLayers="[@http://example.org/layer.usda@]")
DOCUMENT = mtlx.document(
    '<xi:include href="http://example.org/more.mtlx"/>', {"i": ("image color3", {"filename file": "http://example.org/a.png"})},
    mtlx.shader("M", inputs={"base_color": "<i>"}), attributes='xmlns:xi="http://www.w3.org/2001/XInclude"')
COMMANDS = {
    "record": ("record", "shot.usda", "image.exr", "--camera", "/camera", "-w", "16", "--samples", "1", "--report",
               "report.html", "--threads", "1"),
    "raster": ("record", "shot.usda", "image.png", "--camera", "/camera", "-w", "16", "--samples", "1", "--backend", "raster"),
    "explain": ("explain", "shot.usda"), "explainDocument": ("explain", "look.mtlx"), "check": ("check", "look.mtlx"),
    "bsdf": ("bsdf", "albedo", "look.mtlx"),
    "bake": ("bake", "look.mtlx", "baked.usda", "--to", "UsdPreviewSurface", "--resolution", "8"),
    "shader": ("shader", "look.mtlx", "--target", "glsl"),
}


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    compiler = shutil.which("cc") or shutil.which("gcc")
    if not compiler:
        pytest.skip("no C compiler to build the library that refuses connections")
    path = str(tmp_path_factory.mktemp("preload") / "connections.so")
    subprocess.run([compiler, "-shared", "-fPIC", "-o", path, os.path.join(HERE, "connections.c")], check=True)
    return path


def run(library, folder, *words):
    environment = dict(os.environ, LD_PRELOAD=library, PYTHONPATH=os.pathsep.join(path for path in sys.path if path))
    return subprocess.run([sys.executable, *words], cwd=folder, env=environment, text=True, capture_output=True, timeout=600)


def test_a_connection_is_noticed(library, tmp_path):
    done = run(library, tmp_path, "-c", "import socket; socket.create_connection(('127.0.0.1', 9))")
    assert done.returncode < 0 and "a connection was tried" in done.stderr


@pytest.mark.parametrize("name", COMMANDS)
def test_no_connection_is_opened(name, library, tmp_path):
    (tmp_path / "shot.usda").write_text(STAGE)
    (tmp_path / "look.mtlx").write_text(DOCUMENT)
    done = run(library, tmp_path, "-m", "patina", *COMMANDS[name])
    assert done.returncode == 0 and "a connection was tried" not in done.stderr, done.stderr
    assert "No module" not in done.stderr and "usage:" not in done.stderr and "Traceback" not in done.stderr, done.stderr
