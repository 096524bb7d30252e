# SPDX-License-Identifier: Apache-2.0
"""The table of messages: its rows are whole, all of them are used, and code in Python gives them the fields that they have."""
import ast
import glob
import os
import re

from patina import messages
from patina.cli import rows

TABLE = messages.table()


def sources(folder, *ends):
    """:returns: texts of code, that of tests/ folders left out"""
    for end in ends:
        for path in glob.glob(os.path.join(rows.ROOT, folder, "**", "*" + end), recursive=True):
            if f"{os.sep}tests{os.sep}" not in path:
                with open(path, encoding="utf-8") as file:
                    yield file.read()


PYTHON = [ast.parse(text) for text in sources("plugin/patina", ".py")]


def test_every_field_stands_in_its_text():
    assert {i: sorted(row.fields) for i, row in TABLE.items()} == {
        i: sorted(set(re.findall(r"{(\w+)}", row.text))) for i, row in TABLE.items()}


def test_every_row_is_used():
    used = {node.value for tree in PYTHON for node in ast.walk(tree) if isinstance(node, ast.Constant)}
    for folder in ("base", "materialNetwork", "hdDelegate", "plugin"):
        for text in sources(folder, ".cpp", ".h"):
            used.update(re.findall(r"\bmessages::(\w+)", text))
    assert sorted(set(TABLE) - used) == []
    assert {row.values[0] for row in rows.read("base/messages.def", "ADVICE")} == {
        row.values[3] for row in rows.read("base/messages.def", "MESSAGE")}


def test_warnings_of_python_have_the_fields_of_their_rows():
    found = 0
    for tree in PYTHON:
        for node in ast.walk(tree):
            if not isinstance(node, ast.Call) or getattr(node.func, "attr", "") not in ("warn", "_warn", "warning"):
                continue
            if len(node.args) < 3:
                continue
            assert not isinstance(node.args[2], (ast.JoinedStr, ast.BinOp)), "words: " + ast.unparse(node)
            if isinstance(node.args[2], ast.Constant):
                assert len(node.args) - 3 == len(TABLE[node.args[2].value].fields), ast.unparse(node)
                found += 1
    assert found > 90


def test_a_reason_that_names_a_limit_says_what_to_do():
    file = messages.warning("/a", "file", "fileUnreadable", "is larger than 10 (--limit documentBytes)")
    assert "--limit" in messages.advice(file)
    assert "--limit" not in messages.advice(messages.warning("/a", "file", "fileUnreadable", "does not exist"))
