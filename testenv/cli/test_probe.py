# SPDX-License-Identifier: Apache-2.0
"""An optional library that is there but does not compile is left out with one line, and the build goes on."""
import os
import subprocess

import pytest

CMAKE = os.path.normpath(os.path.join(os.path.dirname(__file__), "..", "..", "cmake"))
PROJECT = """cmake_minimum_required(VERSION 3.20)
project(probed LANGUAGES CXX)
include({cmake}/probe.cmake)
set(Thing_FOUND ON)
add_library(Thing::thing INTERFACE IMPORTED)
set_target_properties(Thing::thing PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${{CMAKE_SOURCE_DIR}}/include)
patina_probe(Thing ${{CMAKE_SOURCE_DIR}}/thing.cpp "pictures of things" LIBS Thing::thing)
message(STATUS "found: ${{Thing_FOUND}}")
"""


@pytest.fixture
def configure(tmp_path):
    (tmp_path / "include").mkdir()
    (tmp_path / "CMakeLists.txt").write_text(PROJECT.format(cmake=CMAKE))
    (tmp_path / "thing.cpp").write_text("#include <thing.h>\nint main() { return thing; }\n")

    def run(header):
        (tmp_path / "include" / "thing.h").write_text(header)
        done = subprocess.run(["cmake", "-G", "Ninja", "-S", str(tmp_path), "-B", str(tmp_path / "build")], capture_output=True,
                              text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


def test_a_header_that_misses_another_leaves_the_library_out_until_it_compiles(configure):
    output = configure("#include <boost/that/is/not/there.hpp>\n")
    line = next(line for line in output.splitlines() if "Left out" in line)
    assert "pictures of things" in line and "boost/that/is/not/there.hpp" in line and "found: OFF" in output
    output = configure("constexpr int thing = 0;\n")
    assert "Left out" not in output and "found: ON" in output


def test_the_projects_own_probes_include_what_its_sources_include():
    root = os.path.dirname(CMAKE)
    for probe, source in (("OpenVDB.cpp", "hdDelegate/image/fieldReader/readField.cpp"),
                          ("EGL.cpp", "hdDelegate/raster/gl/eglPlatform.cpp")):
        wanted = [line.strip() for line in open(os.path.join(root, source), encoding="utf-8")
                  if line.startswith(("#include <openvdb/", "#include <EGL/", "#include <GL/"))]
        probed = open(os.path.join(CMAKE, "probes", probe), encoding="utf-8").read()
        assert wanted and all(line in probed for line in wanted)
