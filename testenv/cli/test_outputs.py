# SPDX-License-Identifier: Apache-2.0
"""Where commands write: over nothing but regular files, over none that they read, whole or not at all."""
import os
import resource
import stat

import pytest

import _patina
import mtlx
from patina import inputs
from patina.cli import main, record
from usda import camera, material, prim, stage

STAGE = stage(
    prim("Sphere", "ball", "rel material:binding = </m>"),
    camera(at=(0, 0, 10)),
    up="", subLayers="[@./looks.usda@]")
LOOKS = stage(
    material("m",
             {"s": ("UsdPreviewSurface", {"color3f diffuseColor": "<t>"}), "t": ("UsdUVTexture", {"file": "./paint.png"})},
             surface="s"),
    up="")
# Files that stand at {out} are written; the rest are read.
COMMANDS = {
    "record": ["record", "stage.usda", "{out}.png", "-w", "4", "--samples", "1", "--quiet"],
    "record checkpoint": ["record", "stage.usda", "{out}.png", "-w", "4", "--samples", "1", "--quiet"],
    "record frames": ["record", "stage.usda", "{out}.##.png", "--frames", "1:2", "-w", "4", "--samples", "1", "--quiet"],
    "record json": ["record", "stage.usda", "image.png", "-w", "4", "--samples", "1", "--quiet", "--json={out}.json"],
    "bake": ["bake", "m.mtlx", "{out}.usda", "--to", "gltf_pbr"],
    "view": ["view", "m.mtlx", "-o", "{out}.html"],
    "view controls": ["view", "m.mtlx", "-o", "page.html", "--writeControls", "{out}.json"],
    "compare": ["compare", "paint.png", "paint.png", "--no-flip", "--json={out}.json"],
    "explain": ["explain", "m.mtlx", "--json={out}.json"],
    "check": ["check", "m.mtlx", "--json={out}.json"],
    "bsdf": ["bsdf", "albedo", "m.mtlx", "--json={out}.json"],
    "chart": ["chart", "--lobes", "--point", "directionalAlbedo", "--json={out}.json"],
    "chart table": ["chart", "--lobes", "--point", "directionalAlbedo", "--table", "{out}.cpp"],
    "chart stability": ["chart", "--stability", "--points", "4", "--json={out}.json"],
}
# Quick ones of those that write text, image and stage.
WRITERS = {name: COMMANDS[name] for name in ("record", "record json", "bake", "compare", "explain", "bsdf")}


def _pipe(path):
    os.mkfifo(path)


def _device(path):
    try:
        os.mknod(path, stat.S_IFCHR | 0o600, os.makedev(1, 3))
    except PermissionError:
        pytest.skip("root alone makes devices")


THINGS = {"pipe": _pipe, "device": _device, "link to a device": lambda path: os.symlink("/dev/null", path),
          "dangling link": lambda path: os.symlink("nowhere", path), "looping link": lambda path: os.symlink(path, path),
          "folder": os.mkdir}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "m.mtlx").write_text(mtlx.document(mtlx.shader("m", inputs={"base_color": (0.1, 0.2, 0.3)})))
    (tmp_path / "stage.usda").write_text(STAGE)
    (tmp_path / "looks.usda").write_text(LOOKS)
    _patina.write_image(str(tmp_path / "paint.png"), [[[0.5, 0.2, 0.1]] * 2] * 2)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(capsys, arguments, **places):
    """:returns: the exit status, and what was said on standard error"""
    capsys.readouterr()
    status = main.main([argument.format(**places) for argument in arguments])
    return status, capsys.readouterr().err.strip()


def output_of(name, stem):
    """:returns: the file that a command of the table writes"""
    text = next(argument for argument in COMMANDS[name] if "{out}" in argument).rpartition("=")[2].format(out=stem)
    return text.replace("##", "02") + (".checkpoint" if name == "record checkpoint" else "")


@pytest.mark.parametrize("thing", THINGS)
@pytest.mark.parametrize("name", COMMANDS)
def test_what_is_no_regular_file_is_refused_before_anything_slow(name, thing, folder, capsys, monkeypatch):
    monkeypatch.setattr(record._Job, "render", lambda *_: pytest.fail("rendered"))
    path = output_of(name, "target")
    THINGS[thing](path)
    before, names = os.lstat(path), sorted(os.listdir())
    status, said = run(capsys, COMMANDS[name], out="target")
    assert status == 1 and f"'{path}'" in said and len(said.splitlines()) == 1
    after = os.lstat(path)
    assert (after.st_ino, after.st_mode) == (before.st_ino, before.st_mode)
    assert sorted(os.listdir()) == names


