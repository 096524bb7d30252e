# SPDX-License-Identifier: Apache-2.0
"""Graphs that failed once, kept as documents: what may be expected of one stands in a comment, with what failed. The word
`raster` there has both back ends compared; `seed` is that of the graph, which chooses the random places of a look."""
import os
import re
import xml.etree.ElementTree as ElementTree
from types import SimpleNamespace

import graphText

KINDS = {*graphText.BSDFS, *graphText.EDFS, *graphText.VDFS, *graphText.MORE}
CORPUS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "corpus")
EXPECTED = re.compile(r"<!-- expected: (.*) -->")


def write(path, text, graph, methods, lines):
    """:param graph: with bound, seed, loses, thin and ward, as graphText.Graph
    :param lines: what failed
    """
    words = [f"bound={graph.bound:g}", f"seed={graph.seed}",
             *(name for name in ("loses", "thin", "ward") if getattr(graph, name)),
             *(f"{point}={name}" for point, name in sorted(methods.items()))]
    failed = "\n     ".join(line.replace("--", "- -") for line in lines)
    comments = f"<!-- expected: {' '.join(words)} -->\n<!-- {failed} -->"
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace("\n<materialx", f"\n{comments}\n<materialx", 1))


def read(path):
    """:returns: the text, what is expected of it (as a graph has it), and its methods"""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    found = EXPECTED.search(text)
    words = found.group(1).split() if found else []
    nodes = [(node.tag, node.get("type"), node.get("name"), {
        given.get("name"): (given.get("type"), given.get("nodename", ""), given.get("value", "")) for given in node})
        for node in ElementTree.fromstring(text)]
    kinds = [category for category, *_ in nodes]
    expected, methods = SimpleNamespace(bound=1.0, loses=False, thin=False, ward=False, seed=1, nodes=nodes, kinds=[
        kind for kind in kinds if kind in KINDS], layered="layer" in kinds), {}
    for word in words:
        name, equals, value = word.partition("=")
        if name == "bound":
            expected.bound = float(value)
        elif name == "seed":
            expected.seed = int(value)
        elif equals:
            methods[name] = value
        else:
            setattr(expected, name, True)
    return text, expected, methods


def corpus():
    """:returns: paths of all kept graphs"""
    return sorted(os.path.join(CORPUS, name) for name in os.listdir(CORPUS) if name.endswith(".mtlx"))
