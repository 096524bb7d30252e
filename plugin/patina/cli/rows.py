# SPDX-License-Identifier: Apache-2.0
"""Tables of the C++ code that the command line shares: rows such as SETTING(type, name, default, .word("...")) of a .def file.

They are read as text, so that --help needs no build.
"""
import functools
import os
import re
from dataclasses import dataclass

_PACKAGE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
_INSTALLED = os.path.join(_PACKAGE, "tables")  # an installed package has its own copies
ROOT = _INSTALLED if os.path.isdir(_INSTALLED) else os.path.normpath(os.path.join(_PACKAGE, "..", ".."))
_STRING = re.compile(r'"((?:[^"\\]|\\.)*)"')


@dataclass(frozen=True)
class Row:
    values: tuple  # what stands before the words, as it is written
    words: dict  # word -> list of arguments: texts and numbers

    def text(self, i):
        return argument(self.values[i])


@functools.lru_cache(maxsize=None)
def read(path, macro):
    """:param path: of a .def file below the root of the checkout, or of the tables that are installed
    :returns: list of Row"""
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        text = re.sub(r"^\s*//.*$", "", file.read(), flags=re.MULTILINE)
    return [_row(body) for body in _calls(text, rf"^{macro}\(")]


def _row(body):
    parts = _split(body)
    words = parts.pop() if parts[-1].startswith(".") else ""
    return Row(tuple(parts), dict(_words(words)))


def _words(text):
    while text:
        name = re.match(r"\.(\w+)\(", text)
        end = _end(text, name.end())
        yield name.group(1), [argument(part) for part in _split(text[name.end():end])]
        text = text[end + 1:].strip()


def argument(text):
    """:returns: the value that a column writes: a text, a number, or None"""
    if text.startswith('"'):
        return "".join(_STRING.findall(text)).replace('\\"', '"').replace("\\\\", "\\")
    return {"None": None, "most": float("inf")}[text] if text.isalpha() else float(text) if "." in text else int(text)


def _calls(text, opening):
    for start in re.finditer(opening, text, re.MULTILINE):
        yield text[start.end():_end(text, start.end())]


def _end(text, start):
    """:returns: where the parenthesis that is open at the start ends"""
    depth = 1
    for token in re.finditer(r'"(?:[^"\\]|\\.)*"|[()]', text[start:]):
        depth += {"(": 1, ")": -1}.get(token.group(), 0)
        if depth == 0:
            return start + token.start()
    raise ValueError(f"a row without an end: {text[start:start + 60]}")


def _split(text):
    """:returns: parts between the commas that are in no parentheses, braces or texts"""
    parts, depth, start = [], 0, 0
    for token in re.finditer(r'"(?:[^"\\]|\\.)*"|[(){},]', text):
        depth += {"(": 1, "{": 1, ")": -1, "}": -1}.get(token.group(), 0)
        if token.group() == "," and depth == 0:
            parts.append(text[start:token.start()].strip())
            start = token.end()
    return [part for part in [*parts, text[start:].strip()] if part]
