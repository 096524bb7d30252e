# SPDX-License-Identifier: Apache-2.0
"""What the build of a package does beside compiling, step by step."""
import email
import os
import shutil
import subprocess
import sys

import pytest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", ".."))
BUILD = os.environ.get("PATINA_BUILD_DIR", "")

# Stand-ins, so that nothing is fetched.
NPM = "[ $1 = ci ] && [ -f package-lock.json ] && mkdir -p node_modules/esbuild/bin"
NODE = 'for word in "$@"; do case $word in --outfile=*) echo "the page" >"${word#--outfile=}" ;; esac; done'
OFFLINE = "echo 'npm error network' >&2; exit 1"
BROKEN = "echo 'main.js: no such export' >&2; exit 1"


@pytest.fixture
def programs(tmp_path):
    """:returns: a function of what node and npm are to do, which gives an environment that finds these"""
    def make(node=NODE, npm=NPM):
        folder = tmp_path / "programs"
        folder.mkdir()
        for name, text in (("node", node), ("npm", npm)):
            (folder / name).write_text(f"#!/bin/sh\n{text}\n")
            (folder / name).chmod(0o755)
        return {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "PATINA_VIEW_CACHE": str(tmp_path / "cache"),
                "PYTHONPATH": os.path.join(ROOT, "plugin")}
    return make


def bundle(out, environment):
    # The module is not compiled yet, also where this Python has another one.
    program = ("import sys; sys.modules['_patina'] = None; import runpy; "
               "runpy.run_module('patina.view.bundle', run_name='__main__')")
    return subprocess.run([sys.executable, "-c", program, str(out)], env=environment, capture_output=True, text=True)


def cmake(*words, environment=None):
    if not shutil.which("cmake") or not os.path.exists(os.path.join(BUILD, "CMakeCache.txt")):
        pytest.skip("there is no build that could be installed")
    return subprocess.run(["cmake", *map(str, words)], env=environment, capture_output=True, text=True)


def test_the_page_is_made_before_the_module_is_compiled(programs, tmp_path):
    environment = programs()
    for i in range(2):  # of the same packages, and of what was kept
        done = bundle(tmp_path / f"{i}.js", environment)
        assert done.returncode == 0, done.stderr
        assert (tmp_path / f"{i}.js").read_text() == "the page\n"


def test_a_package_made_without_a_network_says_what_it_lacks(programs, tmp_path):
    done = bundle(tmp_path / "page.js", programs(npm=OFFLINE))
    assert done.returncode == 0 and "no script of the material page" in done.stderr and "npm error network" in done.stderr
    assert not (tmp_path / "page.js").exists()


def test_a_page_that_cannot_be_made_ends_the_build(programs, tmp_path):
    done = bundle(tmp_path / "page.js", programs(node=BROKEN))
    assert done.returncode != 0 and "no such export" in done.stderr and not (tmp_path / "page.js").exists()
    assert not list((tmp_path / "cache").rglob("page*"))


def test_the_build_makes_the_page(programs):
    script = os.path.join(BUILD, "package", "page.js")
    if os.path.exists(script):
        pytest.skip("this build has made its page")
    done = cmake("--build", BUILD, "--target", "pageScript", environment=programs())
    try:
        assert done.returncode == 0, done.stdout + done.stderr
        with open(script, encoding="utf-8") as file:
            assert file.read() == "the page\n"
    finally:
        if os.path.exists(script):
            os.remove(script)


def has_library():
    return os.path.exists(os.path.join(BUILD, "lib", "libpatina.so"))


def test_nothing_is_installed_without_the_library(tmp_path):
    if has_library():
        pytest.skip("this build has made its library")
    done = cmake("--install", BUILD, "--prefix", tmp_path / "prefix")
    said = " ".join(done.stderr.split())  # CMake breaks lines where a path was long
    assert done.returncode != 0 and "The library is not built" in said and "--target patina" in said
    assert not (tmp_path / "prefix").exists()


def test_the_command_is_installed(tmp_path):
    part = () if has_library() else ("--component", "Unspecified")
    done = cmake("--install", BUILD, *part, "--prefix", tmp_path)
    assert done.returncode == 0, done.stderr
    for name in ("patina/tables/hdDelegate/scene/settings.def", "patina/view/web/src/main.js", "_patina.pyi"):
        assert (tmp_path / "lib/patina/python" / name).exists(), name
    assert not list(tmp_path.rglob("node_modules")) and not list(tmp_path.rglob("__pycache__"))
    environment = {"PATH": os.environ["PATH"], "PATINA_PYTHON": sys.executable}
    done = subprocess.run([tmp_path / "bin" / "patina", "bsdf", "eval", "library:gold", "--wo", "0,0,1", "--wi", "0,0,1"],
                          env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_a_wheel_with_its_libraries_asks_for_the_denoiser(tmp_path):
    from patina.cli import wholeWheel

    info = tmp_path / "hdPatina-0.1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: hdPatina\nVersion: 0.1.0\nProvides-Extra: denoise\n"
                                   "Requires-Dist: pyoidn; extra == \"denoise\"\n\nText.\nName: no header\n")
    wholeWheel.require_denoiser(str(tmp_path))
    metadata = email.message_from_string((info / "METADATA").read_text())
    assert metadata.get_all("Requires-Dist") == ["pyoidn", 'pyoidn; extra == "denoise"']
    assert metadata["Name"] == "hdPatina" and metadata.get_payload() == "Text.\nName: no header\n"


def test_packages_hold_hydras_plugin_only_for_an_openusd_of_the_system():
    config = os.path.join(BUILD, "CPackConfig.cmake")
    if not os.path.exists(config):
        pytest.skip("there is no build that could be packed")
    with open(os.path.join(BUILD, "CMakeCache.txt"), encoding="utf-8") as file:
        found = next((line.split("=", 1)[1].strip() for line in file if line.startswith("PATINA_PXR_CONFIG:")), "")
    with open(config, encoding="utf-8") as file:
        projects = next(line for line in file if line.startswith("set(CPACK_INSTALL_CMAKE_PROJECTS ")).split('"')[1]
    components = projects.split(";")[2::4]
    if not os.path.exists(os.path.join(BUILD, "hydra.json")) or found.startswith("/usr/") and "/local/" not in found:
        assert components == ["ALL"]
    else:
        assert components == ["Unspecified", "library"]
