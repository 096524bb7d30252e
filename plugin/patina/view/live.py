# SPDX-License-Identifier: Apache-2.0
"""Makes the inputs of a network live: each becomes a primvar of its own whose fallback is the
authored value. So the text of the material keeps them open, the page hands in what its sliders say,
and every other host, which has no such primvars, shows the material as authored."""
import collections
import math
from patina import networks
from patina.cli.compiled import _patina


PREFIX = "patinaLive"
COMPONENTS = {"boolean": 1, "integer": 1, "float": 1, "vector2": 2, "vector3": 3, "vector4": 4, "color3": 3, "color4": 4}
LIMIT = 1024  # more would be neither found nor compiled


LiveInput = collections.namedtuple("LiveInput", "node name kind value authored")  # of a node, moved by a slider


def _numbers(value):
    """Floats of single precision in as few digits as tell them; none where one of them is no finite number."""
    numbers = [value] if isinstance(value, (int, float, str)) else value
    try:
        found = [float(f"{float(x):.7g}") for x in numbers]
    except (TypeError, ValueError):
        return []
    return found if all(map(math.isfinite, found)) else []


def linear(value):
    """:param value: an input of Network.nodes()
    :returns: its value, a colour's in linear Rec.709"""
    if not value["type"].startswith("color") or not value["color_space"]:
        return value["value"]
    return _patina.color_to_rendering(value["value"], value["color_space"]) or value["value"]


def reachable(network):
    """Nodes that the surface is made of, the surface first."""
    nodes = {node["path"]: node for node in network.nodes()}
    terminal = network.terminals().get("surface")
    queue, seen = [terminal[0]] if terminal else [], set()
    for path in queue:  # grows as it goes
        if path in nodes and path not in seen:
            seen.add(path)
            queue += [source for source, _ in nodes[path]["connections"].values()]
    return [nodes[path] for path in dict.fromkeys(queue) if path in nodes]


def live_inputs(network, limit=LIMIT):
    """Booleans and integers are among them where the program reads them as it runs.

    :returns: list of LiveInput of the nodes below the surface, and how many there were beyond the limit
    """
    found = []
    for node in reachable(network):
        types, defaults = _patina.node_inputs(node["id"]), _patina.node_defaults(node["id"])
        for name, kind in types.items():
            if kind not in COMPONENTS or name in node["connections"]:
                continue
            authored = node["inputs"].get(name)
            if authored is None and name not in defaults:
                continue
            value = _numbers(linear(authored) if authored else defaults[name])
            if len(value) == COMPONENTS[kind]:
                found.append(LiveInput(node["path"], name, kind, value, authored is not None))
    found = _without_plans(network, found)
    # Authored inputs come before those left at their defaults.
    ranked = sorted(range(len(found)), key=lambda i: (not found[i].authored, i))
    kept = sorted(ranked[:limit])
    return _without_warnings(network, [found[i] for i in kept]), len(found) - len(kept)


def _without_warnings(network, found):
    """Leaves out what is told of only because it is open: inputs that are not shown, where they ask for nothing."""
    compile_one = _patina.web_material

    def told(changed):
        made = compile_one(changed, {}, 1)
        return ({(w["prim"], w["input"], w["message"]) for w in made["warnings"]}
                | {item for item in made["leftOut"] if item[0] == "dispersionLeftOut"})

    reported = told(network)
    kept = _fitting(list(range(len(found))), lambda chosen: reported.issuperset(told(with_live(network, found, chosen))))
    return [found[i] for i in kept]


def _fitting(group, fits, kept=()):
    """Those of a group that fit together, found by halves.

    :param fits: of a list, which holds `kept` too
    """
    kept = list(kept)
    if not group or fits(kept + group):
        return group
    half = len(group) // 2
    if not half:
        return []
    left = _fitting(group[:half], fits, kept)
    return left + _fitting(group[half:], fits, kept + left)


def _without_plans(network, found):
    """Leaves out booleans and integers that decide what the program is."""
    whole = [i for i, live_input in enumerate(found) if live_input.kind in ("boolean", "integer")]
    if not whole:
        return found
    compile_one = _patina.web_material
    calm = len(compile_one(network, {}, 1)["warnings"])
    made = compile_one(with_live(network, found, whole), {}, 1)
    names = {name for name, _ in made["primvars"]} if len(made["warnings"]) <= calm else set()
    return [live_input for i, live_input in enumerate(found)
            if live_input.kind not in ("boolean", "integer") or f"{PREFIX}{i}" in names]


def with_live(network, inputs, chosen):
    """A copy of the network with inputs[i] live for i in chosen; primvar PREFIX<i>."""
    opened = {(inputs[i].node, inputs[i].name): i for i in chosen}
    copy = networks.copied(network, opened)
    for (node, name), i in opened.items():
        kind, value = inputs[i].kind, inputs[i].value
        whole = int(value[0]) if kind in ("boolean", "integer") else value[0]
        source = networks.add(copy, f"<{PREFIX}{i}>", f"ND_geompropvalue_{kind}", {
            "geomprop": ("string", f"{PREFIX}{i}"), "default": (kind, whole if len(value) == 1 else value)})
        copy.connect(node, name, source, "")
    for name, (node, output) in network.terminals().items():
        copy.set_terminal(name, node, output)
    return copy


def shape_of(material):
    """The key of a driver's work: the lobes, and whether the surface may be absent."""
    return material["lobes"], material["presence"], material["emission"]


def lean_choice(network, inputs, compile_one, guess=()):
    """The inputs that may be live without a lobe more than the material as authored has.

    :param guess: taken where it fits
    """
    wanted = shape_of(compile_one(network))

    def fits(chosen):
        return shape_of(compile_one(with_live(network, inputs, chosen))) == wanted

    if guess and fits(list(guess)):
        return guess
    return _fitting(list(range(len(inputs))), fits)
