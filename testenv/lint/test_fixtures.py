# SPDX-License-Identifier: Apache-2.0
"""A fixture ends all that it has started when its module ends: at the end of a session, its failure would be that of whichever
test the process ran last."""
import ast
import os

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


def wide_fixtures_with_an_end(text):
    """:returns: names of fixtures of a session or package that do something after their tests"""
    found = []
    for function in (n for n in ast.walk(ast.parse(text)) if isinstance(n, ast.FunctionDef)):
        scopes = [keyword.value.value for decorator in function.decorator_list if isinstance(decorator, ast.Call)
                  for keyword in decorator.keywords if keyword.arg == "scope" and isinstance(keyword.value, ast.Constant)]
        ends = any(isinstance(n, (ast.Yield, ast.YieldFrom)) or isinstance(n, ast.Attribute) and n.attr == "addfinalizer"
                   for n in ast.walk(function))
        if set(scopes) & {"session", "package"} and ends:
            found.append(function.name)
    return found


def test_no_fixture_of_a_session_has_an_end():
    for top in ("testenv", "plugin"):
        for folder, _, names in os.walk(os.path.join(ROOT, top)):
            for name in names:
                if name == "conftest.py" or name.startswith("test_") and name.endswith(".py"):
                    with open(os.path.join(folder, name), encoding="utf-8") as file:
                        assert not wide_fixtures_with_an_end(file.read()), os.path.join(folder, name)


def test_the_rule_sees_what_it_looks_for():
    text = "import pytest\n@pytest.fixture(scope='%s')\ndef tool():\n    %s\n"
    assert wide_fixtures_with_an_end(text % ("session", "yield 1")) == ["tool"]
    assert wide_fixtures_with_an_end(text % ("session", "return 1")) == []
    assert wide_fixtures_with_an_end(text % ("module", "yield 1")) == []
