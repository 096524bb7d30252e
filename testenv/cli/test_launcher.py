# SPDX-License-Identifier: Apache-2.0
"""The launcher decides rightly what to install and what to build. Its tools are stand-ins that note
that they were called."""
import os
import re
import shutil
import stat
import subprocess
import sys
import time

import pytest

ROOT = os.path.normpath(os.path.join(os.path.dirname(__file__), "..", ".."))
FOLDERS = ("cmake", "base", "shaders", "materialNetwork", "hdDelegate/scene/tests", "plugin/python")

CMAKE = """#!/bin/sh
echo "cmake $*" >> "$CALLS"
case $* in
*--build*) [ -z "$BUILD_FAILS" ] || { echo 'a.cpp:1: error: broken'; exit 1; } ;;
*) echo "CMAKE_HOME_DIRECTORY:INTERNAL=$ROOT" > "$ROOT/build/CMakeCache.txt" ;;
esac
"""
# Stands for the environment's Python: says what it was given instead of running it.
PYTHON = """#!/bin/sh
case $1 in
-c) exit 0 ;;
-m) [ "$2" = pip ] && { echo "pip $*" >> "$CALLS"; exit 0; } ;;
esac
echo "ran $*"
"""


def write(path, text, program=False):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    if program:
        path.chmod(path.stat().st_mode | stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH)


@pytest.fixture
def checkout(tmp_path):
    return Checkout(tmp_path / "a checkout", tmp_path / "calls", tmp_path / "tools")


class Checkout:
    def __init__(self, root, calls, tools):
        self.root, self.calls, self.tools = root, calls, tools
        for folder in FOLDERS:
            write(root / folder / "a.txt", "text")
        requirements = [name for name in os.listdir(ROOT) if name.startswith("requirements")]
        for name in ("patina", "CMakeLists.txt", *requirements):
            shutil.copy(os.path.join(ROOT, name), root / name)
        write(root / ".venv" / "bin" / "python", PYTHON, program=True)
        write(tools / "cmake", CMAKE, program=True)
        self.say_installed(everything=True)
        write(tools / "id", "#!/bin/sh\necho 1000\n", program=True)
        write(tools / "sudo", "#!/bin/sh\nexit 1\n", program=True)
        write(tools / "apt-get", '#!/bin/sh\necho "apt-get $*" >> "$CALLS"\n', program=True)
        past = time.time() - 100  # sources are older than the first build
        for folder, folders, files in os.walk(root):
            for name in [*folders, *files, "."]:
                os.utime(os.path.join(folder, name), (past, past))

    def say_installed(self, everything):
        echo = 'shift 2; for p in "$@"; do echo "installed $p"; done' if everything else "exit 1"
        write(self.tools / "dpkg-query", f"#!/bin/sh\n{echo}\n", program=True)

    def run(self, *arguments, program=None, **environment):
        """:returns: the process, and the commands that were called"""
        self.calls.write_text("")
        variables = {"PATH": f"{self.tools}:{os.environ['PATH']}", "CALLS": str(self.calls), "ROOT": str(self.root),
                     "HOME": str(self.root), **environment}
        process = subprocess.run([str(program or self.root / "patina"), *arguments], capture_output=True, text=True,
                                 env=variables, stdin=subprocess.DEVNULL, cwd="/")
        return process, self.calls.read_text().splitlines()


def builds(calls):
    return [call for call in calls if call.startswith("cmake --build")]


def test_first_call_sets_up_and_the_second_only_runs(checkout):
    process, calls = checkout.run("record", "a b.usda", "c.png")
    assert process.returncode == 0, process.stderr
    assert process.stdout == "ran -m patina record a b.usda c.png\n"
    assert any(call.startswith("pip") for call in calls)
    assert len(builds(calls)) == 1 and "--target _patina" in builds(calls)[0]
    process, calls = checkout.run("record", "x")
    assert calls == [] and process.stdout == "ran -m patina record x\n" and process.stderr == ""


def test_a_changed_source_is_built_again(checkout):
    checkout.run("record")
    (checkout.root / "shaders" / "a.txt").write_text("other")
    assert len(builds(checkout.run("record")[1])) == 1
    assert builds(checkout.run("record")[1]) == []


def test_a_removed_and_an_added_source_are_noticed(checkout):
    checkout.run("record")
    (checkout.root / "shaders" / "a.txt").unlink()
    assert len(builds(checkout.run("record")[1])) == 1
    (checkout.root / "materialNetwork" / "new.cpp").write_text("")
    assert len(builds(checkout.run("record")[1])) == 1


