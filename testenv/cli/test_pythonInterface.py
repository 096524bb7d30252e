# SPDX-License-Identifier: Apache-2.0
"""`import patina`: the names that programs use."""
import subprocess
import sys

import patina
import pytest


def test_importing_it_loads_nothing():
    program = "import sys, patina; sys.exit(any(name.split('.')[0] in ('_patina', 'pxr', 'numpy') for name in sys.modules))"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def test_its_names_are_there():
    pytest.importorskip("_patina")
    pytest.importorskip("pxr")
    assert all(callable(getattr(patina, name)) for name in patina.__all__) and set(patina.__all__) <= set(dir(patina))
    with pytest.raises(AttributeError, match="nothing"):
        patina.nothing
