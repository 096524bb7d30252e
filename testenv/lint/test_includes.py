# SPDX-License-Identifier: Apache-2.0
"""Each C++ file includes what it uses of the precompiled headers, so that it compiles without them too: the fuzzers' build and
-DPATINA_PRECOMPILED=OFF have none."""
import functools
import os
import re

import pytest

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
FOLDERS = ("base", "shaders", "materialNetwork", "hdDelegate", "plugin", "testenv")
# included inside a namespace, or after it, and say so
TEXTUAL = ("shaders/compat/cpp.h", "shaders/compat/cppEnd.h", "shaders/compat/cppPatterns.h")
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
# header -> what tells that a file uses it
USES = {"array": r"std::array<", "atomic": r"std::atomic\b",
        "cmath": r"std::(abs|acos|asin|atan2|cbrt|ceil|copysign|cos|exp2?|floor|fmod|frexp|hypot|isfinite|isinf|isnan|ldexp|"
                 r"log2?|lround|nextafter|pow|round|sin|sqrt|tan|trunc)\(",
        "cstring": r"\bstd::(memcmp|memcpy|memset|strcmp|strlen)\(", "functional": r"std::function<",
        "map": r"std::(multi)?map<", "memory": r"std::(make_shared|make_unique|shared_ptr|unique_ptr|weak_ptr)\b",
        "mutex": r"std::(call_once|lock_guard|mutex|once_flag|scoped_lock|unique_lock)\b",
        "optional": r"std::(nullopt|optional)\b", "set": r"std::(multi)?set<", "sstream": r"std::[io]?stringstream\b",
        "stdexcept": r"std::(domain_error|invalid_argument|length_error|logic_error|out_of_range|runtime_error)\b",
        "string": r"std::(stod|stoi|string|to_string)\b", "vector": r"std::vector<",
        "glm/glm.hpp": r"\bglm::", "gtest/gtest.h": r"\b(ASSERT|EXPECT)_\w+\(|\bTEST(_F|_P)?\("}
# These come with any other header of the standard library, which compilers' own headers include in part.
EVERYWHERE = {"algorithm", "cstdint", "utility"}


def cpp():
    """:returns: paths of all C++ from the root"""
    found = []
    for top in FOLDERS:
        for folder, folders, names in os.walk(os.path.join(ROOT, top)):
            folders[:] = [name for name in folders if name != "node_modules"]
            found += [os.path.relpath(os.path.join(folder, name), ROOT) for name in names if name.endswith((".h", ".cpp"))]
    return found


@functools.lru_cache(None)
def text(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return COMMENT.sub("", file.read())


def included(path):
    """:returns: headers of other projects that a file includes, itself or by headers of this one"""
    seen, left, others = set(), [path], set()
    while left:
        at = left.pop()
        if at in seen:
            continue
        seen.add(at)
        for name in INCLUDE.findall(text(at)):
            beside = os.path.normpath(os.path.join(os.path.dirname(at), name))
            inside = [file for file in (name, beside) if os.path.exists(os.path.join(ROOT, file))]
            left += inside[:1]
            others |= set() if inside else {name}
    return others


def missing(path):
    """:returns: headers that a file uses and does not include"""
    others = included(path)
    return [header for header, use in USES.items()
            if re.search(use, text(path)) and not any(name == header or name.startswith(header.split("/")[0] + "/")
                                                      for name in others)]


def test_what_is_precompiled_is_included():
    found = {path: headers for path in cpp() if path not in TEXTUAL and (headers := missing(path))}
    assert not found, "\n".join(f"{path} uses <{'>, <'.join(headers)}> without including it" for path, headers in found.items())


@pytest.mark.parametrize("name", ("precompiled.h", "forTests.h"))
def test_all_precompiled_headers_are_watched(name):
    headers = set(INCLUDE.findall(text(f"cmake/precompiled/{name}")))
    assert {header for header in headers if not header.startswith("cmake/")} <= set(USES) | EVERYWHERE
