# SPDX-License-Identifier: Apache-2.0
"""Networks that are made here, node by node."""


def add(network, path, identifier, inputs=None, /, **connections):
    """Adds a node.

    :param inputs: dict of name -> (type, value), or (type, value, colour space)
    :param connections: name -> path of the node that it is connected to, or (path, output)
    :returns: its path"""
    network.add_node(path, identifier)
    for name, value in (inputs or {}).items():
        network.set_input(path, name, *value)
    for name, source in connections.items():
        network.connect(path, name, *([source] if isinstance(source, str) else source))
    return path


def copied(network, without=()):
    """:param without: (path of a node, name of its input) that the copy has not
    :returns: a copy of its nodes, without terminals"""
    copy = type(network)(network.path)
    for node in network.nodes():
        inputs = {name: (value["type"], value["value"], value["color_space"]) for name, value in node["inputs"].items()
                  if (node["path"], name) not in without}
        add(copy, node["path"], node["id"], inputs, **node["connections"])
    return copy
