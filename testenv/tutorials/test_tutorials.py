# SPDX-License-Identifier: Apache-2.0
"""Every tutorial does what it says."""
import os

import pytest

import tutorialBlocks


def hydra():
    """:returns: the module that knows the OpenUSD of the build"""
    import sys

    sys.path.append(os.path.join(tutorialBlocks.ROOT, "testenv", "hydra"))
    import hydraBuild

    return hydraBuild


@pytest.mark.parametrize("page", tutorialBlocks.pages())
def test_runs(page, tmp_path):
    path = os.path.join(tutorialBlocks.FOLDER, page + ".md")
    needs, environment, absent, left = tutorialBlocks.read(path)[1], {}, [], []
    if needs == "OpenUSD":
        if hydra().missing():
            pytest.skip(hydra().missing())
        environment["PATH"] = os.path.join(hydra().folder("root"), "bin") + os.pathsep + os.environ["PATH"]
        absent = [] if hydra().has_usdrecord() else ["usdrecord"]
    else:
        assert not needs, f"the page needs {needs}, which no test looks for"
    ran = tutorialBlocks.run(path, str(tmp_path), environment, absent=absent, left=left)
    assert ran >= 2
    if left:
        pytest.skip(f"{ran} blocks ran, and not all: {'; '.join(left)}, a script that this OpenUSD has not, without Python")
