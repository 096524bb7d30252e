# SPDX-License-Identifier: Apache-2.0
"""Wheel, .deb, tarball and example host, each made and used as its users do."""
import os
import re
import subprocess

import pytest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", ".."))
MISSING = 3  # exit status of everyPackage.sh where the machine lacks something


def test_every_package_renders_the_same_bits(tmp_path):
    """PATINA_CHANGE_SYSTEM=1 lets it install the .deb, as root on a machine for that."""
    words = ["--install"] if os.environ.get("PATINA_CHANGE_SYSTEM") == "1" else []
    result = subprocess.run([os.path.join(HERE, "everyPackage.sh"), str(tmp_path), *words], stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True, timeout=7200)
    if result.returncode == MISSING:
        pytest.skip(result.stdout.strip().splitlines()[-1])
    assert result.returncode == 0, result.stdout[-6000:]
    for words in ("wheel renders", "deb renders", "tarball renders", "the same bits", "the example renders", "all is well"):
        assert words in result.stdout


def test_the_page_lists_what_the_launcher_installs():
    with open(os.path.join(ROOT, "docs", "install.md"), encoding="utf-8") as file:
        line = re.search(r"^    apt-get install ((?:.*\\\n)*.*)", file.read(), re.MULTILINE)[1]
    page = {word for word in line.replace("\\", " ").split() if not word.startswith("-")}
    with open(os.path.join(ROOT, "patina"), encoding="utf-8") as file:
        launcher = set(re.search(r"^packages=\(([^)]*)\)", file.read(), re.MULTILINE)[1].split())
    of_tests = {"ccache", "libgtest-dev", "glslang-tools"}
    assert page - launcher == {"dpkg-dev", "file"} and launcher - page == of_tests
