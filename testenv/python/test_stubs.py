# SPDX-License-Identifier: Apache-2.0
"""The typed interface says what the compiled module has: every name and every signature."""
import ast
import inspect
import os
import subprocess
import sys

import pytest

import _patina
import generateStubs

HERE = os.path.dirname(os.path.abspath(__file__))
CONSUMER = """
import _patina, numpy
scene: _patina.Scene = _patina.Scene()
with scene.edit() as edit:
    edit.set_light("/sky", type="dome")
film = _patina.Film()
_patina.make_renderer("embree").start(scene, "/camera", {"samples": 1}, film)
pixels: numpy.ndarray = film.resolve("color")
"""


def test_it_is_not_stale():
    if generateStubs.missing():
        pytest.skip(generateStubs.missing())
    assert not generateStubs.is_stale(), "./patina python testenv/generateStubs.py writes it anew"


def named(tree):
    """:returns: {class or function: its node} of a stub's outermost level"""
    return {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name[0] != "_"}


def test_names_are_those_of_the_module():
    with open(generateStubs.STUB, encoding="utf-8") as file:
        tree = ast.parse(file.read())
    module = {name for name in dir(_patina) if name[0] != "_" and callable(getattr(_patina, name))}
    assert module <= set(named(tree))
    if not generateStubs.missing().startswith("this build"):
        assert set(named(tree)) <= module
    for name in module:
        value = getattr(_patina, name)
        if inspect.isclass(value) and not issubclass(value, BaseException):
            inside = {n.name for n in named(tree)[name].body if isinstance(n, ast.FunctionDef)}
            inside |= {n.target.id for n in named(tree)[name].body if isinstance(n, ast.AnnAssign)}
            assert {n for n in vars(value) if n[0] != "_"} <= inside, name


def test_everything_says_what_it_does():
    with open(generateStubs.STUB, encoding="utf-8") as file:
        tree = ast.parse(file.read())
    scene = named(tree)
    for owner in ("Scene", "SceneEdit", "Network", "Renderer", "Film"):
        for node in scene[owner].body:
            if isinstance(node, ast.FunctionDef) and node.name[0] != "_" and "setter" not in ast.dump(node):
                assert ast.get_docstring(node), f"{owner}.{node.name}"


def mypy(*arguments, **keywords):
    pytest.importorskip("mypy", reason="PyPI's mypy is not installed")
    environment = dict(os.environ, MYPYPATH=generateStubs.BINDINGS)
    return subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True, env=environment, **keywords)


def test_stubtest_agrees():
    done = mypy("mypy.stubtest", "_patina", "--allowlist", os.path.join(HERE, "stubtest.allow"), "--ignore-unused-allowlist")
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("line, good", [("", True), ('_patina.make_renderer(3)', False), ('scene.edit().set_light(1)', False),
                                        ('film.resolv("color")', False)])
def test_type_checkers_read_it(tmp_path, line, good):
    path = tmp_path / "consumer.py"
    path.write_text(CONSUMER + line + "\n")
    done = mypy("mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), str(path), cwd=tmp_path)
    assert (done.returncode == 0) == good, done.stdout + done.stderr