@pytest.mark.parametrize("name", WRITERS)
def test_a_full_disk_keeps_the_old_file(name, folder, capsys):
    """Writing beyond a file's largest size fails as it does on a full disk."""
    path = output_of(name, "target")
    with open(path, "w") as file:
        file.write("old")
    names = sorted(os.listdir())
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (16, before[1]))
    try:
        status, said = run(capsys, COMMANDS[name], out="target")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert status == 1 and f"'{path}'" in said and len(said.splitlines()) == 1
    with open(path) as file:
        assert file.read() == "old"
    assert sorted(set(os.listdir()) - {"image.png"}) == names
    if name == "bake":
        os.remove(path)  # it is no layer
    assert run(capsys, COMMANDS[name], out="target")[0] == 0
    assert os.path.getsize(path) > 16


@pytest.mark.parametrize("arguments, kept", [
    (["record", "stage.usda", "paint.png", "-w", "4", "--quiet"], "paint.png"),
    (["record", "stage.usda", "link.png", "-w", "4", "--quiet"], "paint.png"),
    (["record", "stage.usda", "a.png", "-w", "4", "--quiet", "--json=looks.usda"], "looks.usda"),
    (["record", "stage.usda", "a.png", "-w", "4", "--quiet", "--json=a.png"], None),
    (["bake", "stage.usda:m", "stage.usda", "--to", "gltf_pbr"], "stage.usda"),
    (["bake", "stage.usda:m", "looks.usda", "--to", "gltf_pbr"], "looks.usda"),
    (["bake", "stage.usda:m", "./link.usda", "--to", "gltf_pbr"], "stage.usda"),
    (["bake", "stage.usda:m", "paint.usda", "--to", "gltf_pbr", "--resolution", "4"], "paint_base_color.png"),
    (["view", "m.mtlx", "-o", "m.mtlx"], "m.mtlx"),
    (["view", "outer.mtlx", "-o", "m.mtlx"], "m.mtlx"),
    (["view", "m.mtlx", "-o", "a.html", "--controls", "c.json", "--writeControls", "c.json"], "c.json"),
    (["view", "m.mtlx", "-o", "a.html", "--writeControls", "./a.html"], None),
    (["view", "m.mtlx", "-o", "paint.png", "--environment", "paint.png"], "paint.png"),
    (["compare", "paint.png", "link.png", "--no-flip", "--json=paint.png"], "paint.png"),
    (["chart", "stage.usda", "--reference", "paint.exr", "--json=paint.exr", "-w", "4", "--maxSamples", "1", "--tolerances",
      "none", "--backend", "embree", "--quiet"], "paint.exr"),
    (["explain", "stage.usda", "--json=looks.usda"], "looks.usda"),
    (["explain", "stage.usda", "--json=paint.png"], "paint.png"),
    (["bsdf", "albedo", "m.mtlx", "--json=m.mtlx"], "m.mtlx"),
    (["check", "m.mtlx", "--json=m.mtlx"], "m.mtlx"),
])
def test_an_output_is_no_input(arguments, kept, folder, capsys):
    os.symlink("paint.png", "link.png")
    os.symlink("stage.usda", "link.usda")
    (folder / "c.json").write_text('{"controls": [], "presets": []}')
    _patina.write_image("paint.exr", [[[0.5, 0.2, 0.1]] * 2] * 2)
    (folder / "outer.mtlx").write_text(mtlx.document('<xi:include href="m.mtlx"/>', attributes='xmlns:xi="x"'))
    if kept == "paint_base_color.png":
        (folder / "looks.usda").write_text(LOOKS.replace("paint.png", "paint_base_color.png"))
        _patina.write_image(kept, [[[0.1, 0.9, 0.1]] * 2] * 2)
    content = (folder / kept).read_bytes() if kept else b""
    names = sorted(os.listdir())
    status, said = run(capsys, arguments)
    assert status == 1 and "cannot write" in said and len(said.splitlines()) == 1
    assert not kept or (folder / kept).read_bytes() == content
    assert sorted(os.listdir()) == names


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-32-be"])
@pytest.mark.parametrize("include", ['<xi:include href="lib.xml"/>', '<xi:include href="lib&#46;xml"/>',
                                     "<xi:include note='a > b' href = 'lib.xml'/>",
                                     '<xi:include x-href="no" title=" href=\'no\'" a="<" href="lib.xml"/>',
                                     '<xi:include href="lib.xml&#0;no"/>'])
def test_documents_that_are_included_are_inputs(tmp_path, include, encoding):
    (tmp_path / "a.mtlx").write_bytes(f"<materialx>{include}</materialx>".encode(encoding))
    inputs.forget()
    inputs.note_document(str(tmp_path / "a.mtlx"))
    assert inputs.files() == [str(tmp_path / "a.mtlx"), str(tmp_path / "lib.xml")]


def test_elements_that_do_not_end_are_looked_at_once(tmp_path):
    (tmp_path / "a.mtlx").write_text("<xi:include " * 200000)
    inputs.forget()
    inputs.note_document(str(tmp_path / "a.mtlx"))
    assert inputs.files() == [str(tmp_path / "a.mtlx")]
