# SPDX-License-Identifier: Apache-2.0
"""Every tutorial does what it says."""
import os

import pytest

pytest.importorskip("_patina")

import tutorialBlocks  # noqa: E402


def missing_hydra():
    """:returns: why usdrecord cannot run, else None"""
    import sys

    sys.path.append(os.path.join(tutorialBlocks.ROOT, "testenv", "hydra"))
    import hydraBuild

    return hydraBuild.missing() or (None if hydraBuild.has_usdrecord() else "this OpenUSD has no usdrecord")


@pytest.mark.parametrize("page", tutorialBlocks.pages())
def test_runs(page, tmp_path):
    path = os.path.join(tutorialBlocks.FOLDER, page + ".md")
    needs, environment = tutorialBlocks.read(path)[1], {}
    if needs == "OpenUSD":
        reason = missing_hydra()
        if reason:
            pytest.skip(reason)
        import hydraBuild

        environment["PATH"] = os.path.join(hydraBuild.folder("root"), "bin") + os.pathsep + os.environ["PATH"]
    else:
        assert not needs, f"the page needs {needs}, which no test looks for"
    assert tutorialBlocks.run(path, str(tmp_path), environment) >= 2
