# SPDX-License-Identifier: Apache-2.0
"""The files of `cmake --install` are enough: for a host in C++ that finds Patina by find_package, and for the command."""
import os
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest

import _patina

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", ".."))
HOST = os.path.join(ROOT, "docs", "examples", "host")
BUILD = os.environ.get("PATINA_BUILD_DIR", "")


def run(*command, **keywords):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **keywords)
    assert done.returncode == 0, f"{' '.join(map(str, command))}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
    return done.stdout


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    """:returns: a folder into which this build is installed"""
    if not shutil.which("cmake") or not os.path.exists(os.path.join(BUILD, "CMakeCache.txt")):
        pytest.skip("there is no build that could be installed")
    run("cmake", "--build", BUILD, "--target", "patina", "_patina")  # the library is linked from what is there
    folder = tmp_path_factory.mktemp("installed")
    run("cmake", "--install", BUILD, "--prefix", folder)
    return folder


@pytest.fixture(scope="module")
def host(prefix, tmp_path_factory):
    """:returns: the example, built outside of the checkout"""
    folder = tmp_path_factory.mktemp("host")
    run("cmake", "-S", HOST, "-B", folder, f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", folder)
    return folder / "host"


def test_a_host_in_cpp_renders_what_the_module_renders(host, tmp_path):
    run(host, tmp_path / "host.exr")
    scene = _patina.Scene()
    with scene.edit() as edit:
        network = _patina.Network("/red")
        network.add_node("/red/bsdf", "ND_oren_nayar_diffuse_bsdf")
        network.set_input("/red/bsdf", "color", "color3", [0.8, 0.1, 0.05])
        network.add_node("/red/surface", "ND_surface")
        network.connect("/red/surface", "bsdf", "/red/bsdf")
        network.set_terminal("surface", "/red/surface")
        edit.set_material("/red", network)
        edit.set_implicit("/ball", shape="sphere", material="/red")
        edit.set_light("/sky", type="dome")
        place = np.eye(4)
        place[3, 2] = 8.0
        edit.set_camera("/camera", transform=place)
    film = _patina.Film()
    renderer = _patina.make_renderer("embree")
    renderer.start(scene, "/camera", {"width": 64, "height": 48, "samples": 16}, film)
    renderer.wait()
    assert not renderer.progress()["failed"] and scene.warnings() == []
    ours, theirs = np.array(film.resolve("color")), np.array(_patina.read_image(str(tmp_path / "host.exr")).pixels)
    assert np.array_equal(ours, theirs[..., :3]) and ours[24, 32, 0] > 4.0 * ours[24, 32, 2]  # a red ball


def test_the_host_is_as_short_as_it_says(host):
    with open(os.path.join(HOST, "host.cpp")) as file:
        assert len(file.readlines()) <= 60
    done = subprocess.run([host], capture_output=True, text=True)
    assert done.returncode == 2 and done.stderr == "host IMAGE [BACKEND]\n"


def test_the_installed_command_needs_no_checkout(prefix, tmp_path):
    (tmp_path / "stage.usda").write_text('#usda 1.0\ndef Sphere "ball"\n{\n}\n')
    environment = {"PATH": os.environ["PATH"], "HOME": str(tmp_path), "PATINA_PYTHON": sys.executable}
    command = prefix / "bin" / "patina"
    assert re.fullmatch(r"patina \d+\.\d+\.\d+\n", run(command, "--version", env=environment))
    run(command, "record", "stage.usda", "a.png", "-w", "16", "--samples", "2", "--report", "a.html", "--quiet", cwd=tmp_path,
        env=environment)
    assert _patina.read_image(str(tmp_path / "a.png")).width == 16
    page = (tmp_path / "a.html").read_text()
    assert ROOT not in page and "patina record stage.usda" in page
    module = next((prefix / "lib").rglob("_patina*.so")).parent
    assert (module / "_patina.pyi").exists() and (module / "patina" / "py.typed").exists()  # for type checkers
    link = tmp_path / "linked"
    link.symlink_to(command)
    run(link, "explain", "--help", env=environment)


def test_what_is_installed_names_no_folder_of_the_build(prefix):
    for name in ("lib/cmake/Patina/PatinaConfig.cmake", "lib/cmake/Patina/patinaTargets.cmake", "bin/patina"):
        found = list(prefix.glob(name)) or list(prefix.glob(name.replace("lib/", "lib/*/", 1)))
        assert found, name
        text = found[0].read_text()
        assert ROOT not in text and BUILD not in text


def test_presets_are_those_that_the_page_names(tmp_path):
    with open(os.path.join(ROOT, "docs", "install.md"), encoding="utf-8") as file:
        section = file.read().split("## Presets")[1].split("\n## ")[0]
    named = {name for row in re.findall(r"^\| (`[^|]*) \|", section, re.MULTILINE) for name in re.findall(r"`(\w+)`", row)}
    listed = set(re.findall(r'^  "(\w+)"', run("cmake", "--list-presets", cwd=ROOT), re.MULTILINE))
    assert named == listed and {"dev", "release", "portable", "asan", "tsan"} <= listed
