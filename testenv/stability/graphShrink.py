# SPDX-License-Identifier: Apache-2.0
"""Makes a graph that fails smaller: closures give way to one of their parts, inputs to their defaults, numbers to rounder
ones."""

CLOSURES = ("BSDF", "EDF", "VDF")
ROUND = {"float": ("1", "0.5"), "color3": ("1, 1, 1", "0.5, 0.5, 0.5"), "vector2": ("1, 1", "0.5, 0.5")}


def reached(nodes):
    """:returns: those that the last node, the material, needs; in the same order"""
    needed, left = {nodes[-1][2]}, []
    for node in reversed(nodes):
        if node[2] in needed:
            needed.update(source for _, source, _ in node[3].values() if source)
            left.append(node)
    return left[::-1]


def _without(nodes, name, part):
    """:returns: nodes where `part` takes the place of the node `name`"""
    return reached([(category, kind, own, {key: (type_, part if source == name else source, value)
                                           for key, (type_, source, value) in inputs.items()})
                    for category, kind, own, inputs in nodes])


def _with(nodes, at, inputs):
    category, kind, name, _ = nodes[at]
    return reached([*nodes[:at], (category, kind, name, inputs), *nodes[at + 1:]])


def smaller(nodes):
    """:returns: iterable of graphs with one thing less, the largest steps first"""
    for _, kind, name, inputs in reversed(nodes):
        if kind in CLOSURES:
            for type_, source, _ in inputs.values():
                if type_ == kind and source:
                    yield _without(nodes, name, source)
    for at in range(len(nodes) - 1, -1, -1):
        inputs = nodes[at][3]
        for key in inputs:
            if nodes[at][1] != "material":
                yield _with(nodes, at, {k: v for k, v in inputs.items() if k != key})
    for at in range(len(nodes) - 1, -1, -1):
        inputs = nodes[at][3]
        for key, (type_, source, value) in inputs.items():
            for rounder in ROUND.get(type_, ()):
                if source or value not in ROUND[type_]:
                    yield _with(nodes, at, {**inputs, key: (type_, "", rounder)})


def smallest(nodes, fails, tries=600):
    """:param fails: whether nodes still fail in the same way
    :param tries: the most graphs that are tried
    :returns: nodes that fail, none of whose smaller() ones does (but for `tries`)
    """
    while True:
        for candidate in smaller(nodes):
            if tries == 0:
                return nodes
            tries -= 1
            if fails(candidate):
                nodes = candidate
                break
        else:
            return nodes


def fewest(methods, fails):
    """:returns: methods that fail, without those that it fails without"""
    for point in list(methods):
        without = {key: name for key, name in methods.items() if key != point}
        if fails(without):
            methods = without
    return methods
