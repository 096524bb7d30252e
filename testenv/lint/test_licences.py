# SPDX-License-Identifier: Apache-2.0
"""Source files name their licence, and the list of licences knows what the project uses."""
import glob
import os
import re
import shutil
import subprocess

import pytest

import licenceHeaders


def read(path):
    with open(os.path.join(licenceHeaders.ROOT, path), encoding="utf-8") as file:
        return file.read()


def test_every_source_file_names_its_licence():
    if not shutil.which("git") or subprocess.run(["git", "rev-parse"], cwd=licenceHeaders.ROOT, capture_output=True).returncode:
        pytest.skip("this is no git checkout: git lists the files")
    files, missing = licenceHeaders.files(), licenceHeaders.missing()
    assert len(files) > 500
    if len(missing) > len(files) - 10:
        pytest.skip("no file names its licence yet: ./patina python testenv/licenceHeaders.py adds the line to all")
    assert not missing, "./patina python testenv/licenceHeaders.py adds the line"


@pytest.mark.parametrize("path, text, wanted", [
    ("a/b.cpp", "// what\n", "// SPDX-License-Identifier: Apache-2.0\n// what\n"),
    ("a/b.py", "#!/usr/bin/env python3\n1\n", "#!/usr/bin/env python3\n# SPDX-License-Identifier: Apache-2.0\n1\n"),
    ("a/b.mtlx", '<?xml version="1.0"?>\n<m/>\n',
     '<?xml version="1.0"?>\n<!-- SPDX-License-Identifier: Apache-2.0 -->\n<m/>\n'),
    ("a/b.css", "p{}\n", "/* SPDX-License-Identifier: Apache-2.0 */\np{}\n")])
def test_the_line_stands_first_where_it_may(path, text, wanted):
    assert licenceHeaders.with_line(path, text) == wanted


def test_the_list_of_licences_is_whole():
    listed = read("docs/licences.md")
    packages = {re.split(r"[<>=\[]", line)[0].strip() for path in glob.glob(os.path.join(licenceHeaders.ROOT,
                                                                                         "requirements*.txt"))
                for line in read(path).splitlines() if line.strip() and not line.startswith("#")}
    libraries = set(re.findall(r"find_package\((\w+)", read("CMakeLists.txt") + read("shaders/CMakeLists.txt"))) - {"Threads"}
    scripts = set()
    for path in glob.glob(os.path.join(licenceHeaders.ROOT, "**", "web", "package.json"), recursive=True):
        if "node_modules" not in path:
            scripts |= set(re.findall(r'"([\w-]+)": "[\^\d]', read(path)))
    assert packages and libraries and scripts
    names = {"three": "three.js", "GTest": "GTest"}
    lost = [name for name in sorted(packages | libraries | scripts) if names.get(name, name).lower() not in listed.lower()]
    assert not lost, lost
