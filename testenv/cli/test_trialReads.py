# SPDX-License-Identifier: Apache-2.0
"""A process that may die reads headers of images with an ICC profile first, with `--limit untriedBytes=0` stage and images
(SECURITY.md)."""
import contextlib
import glob
import os
import select
import shutil
import signal
import stat
import subprocess
import sys

import _patina
import numpy as np
import pytest

import inProcess
from patina.cli import tryStage
from test_limits import HEAD, quad, textured

FLAGS = ("-w", 8, "--samples", 1, "--camera", "/camera")
KILL = "os.kill(os.getpid(), 11)"
_OPENS = "stage = Usd.Stage.Open(sys.argv[1])"
UNTRIED = ("--limit", "untriedBytes=0")
KILLERS = sorted(glob.glob(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "fuzz", "corpus", "libraries", "*")))


@pytest.fixture(name="stage")
def _stage(tmp_path):
    stage = tmp_path / "stage.usda"
    stage.write_text(HEAD + textured() + quad("a", bind="m"))
    _patina.write_image(str(tmp_path / "t.png"), np.full((4, 4, 3), 0.5, np.float32), ["R", "G", "B"])
    return stage


def recorded(stage, image, *flags, **options):
    """Records in a process of its own. :returns: what it says"""
    command = [sys.executable, "-m", "patina", "record", stage, image, *FLAGS, *flags]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, done.stderr
    return done.stderr


def test_sound_files_make_the_same_image(stage, tmp_path):
    for name, flags in (("a", ()), ("b", UNTRIED)):
        done = inProcess.record(stage, tmp_path / f"{name}.exr", *FLAGS, *flags, check=False)
        assert done.returncode == 0 and "warning" not in done.stderr, done.stderr
    assert np.array_equal(*(inProcess.pixels(tmp_path / f"{name}.exr") for name in "ab"))


