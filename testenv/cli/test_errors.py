# SPDX-License-Identifier: Apache-2.0
"""Whatever goes wrong is one line, and the exit status 1, or 2 for wrong usage."""
import builtins
import os
import re
import signal
import sys
import zipfile

import pytest
from pxr import Sdf

import _patina
from patina import experiment
from patina.cli import bench, explain, frames, main, record
from patina.cli.errors import UsageError
import usda

BALL = usda.stage(
    usda.prim("Sphere", "ball", "int elementSize = 1", "uchar small = 1", "float size = 1"),
    usda.prim("RectLight", "light", "int inputs:count = 3"),
    up="")


def run(capsys, *arguments):
    """:returns: exit status and standard error, which holds one line and no traceback"""
    capsys.readouterr()
    status = main.main(list(arguments))
    said = capsys.readouterr().err
    assert "Traceback" not in said
    return status, said.strip()


@pytest.fixture
def stage(tmp_path):
    path = tmp_path / "ball.usda"
    path.write_text(BALL)
    return str(path)


@pytest.mark.parametrize("spec", ["1e999", "1:1e999", "-1e999:1", "1:2x1e-320", "1:2x5e-324", "1:2x1e999", "1:2x-1e999",
                                  "1:1e300", "-1e308:1e308", "nan", "inf", "1:inf", "1:2x0", "1:2xnan"])
def test_frames_that_lead_nowhere(spec):
    with pytest.raises(UsageError) as error:
        frames.expand(spec, 1.0, 2.0)
    assert len(str(error.value).splitlines()) == 1


@pytest.mark.parametrize("start", [float("nan"), float("inf"), -float("inf")])
def test_stages_without_finite_times(start):
    with pytest.raises(UsageError):
        frames.expand("STARTTIME:2", start, 2.0)
    with pytest.raises(UsageError):
        frames.expand("1:ENDTIME", 1.0, start)


def test_the_most_frames_are_still_given():
    assert len(frames.expand(f"1:{frames.MAX_FRAMES}", 1.0, 2.0)[0]) == frames.MAX_FRAMES


@pytest.mark.parametrize("change", ["/ball.elementSize=inf", "/ball.elementSize=nan", "/ball.elementSize=-inf",
                                    "/ball.elementSize=1e300",
                                    "/ball.elementSize=", "/ball.small=300", "/ball.small=-1", "/light.count=nan",
                                    "/ball.size=one", "/ball.size=1e9999,2"])
def test_values_that_an_input_does_not_take(change, stage, tmp_path, capsys):
    status, said = run(capsys, "record", stage, str(tmp_path / "a.png"), "-w", "4", "--samples", "1", "--quiet", "--set",
                       change)
    assert status == 1 and change.partition("=")[0] in said and len(said.splitlines()) == 1
    assert not (tmp_path / "a.png").exists()


@pytest.mark.parametrize("count", ["1000000000", "4097", "0", "-1", "many"])
def test_threads_are_bounded(count, stage, tmp_path, capsys):
    status, said = run(capsys, "record", stage, str(tmp_path / "a.png"), f"--threads={count}")
    assert status == 2 and "--threads" in said and len(said.splitlines()) == 1