@pytest.mark.parametrize("command, status, name, said", [
    ("record", 75, "INT", "interrupted"), ("merge", 75, "TERM", "terminated"), ("farm", 75, "HUP", "ended with its terminal"),
    ("denoise", 75, "INT", "interrupted"), ("explain", 1, "INT", "interrupted")])
def test_a_signal_ends_it_as_it_would_end_the_command(checkout, command, status, name, said):
    """It comes while the launcher waits for a program."""
    checkout.run("record")
    write(checkout.tools / "cmp", f'#!/bin/sh\nkill -{name} $PPID\nPATH=/usr/bin:/bin cmp "$@"\n', program=True)
    process, calls = checkout.run(command)
    assert (process.returncode, process.stdout, process.stderr) == (status, "", f"patina: {said}\n") and calls == []


def test_tests_are_built_for_test_only(checkout):
    checkout.run("record")
    (checkout.root / "hdDelegate" / "scene" / "tests" / "a.txt").write_text("other")
    assert checkout.run("record")[1] == []
    calls = checkout.run("test")[1]
    assert "--target all" in builds(calls)[0] and any("PATINA_BUILD_TESTS=ON" in call for call in calls)
    assert checkout.run("test")[1] == []
    assert checkout.run("record")[1] == []


def test_another_openusd_is_built_for(checkout):
    checkout.run("test")
    assert checkout.run("test")[1] == []
    assert len(builds(checkout.run("test", PXR_USD_LOCATION="/opt/USD")[1])) == 1
    (checkout.root / "build" / "CMakeCache.txt").write_text("PATINA_PXR_ASKED:INTERNAL=/opt/USD\n")
    assert checkout.run("test", PXR_USD_LOCATION="/opt/USD")[1] == []
    assert len(builds(checkout.run("test", PXR_USD_LOCATION="/opt/USD2")[1])) == 1
    assert checkout.run("record", PXR_USD_LOCATION="/opt/USD2")[1] == []


def test_other_requirements_are_installed(checkout):
    checkout.run("record")
    (checkout.root / "requirements.txt").write_text("numpy\n")
    calls = checkout.run("record")[1]
    assert any(call.startswith("pip") for call in calls)


def test_missing_packages_without_root_are_named_and_the_build_goes_on(checkout):
    checkout.say_installed(everything=False)
    process, calls = checkout.run("record")
    assert process.returncode == 0
    assert "libembree-dev" in process.stderr and "apt-get install" in process.stderr
    assert not any(call.startswith("apt-get") for call in calls) and len(builds(calls)) == 1


def test_missing_packages_are_installed_by_root(checkout):
    checkout.say_installed(everything=False)
    write(checkout.tools / "id", "#!/bin/sh\necho 0\n", program=True)
    calls = checkout.run("record")[1]
    installs = [call for call in calls if call.startswith("apt-get install")]
    assert len(installs) == 1 and "--no-install-recommends" in installs[0] and "libembree-dev" in installs[0]


def test_a_failed_build_says_why_and_is_tried_again(checkout):
    process, calls = checkout.run("record", BUILD_FAILS="1")
    assert process.returncode == 1 and "error: broken" in process.stderr and "ran" not in process.stdout
    assert len(builds(checkout.run("record")[1])) == 1


# Makes an environment as `python -m venv --clear` does, which removes all that is in the folder.
VENV = """#!/bin/sh
case $1-$2 in
-m-venv) echo "venv $4" >> "$CALLS"; rm -rf "$4"; mkdir -p "$4/bin"; [ -z "$VENV_FAILS" ] || exit 1
    cp "$ROOT/.venv/bin/python" "$4/bin/python" ;;
esac
"""


def set_up(checkout, folder, **environment):
    """:returns: the process, and the folders that environments were made in"""
    write(checkout.tools / "base", VENV, program=True)
    process, calls = checkout.run("record", PATINA_VENV=str(folder), PATINA_PYTHON=str(checkout.tools / "base"), **environment)
    return process, [call[len("venv "):] for call in calls if call.startswith("venv ")]


@pytest.mark.parametrize("files", [("keep.txt",), ("keep.txt", "pyvenv.cfg", "bin/python3"), (".hidden",)])
def test_a_folder_of_others_is_not_made_an_environment(checkout, tmp_path, files):
    folder = tmp_path / "their folder"
    for file in files:
        write(folder / file, "theirs")
    process, made = set_up(checkout, folder)
    assert process.returncode == 1 and made == []
    assert process.stderr.endswith(f"patina: PATINA_VENV ({folder}) is not empty and not Patina's own; name another folder\n")
    assert all((folder / file).read_text() == "theirs" for file in files) and not (folder / ".patina").exists()


