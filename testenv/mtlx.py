# SPDX-License-Identifier: Apache-2.0
"""Documents of MaterialX for tests: nodes by what they hold.

Nodes are a dict of a name to `category`, followed by its type where TYPES has it not, and a dict of inputs. That goes from a
name, or `type name`, to a value, or to `<node>`, whose output is connected. Text stands as it is."""
TYPES = {"standard_surface": "surfaceshader", "surface": "surfaceshader", "surfacematerial": "material"}  # _bsdf: BSDF


def _type_of(category):
    name, _, kind = category.partition(" ")
    return kind or TYPES.get(name, "BSDF")


def _typed(key, value):
    """:returns: type and name of an input"""
    kind, _, name = key.rpartition(" ")
    if not kind and isinstance(value, tuple):
        kind = {2: "vector2", 3: "color3"}[len(value)]
    return kind or {bool: "boolean", str: "string"}.get(type(value), "float"), name


def _port(tag, name, kind, **attributes):
    return "".join([f'<{tag} name="{name}" type="{kind}"', *(f' {key}="{value}"' for key, value in attributes.items()), "/>"])


def _value(value):
    if isinstance(value, tuple):
        return ", ".join(map(str, value))
    return str(value).lower() if isinstance(value, bool) else value


def _elements(nodes, around=None):
    """:param around: type of each input of the graph that holds the nodes: `<input>` stands for it"""
    types = {name: _type_of(category) for name, (category, _) in nodes.items()}
    lines = []
    for name, (category, inputs) in nodes.items():
        tag, ports = category.split()[0], []
        for key, value in inputs.items():
            if isinstance(value, str) and value.startswith("<"):
                source, (kind, _, own) = value[1:-1], key.rpartition(" ")
                link = "interfacename" if source in (around or {}) else "nodename"
                ports.append(_port("input", own, kind or {**(around or {}), **types}[source], **{link: source}))
            else:
                kind, own = _typed(key, value)
                ports.append(_port("input", own, kind, value=_value(value)))
        lines.append(f'<{tag} name="{name}" type="{types[name]}">{"".join(ports)}</{tag}>\n')
    return "".join(lines)


def document(*parts, attributes=""):
    """:param parts: nodes, and elements as text, which stand before them"""
    texts = [part for part in parts if isinstance(part, str)]
    nodes = {name: node for part in parts if not isinstance(part, str) for name, node in part.items()}
    head = f'<?xml version="1.0"?>\n<materialx version="1.39"{attributes and " " + attributes}>\n'
    return head + "".join(texts) + _elements(nodes) + "</materialx>\n"


def model(node, inputs, nodes, **outputs):
    """A node that others make. :param inputs: its inputs and their defaults
    :param outputs: the nodes that give them
    :returns: its definition and its graph, as text"""
    given = [(*_typed(key, value), value) for key, value in inputs.items()]
    kinds = {name: _type_of(nodes[source][0]) for name, source in outputs.items()}
    ports = [_port("input", name, kind, value=_value(value)) for kind, name, value in given]
    ports += [_port("output", name, kind) for name, kind in kinds.items()]
    ends = [_port("output", name, kind, nodename=outputs[name]) for name, kind in kinds.items()]
    held = _elements(nodes, {name: kind for kind, name, _ in given}) + "".join(ends)
    return (f'<nodedef name="ND_{node}" node="{node}">{"".join(ports)}</nodedef>\n'
            f'<nodegraph name="NG_{node}" nodedef="ND_{node}">\n{held}</nodegraph>\n')


def shader(material, category="standard_surface", inputs=None, node="s"):
    """:returns: the nodes of a material of one surface shader"""
    return {node: (category, inputs or {}), material: ("surfacematerial", {"surfaceshader": f"<{node}>"})}


def lobe(material, category, inputs, node="lobe"):
    """:returns: the nodes of a material of one lobe"""
    return {node: (category, inputs), **shader(material, "surface", {"bsdf": f"<{node}>"})}