def test_as_many_threads_as_are_let(stage, tmp_path):
    """Also where the bound of the command line is not asked: hosts have their own."""
    assert main.main(["record", stage, str(tmp_path / "a.png"), "-w", "4", "--samples", "1", "--quiet", "--threads",
                      "4096"]) == 0
    scene, film, renderer = _patina.Scene(), _patina.Film(), _patina.make_renderer()
    with scene.edit() as edit:
        edit.set_camera("/camera", transform=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
    settings = {"width": 4, "height": 4, "samples": 1, "threads": 1000000000}
    assert experiment.draw(renderer, scene, "/camera", settings, film)["converged"]


@pytest.mark.parametrize("arguments", [["record", "a.usda", "b\udcff.png"], ["record", "a\udcff.usda", "b.png"],
                                       ["explain", "a\udcff.mtlx"], ["bake", "m.mtlx", "o\udcff.usda", "--to", "gltf_pbr"],
                                       ["view", "m.mtlx", "-o", "o\udcff.html"], ["compare", "a", "b", "--json=\udcff"],
                                       ["\udcff"]])
def test_names_that_are_not_utf8(arguments, capsys):
    status, said = run(capsys, *arguments)
    assert status == 2 and "UTF-8" in said and len(said.splitlines()) == 1


@pytest.mark.parametrize("flag", ["--json=o\udcff", "--out=o\udcff", "--table=o\udcff"])
def test_charts_go_to_names_that_are_utf8(flag, tmp_path, monkeypatch, capsys):
    """Their stages may be called anything: one that cannot be opened is one of several."""
    monkeypatch.chdir(tmp_path)
    status, said = run(capsys, "chart", "--lobes", "--point", "directionalAlbedo", flag)
    assert status == 1 and "UTF-8" in said and len(said.splitlines()) == 1
    assert os.listdir() == []


class _Unspeakable(Exception):
    """As pxr's, which quote names of a file."""

    def __str__(self):
        return b"name \xff".decode()


@pytest.mark.parametrize("error", [_Unspeakable(), ValueError("many\n\n lines"), KeyError("key"), RecursionError(),
                                   MemoryError(), AssertionError("x"),
                                   ZeroDivisionError("by zero"), UnicodeDecodeError("utf-8", b"ab\xffc", 2, 3, "why"),
                                   OSError(28, "No space left on device", "file"), RuntimeError("half a character: \udcff"),
                                   RuntimeError("a terminal's \x1b[2J command \x07")])
def test_every_exception_becomes_one_line(error, monkeypatch, capsys):
    def fail(_):
        raise error

    monkeypatch.delenv("PATINA_TRACEBACK", raising=False)
    monkeypatch.setattr(explain, "run", fail)
    status, said = run(capsys, "explain", "m.mtlx")
    temporary = isinstance(error, (MemoryError, OSError))
    assert status == (75 if temporary else 1) and said.startswith("patina: ") and len(said.splitlines()) == 1 and len(said) > 10
    assert said.rstrip("\n").isprintable()
    monkeypatch.setenv("PATINA_TRACEBACK", "1")
    assert main.main(["explain", "m.mtlx"]) == status
    said = capsys.readouterr().err
    assert "Traceback" in said and "in fail" in said


def test_an_interrupted_import_is_no_missing_module(monkeypatch, capsys):
    """Extension modules turn what interrupts their import into an ImportError."""
    real = builtins.__import__

    def interrupted(name, *arguments, **keywords):
        if name == "_patina":
            try:
                os.kill(os.getpid(), signal.SIGINT)
                for _ in range(1000):  # until the signal is handled
                    pass
            except KeyboardInterrupt:
                raise ImportError("initialization failed") from None
        return real(name, *arguments, **keywords)

    monkeypatch.delitem(sys.modules, "_patina", raising=False)
    monkeypatch.setattr(builtins, "__import__", interrupted)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # shells start what runs behind them without it
    try:
        status, said = run(capsys, "explain", __file__)
    finally:
        signal.signal(signal.SIGINT, before)
    assert status == 1 and said == "patina: interrupted"


def _package(path, name, content):
    """A usdz whose first file has any name and content."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as package:
        package.writestr("x" * len(name), content)
    data = path.read_bytes().replace(b"x" * len(name), name)
    path.write_bytes(data)


@pytest.mark.parametrize("damage", range(8))
def test_damaged_stages(damage, tmp_path, capsys):
    """Stages that pxr cannot read, and names that are no UTF-8, are told in one line or as warnings."""
    layer = Sdf.Layer.CreateNew(str(tmp_path / "good.usdc"))
    layer.ImportFromString(usda.stage(
        usda.prim("Sphere", "ballBallBall", "rel material:binding = </ballBallBall/look>",
            usda.prim("Material", "look", "asset inputs:fileFileFile = @pictureOfPaint.png@")),
        up=""))
    layer.Save()
    good = (tmp_path / "good.usdc").read_bytes()
    name = "bad.usdz" if damage >= 4 else "bad.usdc"
    path = tmp_path / name
    if damage == 0:
        path.write_bytes(good.replace(b"ballBallBall", b"ball\xff\xfe\x80all"))
    elif damage == 1:
        path.write_bytes(good.replace(b"pictureOfPaint", b"picture\xff\xfePaint"))
    elif damage == 2:
        path.write_bytes(good[:len(good) // 2])
    elif damage == 3:
        path.write_bytes(good[:200] + b"\xff" * 100 + good[300:])
    elif damage == 4:
        _package(path, b"n\xff\xfe.usdc", good)
    elif damage == 5:
        _package(path, b"inner.usdc", good[:100])
    elif damage == 6:
        _package(path, b"inner.usda", b"#usda 1.0\ndef Sphere \"b\xff\" {}\n")
    else:
        path.write_bytes(b"PK\3\4" + os.urandom(200))
    for arguments in (["record", str(path), str(tmp_path / "a.png"), "-w", "4", "--samples", "1"], ["explain", str(path)]):
        capsys.readouterr()
        status = main.main(arguments)
        said = capsys.readouterr().err
        assert status in (0, 1) and "Traceback" not in said
        assert status == 0 or said.strip()


@pytest.mark.parametrize("kind", ["pipe", "device"])
@pytest.mark.parametrize("arguments", [["record", "{}.usda", "a.png"], ["explain", "{}.usda"], ["explain", "{}.mtlx"],
                                       ["compare", "{}.png", "{}.png", "--no-flip"],
                                       ["view", "m.mtlx", "-o", "a.html", "--controls", "{}.json"]])
def test_only_regular_files_are_read(arguments, kind, tmp_path, monkeypatch, capsys):
    """A pipe would wait for ever, a device never end."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "m.mtlx").write_text('<?xml version="1.0"?><materialx version="1.39"/>')
    for ending in ("usda", "mtlx", "png", "json"):
        os.mkfifo(f"thing.{ending}") if kind == "pipe" else os.symlink("/dev/zero", f"thing.{ending}")
    status, said = run(capsys, *[argument.format("thing") for argument in arguments])
    assert status == 1 and "regular file" in said and len(said.splitlines()) == 1


def test_the_table_of_methods_keeps_names_and_texts_apart():
    from patina.cli import methods

    lines = [line.split() for line in methods._listing().splitlines()]
    words = [line[0] for line in lines if line]
    for point, names in _patina.choice_points():
        for name, _ in names:
            assert name in words, f"{name} of {point} runs into its text"


def test_benchmarks_end_in_one_line_too(monkeypatch, capsys):
    monkeypatch.setattr(bench, "run", lambda _: 1 / 0)
    assert run(capsys, "bench")[0] == 1


def clips(fields):
    return f'clips = {{\n dictionary default = {{\n string primPath = "/x"\n {fields}\n }}\n}}'


@pytest.mark.parametrize("where", [
    "subLayers = [@pipe.usda@]", "subLayers = [@between.usda@]", "references = @pipe.usda@", "references = @between.usda@",
    "payload = @named.usda@</a>", "references = @pipe.usdz[a.usda]@", 'references = @`"pipe.usda"`@',
    'references = @`"${N}.usda"`@', "references = @folder/apart.usda@</a>",
    clips("asset[] assetPaths = [@pipe.usda@]\n double2[] active = [(0, 0)]\n double2[] times = [(0, 0)]"),
    clips("asset[] assetPaths = [@empty.usda@]\n asset manifestAssetPath = @pipe.usda@\n double2[] active = [(0, 0)]"),
    clips('string templateAssetPath = "./pipe.#.usda"\n double templateStartTime = 1\n double templateEndTime = 1\n '
          "double templateStride = 1")])
def test_layers_that_are_pipes_are_not_waited_for(where, tmp_path, capsys):
    pipes = [tmp_path / name for name in ("pipe.usda", "pipe.usdz", "pipe.1.usda")]
    for pipe in pipes:
        os.mkfifo(pipe)
    (tmp_path / "folder").mkdir()
    for name, target in (("named", '@`"${N}.usda"`@'), ("folder/apart", "@pipe.usda@"), ("empty", "[]")):
        (tmp_path / f"{name}.usda").write_text(f'#usda 1.0\ndef "a" (\n    references = {target}\n)\n{{\n}}\n')
    (tmp_path / "between.usda").write_text("#usda 1.0\n(\n    subLayers = [@pipe.usda@]\n)\n")
    of_layer = where.startswith("subLayers")
    own = where if of_layer else ""
    head = f'#usda 1.0\n(\n    expressionVariables = {{\n        string N = "pipe"\n    }}\n    {own}\n)\n'
    (tmp_path / "stage.usda").write_text(head + ("" if of_layer else f'def "a" (\n    {where}\n)\n{{\n    double v\n}}\n'))
    # Opening a pipe without a writer blocks; with one at hand that says nothing a failing test ends.
    keepers = [os.open(pipe, os.O_RDWR | os.O_NONBLOCK) for pipe in pipes]
    try:
        status, said = run(capsys, "record", str(tmp_path / "stage.usda"), str(tmp_path / "a.png"), "-w", "4", "--samples", "1",
                           "--quiet")
    finally:
        for keeper in keepers:
            os.close(keeper)
    assert status == 1 and re.search(r"pipe(\.1)?\.usd[az] is no regular file$", said) and len(said.splitlines()) == 1


@pytest.mark.parametrize("arguments, said", [(("--display", "tube"), "--display: there is no display 'tube' (there are: sRGB"),
                                             (("--view", "filmic"), "--view: there is no view 'filmic' (there are: Standard")])
def test_a_display_that_there_is_not_is_told_before_rendering(arguments, said, stage, tmp_path, monkeypatch, capsys):
    monkeypatch.delenv("OCIO", raising=False)
    rendered = []
    monkeypatch.setattr(record._Job, "render", lambda *_: rendered.append(True))
    command = ["record", stage, str(tmp_path / "a.png"), *arguments]
    assert main.main(command) == 1
    assert said in capsys.readouterr().err and not rendered
    assert main.main([*command, "--colorCorrectionMode", "disabled"]) == 0 and rendered