@pytest.mark.parametrize("there", [False, True])
def test_a_new_or_empty_folder_is_made_an_environment_and_once_more_when_it_breaks(checkout, tmp_path, there):
    folder = tmp_path / "other"
    if there:
        folder.mkdir()
    process, made = set_up(checkout, folder, VENV_FAILS="1")
    assert process.returncode == 1 and made == [str(folder)] and "cannot make a Python environment" in process.stderr
    process, made = set_up(checkout, folder)
    assert process.returncode == 0 and made == [str(folder)], process.stderr
    (folder / "bin" / "python").unlink()
    process, made = set_up(checkout, folder)
    assert process.returncode == 0 and made == [str(folder)], process.stderr
    assert set_up(checkout, folder)[1] == []


def test_the_checkouts_own_environment_is_made_again(checkout):
    shutil.move(checkout.root / ".venv" / "bin" / "python", checkout.tools / "kept")
    write(checkout.root / ".venv" / "lib" / "half.py", "")
    write(checkout.tools / "base", VENV.replace("$ROOT/.venv/bin/python", "${0%/*}/kept"), program=True)
    process, calls = checkout.run("record", PATINA_PYTHON=str(checkout.tools / "base"))
    assert process.returncode == 0 and f"venv {checkout.root}/.venv" in calls, process.stderr


def test_help_needs_no_build(checkout):
    process, calls = checkout.run("record", "--help")
    assert process.returncode == 0 and calls == [] and "ran -m patina record --help" in process.stdout


def test_it_is_found_through_a_link(checkout, tmp_path):
    checkout.run("record")
    os.symlink(checkout.root / "patina", tmp_path / "link")
    process, _ = checkout.run("compare", program=tmp_path / "link")
    assert process.stdout == "ran -m patina compare\n"


def test_relative_folders_are_meant_from_where_it_is_called(checkout, tmp_path):
    """Commands change folders themselves, and give the build's place to other processes."""
    write(tmp_path / "tools" / "cmake", '#!/bin/sh\necho "cmake $*" >> "$CALLS"\n', program=True)
    write(checkout.root / ".venv" / "bin" / "python",
          PYTHON.replace('"ran $*"', '"$PATINA_BUILD_DIR:$PYTHONPATH"'), program=True)
    process, calls = checkout.run("record", PATINA_BUILD_DIR=str(tmp_path / "other")[1:],
                                  PATINA_VENV=str(checkout.root / ".venv")[1:])
    assert process.stdout == f"{tmp_path}/other:{checkout.root}/plugin:{tmp_path}/other/python\n", process.stderr
    assert f"cmake --build {tmp_path}/other" in builds(calls)[0]


@pytest.mark.parametrize("command", ["compare", "chart"])
def test_what_a_command_needs_is_installed_by_it(checkout, command):
    calls = checkout.run("record")[1]
    assert not any("requirements-compare.txt" in call for call in calls)
    calls = checkout.run(command, "a.exr", "b.exr")[1]
    assert any(call.startswith("pip") and "requirements-compare.txt" in call for call in calls)
    assert checkout.run(command, "a.exr", "b.exr")[1] == []


def test_what_is_left_out_is_told_once_it_is_known(checkout):
    write(checkout.tools / "cmake", CMAKE.replace("*) echo", '*) echo "-- Left out: volumes (no headers)"; echo'), program=True)
    assert "patina: Left out: volumes (no headers)" in checkout.run("record")[0].stderr


@pytest.mark.parametrize("words, requirements", [
    (("record", "a", "b", "--denoise"), "denoise"), (("farm", "a", "b", "--denoise"), "denoise"),
    (("merge", "a", "b"), "denoise"), (("farm", "a", "b"), "farm"),
    (("shader", "a.mtlx", "--target", "osl"), "shader"), (("shader", "a.mtlx", "--target=mdl"), "shader"),
    (("python", "-m", "distributed.cli.dask_scheduler"), "farm"), (("python", "-m", "pytest", "a"), "test")])
def test_arguments_may_need_more(checkout, words, requirements):
    checkout.run("record")
    assert any(f"requirements-{requirements}.txt" in call for call in checkout.run(*words)[1])
    assert checkout.run(*words)[1] == []


