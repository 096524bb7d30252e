# SPDX-License-Identifier: Apache-2.0
"""`import patina`: the names that programs use."""
import inspect
import os
import re
import subprocess
import sys

import pytest

import _patina
import patina

STUB = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "plugin", "python", "_patina.pyi")


def test_importing_it_loads_nothing():
    program = "import sys, patina; sys.exit(any(name.split('.')[0] in ('_patina', 'pxr', 'numpy') for name in sys.modules))"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def test_its_names_are_there():
    assert all(callable(getattr(patina, name)) for name in patina.__all__) and set(patina.__all__) <= set(dir(patina))
    with pytest.raises(AttributeError, match="nothing"):
        patina.nothing


def test_the_stub_has_what_the_module_has():
    """Made by testenv/generateStubs.py, from the module."""
    with open(STUB, encoding="utf-8") as file:
        stub = file.read()
    bodies = dict(re.findall(r"^class (\w+)[^\n]*:\n(.*?)(?=^\S)", stub, re.MULTILINE | re.DOTALL))
    for name in (name for name in dir(_patina) if not name.startswith("_")):
        assert re.search(rf"^(class|def) {name}\b|^{name}: ", stub, re.MULTILINE), name
        if inspect.isclass(getattr(_patina, name)) and not issubclass(getattr(_patina, name), Exception):
            for own in (own for own in vars(getattr(_patina, name)) if not own.startswith("_")):
                assert re.search(rf"^    def {own}\b|^    {own}: ", bodies[name], re.MULTILINE), f"{name}.{own}"
