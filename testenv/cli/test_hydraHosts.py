# SPDX-License-Identifier: Apache-2.0
"""An OpenUSD inside of a program, made into one that a plugin can be built for."""
import os

import pytest

from patina.cli import hydraHosts
from patina.cli.errors import CommandError


@pytest.fixture
def program(tmp_path):
    """:returns: a function that makes a program's folder with one library"""
    def make(symbols=b"\0_ZN32pxrProgram_v25_08__pxrReserved__6TfType\0"):
        folder = tmp_path / "program"
        for name in ("lib/usd", "python/bin", "python/lib/python3.11/site-packages/pxr"):
            (folder / name).mkdir(parents=True)
        (folder / "lib/libusd_ms.so").write_bytes(symbols)
        (folder / "lib/libtbb.so.12").write_bytes(b"")
        (folder / "python/bin/python3.11").write_bytes(b"")
        (folder / "python/lib/python3.11/site-packages/pxr/__init__.py").write_text("")
        return folder
    return make


@pytest.fixture
def source(tmp_path):
    """:returns: a function that makes a folder of OpenUSD's source"""
    def make(minor=25, patch=8):
        folder = tmp_path / "source"
        (folder / "cmake/defaults").mkdir(parents=True)
        (folder / "pxr/base/work").mkdir(parents=True)
        (folder / "cmake/defaults/Version.cmake").write_text(
            f'set(PXR_MAJOR_VERSION "0")\nset(PXR_MINOR_VERSION "{minor}")\nset(PXR_PATCH_VERSION "{patch}")\n')
        (folder / "pxr/pxr.h.in").write_text("#define PXR_VERSION @PXR_VERSION@\n"
                                             "#define PXR_INTERNAL_NS @PXR_INTERNAL_NAMESPACE@__pxrReserved__\n")
        (folder / "pxr/base/work/impl.h.in").write_text("#include @PXR_WORK_IMPL_HEADER@\n")
        return folder
    return make


def test_a_program_gets_what_it_lacks(program, source, tmp_path):
    folder, headers = program(), source()
    name, prefix = hydraHosts.prefix_of(str(folder), str(headers), str(tmp_path / "made"))
    assert name == "pxrProgram_v25_08"
    with open(os.path.join(prefix, "include/pxr/pxr.h"), encoding="utf-8") as file:
        assert file.read().splitlines() == ["#define PXR_VERSION 2508",
                                            "#define PXR_INTERNAL_NS pxrProgram_v25_08__pxrReserved__"]
    assert '"pxr/base/work/workTBB/impl.h"' in (tmp_path / "made" / name / "openUSD/include/pxr/base/work/impl.h").read_text()
    with open(os.path.join(prefix, "pxrConfig.cmake"), encoding="utf-8") as file:
        text = file.read()
    assert "set(PXR_VERSION 2508)" in text and str(headers) in text and "[[" + str(folder / "python/bin/python3.11") in text
    for link in ("lib/libusd_ms.so", "lib/libtbb.so.12", "lib/usd", "lib/python/pxr/__init__.py"):
        assert os.path.exists(os.path.join(prefix, link)), link
    before = os.stat(os.path.join(prefix, "include/pxr/pxr.h")).st_mtime_ns
    hydraHosts.prefix_of(str(folder), str(headers), str(tmp_path / "made"))  # again, upon which nothing is compiled anew
    assert os.stat(os.path.join(prefix, "include/pxr/pxr.h")).st_mtime_ns == before


def test_headers_of_its_own_python(program, source, tmp_path):
    folder, headers = program(), source()
    (folder / "include").mkdir()
    (folder / "include/Python.h").write_text("")
    python = folder / "python/bin/python3.11"
    python.write_text(f"#!/bin/sh\nprintf '%s\\n' {folder}/include {folder}/libpython3.99.so\n")
    for mode, own in ((0o644, False), (0o755, True)):  # one that does not run, and one that does
        python.chmod(mode)
        _, prefix = hydraHosts.prefix_of(str(folder), str(headers), str(tmp_path / "made"))
        with open(os.path.join(prefix, "pxrConfig.cmake"), encoding="utf-8") as file:
            text = file.read()
        assert (f"{folder}/include" in text, f"{folder}/libpython3.99.so" in text) == (own, own)


def test_an_installed_one_is_taken_as_it_is(tmp_path):
    for place in ("", "lib/cmake/pxr"):
        folder = tmp_path / f"usd{len(place)}"
        (folder / place).mkdir(parents=True)
        (folder / place / "pxrConfig.cmake").write_text("")
        found = hydraHosts.prefix_of(str(folder), None, str(tmp_path / "made"))
        assert found == (folder.name, os.path.join(str(folder), place))
    assert not (tmp_path / "made").exists()


def test_what_does_not_fit_is_told(program, source, tmp_path):
    folder, headers = program(), source(patch=5)
    made = str(tmp_path / "made")
    with pytest.raises(CommandError, match=r"--headers FOLDER names OpenUSD's source"):
        hydraHosts.prefix_of(str(folder), None, made)
    with pytest.raises(CommandError, match=r"pxrProgram_v25_08__pxrReserved__, but .* is version 25\.05"):
        hydraHosts.prefix_of(str(folder), str(headers), made)
    with pytest.raises(CommandError, match="is not OpenUSD's source"):
        hydraHosts.prefix_of(str(folder), str(tmp_path), made)
    with pytest.raises(CommandError, match="neither pxrConfig.cmake nor a library"):
        hydraHosts.prefix_of(str(tmp_path / "source"), str(headers), made)
    (folder / "lib/libusd_ms.so").write_bytes(b"something else")
    with pytest.raises(CommandError, match="has no symbols of OpenUSD"):
        hydraHosts.prefix_of(str(folder), str(headers), made)


@pytest.mark.parametrize("portable, said", [(False, "build-usd "), (True, "build-usd-portable " + hydraHosts.LEVEL)])
def test_a_plugin_for_other_machines_is_not_built_for_this_processor(tmp_path, monkeypatch, portable, said):
    (tmp_path / "usd").mkdir()
    (tmp_path / "usd/pxrConfig.cmake").write_text('set(PXR_VERSION "2608")\n')
    command = tmp_path / "patina"
    command.write_text(f'#!/bin/sh\necho "$(basename "$PATINA_BUILD_DIR") $PATINA_LEVEL" >{tmp_path}/said\n')
    command.chmod(0o755)
    monkeypatch.delenv("PATINA_LEVEL", raising=False)
    built, = hydraHosts.build_all([str(tmp_path / "usd")], [], str(tmp_path / "build"), str(command), portable)
    assert (tmp_path / "said").read_text() == said + "\n" and built.version == (26, 8)
    assert os.path.dirname(built.plugin) == str(tmp_path / said.split()[0])
