# SPDX-License-Identifier: Apache-2.0
"""A material as the page has it: two texts, its inputs, their controls."""
from patina import messages
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError
from patina.view import choices, controls, glslText, images, live, plan

LONGEST_TEXT = 200000
MAX_TEXTURES = 12  # of 16; the page itself has albedos, environment, lights and parameters
_NOTES = (("subsurface", "subsurface scattering shows as diffuse reflection"),
          ("interior", "what light loses inside the object is not shown"),
          ("displacement", "displacement is not shown"))


class TooLarge(CommandError):
    """A shader that browsers would not take."""


class Textures:
    """The textures of a page, each once."""

    def __init__(self, largest):
        self.largest, self.entries, self._known = largest, [], {}

    def add(self, found):
        entry = images.texture(found)
        key = (entry["data"], tuple(entry["wrap"]), entry["nearest"])
        if key not in self._known:
            self._known[key] = len(self.entries)
            self.entries.append(entry)
        return self._known[key]


def _variant(name, made, chosen, count, textures):
    if len(made["text"]) > LONGEST_TEXT:
        raise TooLarge(f"{name} is too large for a page: its shader has {len(made['text']) // 1000} thousand "
                           f"characters, and browsers give up on more than {LONGEST_TEXT // 1000} thousand")
    if len(made["textures"]) > MAX_TEXTURES:
        raise CommandError(f"{name} reads {len(made['textures'])} textures, and browsers promise room for "
                           f"{MAX_TEXTURES} beside those of the page")
    return {"text": glslText.material_text(made, count), "presence": made["presence"],
            "parameters": [float(f"{x:.7g}") for x in made["parameters"]], "live": sorted(chosen),
            "textures": [textures.add(found) for found in made["textures"]]}


def _program(name, network, inputs, compile_one, textures, guess):
    """The two texts of a network, what its page needs to know of them, and the lean one's live inputs."""
    chosen = live.lean_choice(network, inputs, compile_one, guess)
    return *_texts(name, _networks(network, inputs, chosen), len(inputs), compile_one, textures), chosen


def _networks(network, inputs, chosen):
    """:returns: those of the lean text and, where it has not all inputs, of the whole one, each with its live inputs"""
    every = [chosen] + ([range(len(inputs))] if len(chosen) < len(inputs) else [])
    return [(live.with_live(network, inputs, some), some) for some in every]


def _texts(name, networks, count, compile_one, textures):
    found = [compile_one(network, textures.largest) for network, _ in networks]
    texts = [_variant(name, text, some, count, textures) for text, (_, some) in zip(found, networks)]
    made = {"lean": texts[0], "whole": texts[1] if len(texts) > 1 else None}
    return made, found[0], [lobe for text in found for lobe in text["lobes"]]


def _authored(name, network, compile_one, textures):
    """As many inputs are live as leave the texts short enough."""
    limit = live.LIMIT
    while True:
        inputs, beyond = live.live_inputs(network, limit)
        try:
            return inputs, beyond, _program(name, network, inputs, compile_one, textures, ())
        except TooLarge:
            if not inputs:
                raise
            limit = min(limit, len(inputs)) // 4


def build(name, network, methods, textures):
    """
    :param textures: a Textures, which gets those of the material
    :returns: dict for the page, the lobes that its texts use, and warnings as texts
    """

    def compiler(forced):
        return lambda changed, largest=1: _patina.web_material(changed, forced, largest)

    compile_one = compiler(methods)
    inputs, beyond, (made, lean, lobes, chosen) = _authored(name, network, compile_one, textures)
    found, fixed = choices.find(network, inputs)
    wanted, left = choices.combinations(found)
    programs, places = [made], {",".join(map(str, wanted[0])): 0}
    for picked in wanted[1:]:
        changed = choices.with_choices(network, found, picked)
        try:
            other, _, more, _ = _program(name, changed, inputs, compile_one, textures, chosen)
        except CommandError:  # this value has no program, and the page says so
            continue
        if other not in programs:
            programs.append(other)
        places[",".join(map(str, picked))] = programs.index(other)
        lobes += more

    networks = _networks(network, inputs, chosen)

    def with_methods(forced):
        made, _, more = _texts(name, networks, len(inputs), compiler(forced), textures)
        return made, more

    def add(made, more):
        lobes.extend(more)
        programs.append(made)
        return len(programs) - 1

    fixed += [choices.Fixed(c.node, c.name, c.options[c.at][0], "every value is a program of its own, and "
                            f"a page has room for {choices.MAX_PROGRAMS} of them")
              for c in (found[i] for i in left)]
    entries = controls.entries(inputs, [c for i, c in enumerate(found) if i not in left], fixed)
    planned = {**plan.build(network, methods, with_methods, add),
               "effects": plan.effects(network, inputs, chosen, entries, methods)}
    material = {"name": name, "programs": programs, "places": places,
                "inputs": [{"input": controls.key(i), "kind": i.kind, "value": list(i.value)} for i in inputs],
                "choices": [{"input": controls.key(c), "kind": c.kind, "values": [v for _, v in c.options], "at": c.at}
                            for c in found],
                "controls": entries,
                "presets": [], "sentence": "", "plan": planned}
    notes = [text for key, text in _NOTES if lean[key]] + list(dict.fromkeys(text for _, text in lean["leftOut"]))
    if lean["volumeOnly"]:
        notes.append("a volume without a surface is not shown")
    for image in lean["textures"]:
        if max(image["fullSize"]) > textures.largest:
            notes.append(f"a texture of {image['fullSize'][0]} x {image['fullSize'][1]} is shown smaller")
    if beyond:
        notes.append(f"{beyond} more inputs have no slider")
    material["notes"] = notes
    warnings = [messages.warning(network.path, "", id_) for id_, _ in lean["leftOut"]
                if id_ in ("notANumberIsZero", "dispersionLeftOut")]
    warnings += lean["warnings"]
    material["layer"] = (network, inputs, found)
    return material, lobes, warnings
