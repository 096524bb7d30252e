# SPDX-License-Identifier: Apache-2.0
"""Data with which the page saves its values as a layer of USD."""
import math
import os
import re

from patina.cli.compiled import _patina
from patina.cli.materials import is_document
from patina.cli.usd import TYPES
from patina.view import live

_NAME = re.compile(r"[A-Za-z_]\w*(:[A-Za-z_]\w*)*", re.ASCII)


def asset(path):
    """:returns: an asset path as .usda writes it, or '' where it cannot be"""
    if any(ord(c) < 32 for c in path) or "@@@" in path:
        return ""
    return f"@@@{path}@@@" if "@" in path else f"@{path}@"


def _quoted(text):
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if ord(c) >= 32 else " " for c in escaped) + '"'


def _value(kind, value, folder):
    """:returns: a value as .usda writes it, or '' where it is none of its kind"""
    if kind == "filename":
        return asset(os.path.relpath(value, folder) if value else "") or "@@"
    if kind == "string":
        return _quoted(value)
    try:
        numbers = [float(x) for x in ([value] if isinstance(value, (int, float, str)) else value)]
    except (TypeError, ValueError):
        return ""  # a word
    if not numbers or not all(map(math.isfinite, numbers)):
        return ""
    if kind in ("boolean", "integer"):
        return str(int(numbers[0]))
    texts = [f"{x:.9g}" for x in numbers]
    if kind.startswith("matrix"):
        side = 3 if kind == "matrix33" else 4
        return "(" + ", ".join("(" + ", ".join(texts[i * side:(i + 1) * side]) + ")" for i in range(side)) + ")"
    return texts[0] if len(texts) == 1 else "(" + ", ".join(texts) + ")"


def over_stage(file, folder):
    """Values are opinions over the stage itself.

    :param folder: where the page is written to, and layers are expected
    """
    return {"asset": asset(os.path.relpath(os.path.abspath(file), folder)), "prims": [], "paths": {}, "defaultPrim": ""}


def whole_material(name, network, moved, folder):
    """The material written out, for those that are no part of a stage.

    :param moved: the inputs whose values the page writes
    """
    safe = re.sub(r"[^A-Za-z0-9_]", "_", name)
    safe = safe if safe and not safe[0].isdigit() else "m_" + safe
    root, nodes = f"/{safe}", network.nodes()
    paths = {node["path"]: f"{root}/n{i}" for i, node in enumerate(nodes)}
    open_inputs = {(i.node, i.name) for i in moved}
    terminal = network.terminals().get("surface")
    lines = []
    # Every name that stands in the layer is checked: a line break in one would begin lines of its own.
    if terminal and terminal[0] in paths and _NAME.fullmatch(terminal[1] or "out"):
        lines.append(f"token outputs:mtlx:surface.connect = <{paths[terminal[0]]}.outputs:{terminal[1] or 'out'}>")
    prims = [{"path": root, "spec": "def Material", "lines": lines}]
    for node in nodes:
        own = [f"uniform token info:id = {_quoted(node['id'])}"]
        known = _patina.node_inputs(node["id"])
        for key, value in node["inputs"].items():
            if (node["path"], key) in open_inputs or value["type"] not in TYPES or not _NAME.fullmatch(key):
                continue
            if known.get(key, value["type"]) != value["type"]:  # a word where a number should be
                continue
            text = _value(value["type"], live.linear(value), folder)
            if text:
                own.append(f"{TYPES[value['type']]} inputs:{key} = {text}")
        for key, (source, output) in node["connections"].items():
            if source in paths and _NAME.fullmatch(key) and _NAME.fullmatch(output or "out"):
                own.append(f"token inputs:{key}.connect = <{paths[source]}.outputs:{output or 'out'}>")
        used = {o or "out" for n in nodes for s, o in n["connections"].values() if s == node["path"]}
        if terminal and terminal[0] == node["path"]:
            used.add(terminal[1] or "out")
        own += [f"token outputs:{output}" for output in sorted(used) if _NAME.fullmatch(output)]
        prims.append({"path": paths[node["path"]], "spec": "def Shader", "lines": own})
    return {"asset": "", "prims": prims, "paths": paths, "defaultPrim": safe}


def of(argument_file, name, network, live_inputs, choices, output):
    folder = os.path.dirname(os.path.abspath(output))
    if is_document(argument_file):
        return whole_material(name, network, live_inputs + choices, folder)
    return over_stage(argument_file, folder)
