# SPDX-License-Identifier: Apache-2.0
"""A network as a MaterialX 1.39 document."""
import re
import struct
import xml.etree.ElementTree as tree

from patina import messages
from patina.cli.compiled import _patina
from patina.shader import standardNames

VERSION = "1.39"
SURFACES = {"surface": ("surfaceshader", "surfaceshader"), "displacement": ("displacementshader", "displacementshader"),
            "volume": ("volumeshader", "volumeshader")}  # terminal -> (input of a material, its type)
IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
UNCONTROLLED = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")  # XML 1.0 has no way to write these


class Unwritable(ValueError):
    """A network that no document can hold; the message says why."""


def document(network, name="", warnings=None):
    """
    :param network: a `_patina.Network`
    :param name: of the material; default: that of the network
    :param warnings: list that gets what the document says otherwise than the network
    :returns: text of the document
    :raises Unwritable: for a network without terminals, a node without a definition, values that no node converts
    """
    nodes, terminals = network.nodes(), network.terminals()
    if not terminals:
        raise Unwritable(f"{network.path} has no terminals")
    taken = set()
    own = _unique(name or network.path.rstrip("/").rpartition("/")[2].rpartition(":")[2] or "material", taken)
    names = {node["path"]: _unique(node["path"].strip("/").replace("/", "_"), taken) for node in nodes}
    root = tree.Element("materialx", version=VERSION, colorspace="lin_rec709")
    writer = _Writer(root, nodes, names, taken)
    for node in nodes:
        writer.add(node)
        if warnings is not None and node["id"] in standardNames.SIMPLER:
            warnings.append(messages.warning(network.path, "", standardNames.SIMPLER[node["id"]]))
    volume = [terminals["volume"]] if "volume" in terminals else []
    surfaces = [key for key in ("surface", "displacement") if key in terminals]
    if surfaces:
        material = tree.SubElement(root, "surfacematerial", name=own, type="material")
        for key in surfaces:
            writer.connect(material, *SURFACES[key], terminals[key])
    if volume:
        inside = tree.SubElement(root, "volumematerial", type="material",
                                 name=_unique(own + "_volume", taken) if surfaces else own)
        writer.connect(inside, *SURFACES["volume"], volume[0])
    tree.indent(root)
    return '<?xml version="1.0"?>\n' + tree.tostring(root, encoding="unicode") + "\n"


class _Writer:
    """Adds the nodes of a network to a document, in the names of MaterialX's library."""

    def __init__(self, root, nodes, names, taken):
        """:param names: of path, in the document; :param taken: names that stand for something"""
        self._root, self._names, self._taken = root, names, taken
        self._definitions = {node["path"]: _definition(node) for node in nodes}
        self._used = {node["path"]: set() for node in nodes}  # outputs that others are connected to
        for node in nodes:
            for source, output in node["connections"].values():
                self._used.setdefault(source, set()).add(output)

    def add(self, node):
        definition = self._definitions[node["path"]]
        outputs = definition["outputs"]
        category, nodedef = standardNames.RENAMED.get(definition["id"], (definition["category"], definition["id"]))
        element = tree.Element(category, name=self._names[node["path"]], nodedef=nodedef,
                               type=outputs[0][1] if len(outputs) == 1 else "multioutput")
        types, unknown = dict(definition["inputs"]), standardNames.UNKNOWN_INPUTS.get(nodedef, ())
        words = standardNames.RENAMED_INPUTS.get(category, {})
        inputs = node["inputs"]
        if nodedef == standardNames.TEXTURE:
            inputs = standardNames.texture_inputs(inputs, self._used[node["path"]])
        for key, value in inputs.items():
            if key in node["connections"] or key in unknown:
                continue
            kind = types.get(key, value["type"])
            attributes = {"name": _clean(words.get(key, key)), "type": kind, "value": text_of(value["value"], kind)}
            if value["color_space"]:
                attributes["colorspace"] = _clean(value["color_space"])
            tree.SubElement(element, "input", attributes)
        for key, connection in node["connections"].items():
            if key not in unknown:
                self.connect(element, words.get(key, key), types.get(key, ""), connection)
        self._root.append(element)  # behind the nodes that convert for it

    def connect(self, element, key, kind, connection):
        source, output = connection
        if source not in self._names:
            raise Unwritable(f"{key} is connected to {source}, which is not there")
        outputs = self._definitions[source]["outputs"]
        found = dict(outputs).get(output, outputs[0][1])
        place = {"nodename": self._names[source]}
        if len(outputs) > 1:
            place["output"] = _clean(output or outputs[0][0])
        if kind and found != kind:
            place = self._convert(place, found, kind, key)
        tree.SubElement(element, "input", {"name": _clean(key), "type": kind or found, **place})

    def _convert(self, place, found, kind, key):
        if (found, kind) not in standardNames.CONVERTED:
            raise Unwritable(f"{key}: MaterialX has no node that makes {kind} of {found}")
        name = _unique(f"{place['nodename']}_{kind}", self._taken)
        element = tree.SubElement(self._root, "convert", name=name, type=kind, nodedef=f"ND_convert_{found}_{kind}")
        tree.SubElement(element, "input", {"name": "in", "type": found, **place})
        return {"nodename": name}


def _definition(node):
    definition = _patina.node_definition(node["id"])
    if definition is None:
        raise Unwritable(f"{node['path']}: the node {node['id']} has no definition")
    return definition


def text_of(value, kind):
    """:returns: a value as MaterialX writes it"""
    if kind == "boolean":
        return "true" if value else "false"
    if isinstance(value, str):
        return _clean(value)
    numbers = value if isinstance(value, (list, tuple)) else [value]
    return ", ".join(str(int(x)) if kind == "integer" else _number(x) for x in numbers)


def _number(x):
    """The shortest text that reads back as the same float."""
    for digits in range(6, 10):
        text = f"{x:.{digits}g}"
        if _single(float(text)) == _single(x):
            return text
    return repr(float(x))


def _single(x):
    return struct.unpack("f", struct.pack("f", x))[0] if abs(x) < 3e38 else x


def _clean(text):
    return UNCONTROLLED.sub("?", text)


def _unique(text, taken):
    name = re.sub(r"[^A-Za-z0-9_]", "_", text) or "node"
    if not IDENTIFIER.fullmatch(name):
        name = "n" + name
    candidate, number = name, 1
    while candidate in taken:
        number += 1
        candidate = f"{name}_{number}"
    taken.add(candidate)
    return candidate
