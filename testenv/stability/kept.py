# SPDX-License-Identifier: Apache-2.0
"""Graphs that failed once, kept as documents: what may be expected of one stands in a comment, with what failed. The word
`raster` there has both back ends compared; `seed` is that of the graph, which chooses the random places of a look."""
import re
import xml.etree.ElementTree as ElementTree
from types import SimpleNamespace

import graphText

KINDS = {*graphText.BSDFS, *graphText.EDFS, *graphText.VDFS, *graphText.MORE}
EXPECTED = re.compile(r"<!-- expected: (.*) -->")


def noted(text, graph, methods, lines):
    """:param graph: with bound, seed, loses, thin and ward, as graphText.Graph
    :param lines: what failed
    :returns: the document with its comments
    """
    words = [f"bound={graph.bound:g}", f"seed={graph.seed}",
             *(name for name in ("loses", "thin", "ward") if getattr(graph, name)),
             *(f"{point}={name}" for point, name in sorted(methods.items()))]
    failed = "\n     ".join(line.replace("--", "- -") for line in lines)
    return text.replace("\n<materialx", f"\n<!-- expected: {' '.join(words)} -->\n<!-- {failed} -->\n<materialx", 1)


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
