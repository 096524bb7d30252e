# SPDX-License-Identifier: Apache-2.0
"""The warnings in the code: their texts, with … for what differs from scene to scene."""
import ast
import glob
import os
import re

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
CPP = re.compile(r"\bwarn\(")
# Place of the text, by the start of a file's path: the heading of the page.
AREAS = (
    ("Stages", ("plugin/patina/stage",)), ("Render settings and products",
                                           ("plugin/patina/cli", "hdDelegate/hydra/renderProducts")),
    ("Shapes", ("hdDelegate/geometry",)), ("Lights", ("hdDelegate/lights", "hdDelegate/embree/sceneLights")),
    ("Materials", ("base", "materialNetwork", "hdDelegate/compiled")), ("Textures and fields", ("hdDelegate/image",)),
    ("Cameras, instances, the scene", ("hdDelegate/scene",)), ("Hydra", ("hdDelegate/hydra",)),
    ("Path tracer", ("hdDelegate/embree",)), ("Rasterizer and back ends", ("hdDelegate/raster", "hdDelegate/backends",
                                                                          "hdDelegate/renderer")),
)


def _closed(text, start):
    """:returns: the place behind the bracket that closes the one before `start`"""
    depth, quoted, i = 1, False, start
    while depth and i < len(text):
        if text[i] == '"' and text[i - 1] != "\\":
            quoted = not quoted
        elif not quoted:
            depth += (text[i] in "({[") - (text[i] in ")}]")
        i += 1
    return i


def _split(text, at):
    """:returns: parts of an expression between characters of the outermost level"""
    parts, depth, quoted, start = [], 0, False, 0
    for i, c in enumerate(text):
        if c == '"' and text[i - 1] != "\\":
            quoted = not quoted
        elif not quoted:
            depth += (c in "({[") - (c in ")}]")
            if c == at and depth == 0:
                parts.append(text[start:i])
                start = i + 1
    return [*parts, text[start:]]


def _cpp_text(expression):
    """:returns: the text of an expression of strings and values, … for a value; None where it holds no words"""
    words = []
    for part in _split(expression, "+"):
        part = part.strip()
        wrapped = re.fullmatch(r'std::string\((".*")\)', part, re.DOTALL)
        literals = re.findall(r'"((?:[^"\\]|\\.)*)"', wrapped[1] if wrapped else part)
        plain = re.fullmatch(r'(?:"(?:[^"\\]|\\.)*"\s*)+', wrapped[1] if wrapped else part)
        words.append("".join(literals) if plain else "…")
    text = "".join(words).replace('\\"', '"')
    return text if re.search(r"[a-z]{2}", text) else None


def _cpp(path, text):
    for match in CPP.finditer(text):
        end = _closed(text, match.end())
        arguments = _split(text[match.end():end - 1], ",")
        choice = _split(arguments[-1], "?")
        for expression in (_split(choice[1], ":") if len(choice) == 2 and "::" not in choice[1] else [arguments[-1]]):
            found = _cpp_text(expression) if len(arguments) >= 2 else None
            if found:
                yield path, found


def _python_text(node):
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(part.value if isinstance(part, ast.Constant) else "…" for part in node.values)
    if isinstance(node, ast.BinOp):
        return _python_text(node.left) + _python_text(node.right)
    return "…"


def _python(path, text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call) and isinstance(node.func,
                                                     ast.Attribute) and node.func.attr == "warn" and len(node.args) == 3:
            found = _python_text(node.args[2])
            if re.search(r"[a-z]{2}", found):
                yield path, found


def texts():
    """:returns: {area: sorted texts}; a text that stands in several places counts for the first area"""
    files = [path for folder in ("base", "hdDelegate", "materialNetwork") for path in
             glob.glob(os.path.join(ROOT, folder, "**", "*.cpp"), recursive=True)]
    files += glob.glob(os.path.join(ROOT, "plugin", "patina", "**", "*.py"), recursive=True)
    found, seen = {area: [] for area, _ in AREAS}, set()
    for area, starts in AREAS:
        for full in sorted(files):
            path = os.path.relpath(full, ROOT).replace(os.sep, "/")
            if "/tests/" in path or not path.startswith(starts):
                continue
            with open(full, encoding="utf-8") as file:
                source = file.read()
            for _, text in (_cpp if path.endswith(".cpp") else _python)(path, source):
                text = " ".join(text.split())
                if text not in seen:
                    seen.add(text)
                    found[area].append(text)
    return {area: sorted(listed, key=lambda t: t.lower().lstrip("'… ")) for area, listed in found.items()}
