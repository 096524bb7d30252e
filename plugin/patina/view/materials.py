"""A material as the page has it: two texts, its inputs, their controls."""
from patina.cli import compiled
from patina.cli.errors import CommandError
from patina.view import controls, glslText, images, live

LONGEST_TEXT = 200000
MOST_TEXTURES = 12  # of 16; the page itself has albedos, environment, lights and parameters
_NOTES = (("subsurface", "subsurface scattering shows as diffuse reflection"),
          ("interior", "what light loses inside the object is not shown"),
          ("displacement", "displacement is not shown"))


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
        raise CommandError(f"{name} is too large for a page: its shader has {len(made['text']) // 1000} thousand "
                           f"characters, and browsers give up on more than {LONGEST_TEXT // 1000} thousand")
    if len(made["textures"]) > MOST_TEXTURES:
        raise CommandError(f"{name} reads {len(made['textures'])} textures, and browsers promise room for "
                           f"{MOST_TEXTURES} beside those of the page")
    return {"text": glslText.material_text(made, count), "presence": made["presence"],
            "parameters": [float(f"{x:.7g}") for x in made["parameters"]], "live": sorted(chosen),
            "textures": [textures.add(found) for found in made["textures"]]}


def build(name, network, methods, textures):
    """
    :param textures: a Textures, which gets those of the material
    :returns: dict for the page, the lobes that its texts use, and warnings as texts
    """
    module = compiled.load()

    def compile_one(changed, largest=1):
        return module.web_material(changed, methods, largest)

    inputs, beyond = live.live_inputs(network)
    chosen = live.lean_choice(network, inputs, compile_one)
    lean = compile_one(live.with_live(network, inputs, chosen), textures.largest)
    material = {"name": name, "lean": _variant(name, lean, chosen, len(inputs), textures), "whole": None,
                "inputs": [{"input": f"{i.node}.{i.name}", "kind": i.kind, "value": list(i.value)} for i in inputs],
                "controls": [controls.entry(i) for i in inputs], "presets": [], "sentence": ""}
    lobes = list(lean["lobes"])
    if len(chosen) < len(inputs):
        whole = compile_one(live.with_live(network, inputs, range(len(inputs))), textures.largest)
        material["whole"] = _variant(name, whole, range(len(inputs)), len(inputs), textures)
        lobes += whole["lobes"]
    notes = [text for key, text in _NOTES if lean[key]] + list(dict.fromkeys(lean["leftOut"]))
    if lean["volumeOnly"]:
        notes.append("a volume without a surface is not shown")
    for found in lean["textures"]:
        if max(found["fullSize"]) > textures.largest:
            notes.append(f"a texture of {found['fullSize'][0]} x {found['fullSize'][1]} is shown smaller")
    if beyond:
        notes.append(f"{beyond} more inputs have no slider")
    material["notes"] = notes
    warnings = [": ".join(part for part in warning if part) for warning in lean["warnings"]]
    return material, lobes, warnings