@pytest.mark.parametrize("arguments, wanted", [
    (("test",), "browser cluster compare denoise farm jobs shader test"),
    (("test", "-k", "furnace"), "browser cluster compare denoise farm jobs shader test"),
    (("test", "--tier", "smoke"), "browser cluster compare denoise farm jobs shader test"),
    (("test", "--tier", "unit"), "compare denoise test"),
    (("test", "--tier=unit", "--room", "shaders"), "compare test"),
    (("test", "--room", "shaders"), "compare test"),
    (("test", "--room=view"), "browser compare test"),
    (("test", "--room", "farm", "--tier", "full"), "cluster compare denoise farm jobs test"),
    (("test", "--tier", "long"), "browser cluster compare denoise docs farm jobs long shader stubs test"),
    (("test", __file__ + "::test_x"), "browser cluster compare denoise docs farm jobs long shader stubs test"),
    (("bench", "path"), "long"), (("bench",), ""), (("bench", "denoise"), "compare denoise"),
    (("farm", "a.usda"), "cluster farm"),
    (("docs", "site"), "docs"), (("fuzz",), "fuzz"), (("shader", "a.mtlx", "--target", "glsl"), "")])
def test_only_what_is_used_is_installed(checkout, arguments, wanted):
    checkout.say_installed(everything=False)
    write(checkout.tools / "id", "#!/bin/sh\necho 0\n", program=True)
    calls = checkout.run(*arguments)[1]
    files = [re.search(r"requirements-(\w+)[.]txt", call) for call in calls if call.startswith("pip")]
    assert " ".join(sorted(file[1] for file in files if file)) == wanted
    assert any("chromium" in call for call in calls) == ("browser" in wanted)
    assert checkout.run(*arguments)[1] == []


# As before version 3.11, which is the first to know PYTHONSAFEPATH.
OLDER_PYTHON = f"""#!/bin/sh
exec env -u PYTHONSAFEPATH "{sys.executable}" "$@"
"""
HOSTILE = "import os; open(os.environ['RAN'], 'w').close()\n"


@pytest.fixture
def hostile(tmp_path):
    """:returns: a folder of modules that leave a mark where they are run, and the environment with an older Python"""
    for name in ("argparse", "json", "os", "patina", "random", "runpy", "venv", "ensurepip"):
        write(tmp_path / "hostile" / f"{name}.py", HOSTILE)
    write(tmp_path / "older", OLDER_PYTHON, program=True)
    return tmp_path / "hostile", {**os.environ, "RAN": str(tmp_path / "ran"), "PATINA_PYTHON": str(tmp_path / "older")}


def test_what_stands_for_an_older_python_would_run_them(hostile, tmp_path):
    folder, environment = hostile
    subprocess.run([environment["PATINA_PYTHON"], "-m", "patina", "--help"], cwd=folder, env=environment, check=False)
    assert (tmp_path / "ran").exists()


def test_the_installed_command_imports_nothing_of_the_current_folder(hostile, tmp_path):
    to_python = os.path.relpath(os.path.join(ROOT, "plugin"), tmp_path / "bin")
    with open(os.path.join(ROOT, "cmake", "package", "patina.in"), encoding="utf-8") as file:
        write(tmp_path / "bin" / "patina", file.read().replace("@toPython@", to_python), program=True)
    folder, environment = hostile
    help_ = subprocess.run([str(tmp_path / "bin" / "patina"), "record", "--help"], capture_output=True, text=True, check=True,
                           cwd=folder, env=environment).stdout
    assert "--samples" in help_ and not (tmp_path / "ran").exists()


def test_help_before_set_up_imports_nothing_of_the_current_folder(hostile, tmp_path):
    folder, environment = hostile
    help_ = subprocess.run([os.path.join(ROOT, "patina"), "record", "--help"], capture_output=True, text=True, check=True,
                           cwd=folder, env={**environment, "PATINA_VENV": str(tmp_path / "none")}).stdout
    assert "--samples" in help_ and not (tmp_path / "ran").exists()


def test_set_up_imports_nothing_of_the_current_folder(checkout, tmp_path):
    python, cmake = checkout.root / ".venv" / "bin" / "python", checkout.tools / "cmake"
    for path, text, name in ((python, PYTHON, "pip"), (cmake, CMAKE, "cmake")):
        write(path, text.replace(f'echo "{name}', f'echo "in $PWD" >> "$CALLS"; echo "{name}'), program=True)
    process, calls = checkout.run("record")
    places = {call for call in calls if call.startswith("in ")}
    assert places == {f"in {checkout.root}/build"} and "ran -m patina record" in process.stdout