@pytest.fixture(name="dying")
def _dying(tmp_path):
    """:returns: an environment whose Patina tries images by a program that a file of some name kills"""
    folder = tmp_path / "module"
    folder.mkdir()
    for file in glob.glob(os.path.join(os.path.dirname(_patina.__file__), "*")):
        if os.path.isfile(file) and not file.endswith("patinaTryImage"):
            os.symlink(file, folder / os.path.basename(file))
    library = folder / os.path.basename(_patina.__file__)
    library.unlink()
    shutil.copy(_patina.__file__, library)  # the program is looked for beside it
    program = folder / "patinaTryImage"
    program.write_text(f"#!{sys.executable}\nimport os\nname = b''\nwhile byte := os.read(0, 1):\n"
                       "    name += byte\n    if byte == b'\\0':\n        if b't.png' in name:\n"
                       f"            {KILL}\n        os.write(1, b't')\n        name = b''\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    return dict(os.environ, PYTHONPATH=f"{folder}:{os.environ['PYTHONPATH']}")


def test_an_image_that_kills_its_reader_is_left_out(stage, dying, tmp_path):
    said = recorded(stage, tmp_path / "a.exr", *UNTRIED, env=dying)
    assert "makes OpenImageIO fail (Segmentation fault)" in said and "/m/t" in said
    assert inProcess.pixels(tmp_path / "a.exr").max() > 0


@pytest.mark.parametrize("flags", [(), UNTRIED], ids=["default", "untried"])
@pytest.mark.parametrize("file", KILLERS, ids=os.path.basename)
def test_images_that_kill_some_libraries_harm_nobody(stage, file, tmp_path, flags):
    """Readers of formats die of them, depending on their versions."""
    shutil.copy(file, tmp_path / "t.png")
    done = inProcess.record(stage, tmp_path / "a.exr", *FLAGS, *flags, check=False)
    assert done.returncode == 0 and os.path.exists(tmp_path / "a.exr"), done.stderr


def test_images_with_a_profile_are_read_where_no_program_tries_them(stage, dying, tmp_path):
    corpus = os.path.join(os.path.dirname(KILLERS[0]), "..", "texture")
    shutil.copy(os.path.join(corpus, "soundProfileJpg"), tmp_path / "t.png")
    for file in ("a", "b"):
        said = recorded(stage, tmp_path / f"{file}.exr", env=dying)
        assert ("makes OpenImageIO fail (Segmentation fault)" in said) is (file == "a")
        program = os.path.join(dying["PYTHONPATH"].split(":")[0], "patinaTryImage")
        with open(program, "w", encoding="utf-8") as script:
            script.write("#!/nowhere/at/all\n")


@pytest.mark.parametrize("flag", [None, "--layer", "--sessionLayer"])
def test_a_file_that_kills_its_reader_is_refused(stage, tmp_path, monkeypatch, flag):
    """A stage, or a layer beside it. Small files are trusted by default."""
    layer = tmp_path / "layer.usda"
    layer.write_text("#usda 1.0\n")
    killer, flags = (layer, (flag, layer)) if flag else (stage, ())
    monkeypatch.setattr(tryStage, "_READ", f"import os, sys\nif sys.argv[1].endswith('{killer.name}'):\n    {KILL}")
    assert inProcess.record(stage, tmp_path / "a.exr", *FLAGS, *flags, check=False).returncode == 0
    done = inProcess.record(stage, tmp_path / "b.exr", *FLAGS, *flags, *UNTRIED, check=False)
    assert done.returncode == 1
    assert f"{killer} makes OpenUSD fail (Segmentation fault): the file is damaged" in done.stderr
    assert not (tmp_path / "b.exr").exists()


def test_an_image_that_takes_all_memory_is_left_out(stage, tmp_path):
    (tmp_path / "t.png").unlink()
    (tmp_path / "t.ppm").write_bytes(b"P6 268435456 4 65535\n")  # rows of 1.6 GB, of which the file has none
    stage.write_text(stage.read_text().replace("t.png", "t.ppm"))
    said = recorded(stage, tmp_path / "a.exr", *UNTRIED, "--limit", "textureBytes=1000")
    assert "takes more memory than the limit textureBytes allows" in said and "/m/t" in said


def test_a_forked_process_tries_images_by_a_program_of_its_own(stage):
    """Both hold the socket of the first program: with that alone, answers could change places."""
    shutil.copy(stage.with_name("t.png"), stage.with_name("u.png"))
    script = f"""
import os, psutil, _patina
def programs():
    return [child.pid for child in psutil.Process().children() if child.name().startswith("patinaTry")]
_patina.set_limits({{"untriedBytes": 0}})
_patina.read_image({str(stage.with_name("t.png"))!r})
first = programs()
child = os.fork()
if child == 0:
    _patina.read_image({str(stage.with_name("u.png"))!r})
    os._exit(len(programs()))
assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 1, "the child has no program"
assert len(first) == 1 and programs() == first, "the parent's program is gone"
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.fixture
def untrusted(monkeypatch):
    """All files are tried."""
    monkeypatch.setattr(tryStage.limits, "value", lambda _: 0)


@pytest.mark.parametrize("dies", ("raise MemoryError", "sys.stderr.write('std::bad_alloc'); sys.stderr.flush(); os.abort()"))
def test_a_stage_that_takes_all_memory_is_refused(stage, untrusted, monkeypatch, dies):
    """The limit reaches OpenUSD's own threads, too, which end the process."""
    monkeypatch.setattr(tryStage, "_READ", tryStage._READ.replace(
        _OPENS, f"assert resource.getrlimit(resource.RLIMIT_DATA)[0] == int(sys.argv[2]); {dies}"))
    gigabytes = tryStage._MEMORY * os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 1e9
    assert tryStage.why_trial_fails(str(stage)) == f"takes more than {gigabytes:.1f} GB of memory: {tryStage._TOO_MUCH}"


def test_a_stage_that_takes_too_long_is_refused(stage, untrusted, monkeypatch):
    """Sound ones may, too, by their size."""
    monkeypatch.setattr(tryStage, "_SECONDS", 0)
    monkeypatch.setattr(tryStage, "_READ", "import signal\nsignal.pause()")
    assert tryStage.why_trial_fails(str(stage)) == f"is not read by OpenUSD within 0 s: {tryStage._TOO_MUCH}"


def test_the_process_that_tries_a_stage_ends_by_itself(stage, untrusted, monkeypatch):
    """Its parent may be gone, or be held."""
    monkeypatch.setattr(tryStage, "_SECONDS", 1000)
    monkeypatch.setattr(tryStage, "_READ", tryStage._READ.replace(_OPENS, "assert 900 < signal.alarm(0) <= 1001; os.abort()"))
    assert "makes OpenUSD fail (Aborted)" in tryStage.why_trial_fails(str(stage))


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks Linux for it")
def test_the_process_that_tries_a_stage_ends_with_its_parent(stage, tmp_path):
    os.mkfifo(tmp_path / "pipe")
    program = f"""
from patina.cli import tryStage
tryStage.limits.value = lambda _: 0
opens = {_OPENS!r}
tryStage._READ = tryStage._READ.replace(opens, "import signal; pipe = open({str(tmp_path / 'pipe')!r}, 'w'); "
                                               "print(os.getpid(), file=pipe, flush=True); signal.pause()")
tryStage.why_trial_fails({str(stage)!r})
"""
    parent = subprocess.Popen([sys.executable, "-c", program])
    with open(tmp_path / "pipe", encoding="utf-8") as pipe:
        child = int(pipe.readline())
        parent.kill()
        parent.wait()
        try:
            assert select.select([pipe], [], [], 30)[0] and pipe.read() == ""  # nobody holds it any more
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.kill(child, signal.SIGKILL)


def test_a_broken_stage_gets_its_own_message(tmp_path):
    stage = tmp_path / "broken.usda"
    stage.write_text("#usda 1.0\ndef {\n")
    done = inProcess.record(stage, tmp_path / "a.exr", *FLAGS, *UNTRIED, check=False)
    assert done.returncode == 1 and "cannot be opened" in done.stderr


def test_modules_beside_the_stage_are_not_run(stage, untrusted, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("PYTHONSAFEPATH", raising=False)
    (tmp_path / "resource.py").write_text("import pathlib\npathlib.Path('ran').touch()\n")
    assert tryStage.why_trial_fails(str(stage)) == "" and not os.path.exists("ran")
