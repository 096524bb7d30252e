# SPDX-License-Identifier: Apache-2.0
"""The folders of the material pipeline include only those that docs/design/plan.md says they may."""
import os
import re

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
TOP = "materialNetwork"


def pipeline():
    """:returns: folder -> folders that it may include, from rows of a table: | `folder/` | what it holds | `folder/` ... |"""
    with open(os.path.join(ROOT, "docs", "design", "plan.md"), encoding="utf-8") as file:
        rows = re.findall(r"^\| `(\w+)/` \|[^|\n]*\|([^|\n]*)\|$", file.read(), re.MULTILINE)
    return {name: set(re.findall(r"`(\w+)/`", includes)) for name, includes in rows}


def includes(folder):
    """:returns: (file, folder that it includes) of all C++ in one"""
    found = []
    for name in os.listdir(os.path.join(ROOT, TOP, folder)):
        if name.endswith((".h", ".cpp")):
            with open(os.path.join(ROOT, TOP, folder, name), encoding="utf-8") as file:
                found += [(f"{folder}/{name}", target) for target in re.findall(r'#include "materialNetwork/(\w+)/',
                                                                                file.read())]
    return found


def test_every_include_is_an_arrow_of_the_table_and_every_arrow_is_there():
    known = pipeline()
    assert {"graph", "plan", "ir", "cpu", "glsl", "planner"} <= set(known)
    for folder, allowed in known.items():
        met = set()
        for file, target in includes(folder):
            assert target == folder or target in allowed, f"{file} includes {target}/: plan.md has no arrow from {folder}/"
            met.add(target)
        assert allowed <= met, f"plan.md has arrows that no include needs: {folder}/ to {allowed - met}"


def test_arrows_run_down_the_table():
    order = list(pipeline())
    for folder, allowed in pipeline().items():
        for other in allowed & set(order):
            assert order.index(other) < order.index(folder), f"{folder}/ includes {other}/, which comes after it"


def test_back_ends_do_not_know_each_other():
    known = pipeline()
    assert "glsl" not in known["cpu"] and "cpu" not in known["glsl"]
