# SPDX-License-Identifier: Apache-2.0
"""From the arguments of `patina view` to the text of a page."""
import json

import numpy as np

from patina import messages
from patina.cli import materials as reader
from patina.cli import methods, outputs
from patina.cli.errors import CommandError
from patina.view import blobs, compareImages, controls, layers, materials, page, shapes, stageScene, surroundings

MAX_MATERIALS = 64


class Builder:
    """One page."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.methods = methods.parse(arguments.method)
        self.textures = materials.Textures(arguments.textureSize)
        self.warnings, self.materials, self.lobes, self.networks, self.paths = [], [], [], [], []

    def read(self):
        wanted = self.wanted = controls.read(self.arguments.controls) if self.arguments.controls else {}
        for argument in self.arguments.material:
            found, reading = reader.load(argument, self.arguments.set, every=True)
            self.warnings += reading
            for name, network in found:
                if len(self.materials) == MAX_MATERIALS:
                    raise CommandError(f"a page shows at most {MAX_MATERIALS} materials")
                self._add(reader.split(argument)[0], name, network, wanted)
        _share_presets(self.materials)

    def _add(self, file, name, network, wanted):
        short = name.rpartition("/")[2] or name
        material, used, told = materials.build(short, network, self.methods, self.textures)
        entries, unknown = controls.merged(material["controls"], wanted, self.arguments.controls)
        if unknown and len(self.arguments.material) == 1:
            others = len(unknown) - 1
            self.warnings.append(messages.warning("", "", "pageInputsMissing", name, unknown[0], others) if others
                                 else messages.warning("", "", "pageInputMissing", name, unknown[0]))
        material["presets"] = controls.presets(wanted, material, self.arguments.controls)
        material["controls"] = entries
        material["sentence"] = wanted.get("sentences", {}).get(short, "")
        material["layer"] = layers.of(file, short, *material["layer"], self.arguments.output)
        self.materials.append(material)
        self.lobes += used
        self.networks.append(network)
        self.paths.append(name)
        self.warnings += told

    def surround(self):
        """Lights, shapes, environments and the camera."""
        a = self.arguments
        files = [reader.split(m)[0] for m in a.material]
        file = a.stage or next((f for f in files if not reader.is_document(f)), None)
        scene = stageScene.StageScene(file, () if a.stage else a.set) if file else None
        own = scene.shapes(a.shape or [], set(self.paths)) if scene else []
        if a.shape and not scene:
            raise CommandError("--shape names a prim of a stage: give one with --stage")
        self.z_up = bool(scene and scene.z_up)
        radius, target = stageScene.bounds(*own[0][1:]) if own else (1.0, np.zeros(3))
        self.scene, self.camera_target = scene, target
        self.camera, self.eye = surroundings.camera(radius, target, self.z_up)
        domes = scene.domes if scene else []
        self.environments = surroundings.environments(a.environment, domes, a.textureSize, self.z_up)
        self.shapes = surroundings.built_in_shapes(radius, target, self.z_up)
        self.shapes += [(name, mesh, False, columns) for name, mesh, columns in own]
        self.lights = scene.lights if scene else []
        self.light_table = scene.light_table if scene else np.zeros((0, 4))
        told = scene.warnings if scene else []
        self.notes = [": ".join(filter(None, (messages.place(warning), warning["message"]))) for warning in told]
        self.warnings += told

    def data(self):
        names = [m["name"] for m in self.materials]
        start = {"material": 0, "shape": 0, "environment": 0, "rotation": 0.0, "environmentGain": 1.0,
                 "ambient": [0.0, 0.0, 0.0], "exposure": 0.0, "samples": 64, "backdrop": True,
                 "backdropColor": [0.18, 0.18, 0.18], "eye": self.eye}
        title = self.arguments.title or self.wanted.get("title") or ", ".join(names[:3]) + (" ..." if len(names) > 3 else "")
        return {"title": title, "materials": self.materials, "textures": self.textures.entries,
                "lights": self.lights, "lightTable": blobs.pack(np.asarray(self.light_table, "<f4")),
                "notes": self.notes, "camera": self.camera, "environments": surroundings.shared(self.environments),
                "shapes": [{**shapes.packed(name, mesh, closed), "toWorld": [float(x) for x in columns]}
                           for name, mesh, closed, columns in self.shapes],
                "start": start, "references": compareImages.made(self)}


def _share_presets(found):
    """Materials of the same inputs are presets of each other."""
    kinds = [[(i["input"].rpartition("/")[2], i["kind"]) for i in m["inputs"]] for m in found]
    for m, kind in zip(found, kinds):
        same = [other for other, its in zip(found, kinds) if its == kind]
        if len(same) > 1 and kind:
            m["presets"] += [{"name": other["name"],
                              "values": {mine["input"]: its["value"] for mine, its in zip(m["inputs"], other["inputs"])}}
                             for other in same]


def page_of(arguments):
    """:returns: the page's text, and warnings"""
    outputs.check_all([arguments.output, arguments.writeControls])
    builder = Builder(arguments)
    builder.read()
    builder.surround()
    outputs.check_all([arguments.output, arguments.writeControls])  # now that it is known what is read
    text, warnings = page.document(builder.data(), builder.lobes)
    if arguments.writeControls:
        _write_controls(builder.materials, arguments.writeControls)
    return text, builder.warnings + warnings


def _write_controls(found, path):
    entries = {entry["input"]: entry for material in found for entry in material["controls"]}
    presets = {preset["name"]: {} for material in found for preset in material["presets"]}
    for material in found:
        for preset in material["presets"]:
            presets[preset["name"]].update(preset["values"])
    whole = {"controls": list(entries.values()),
             "presets": [{"name": name, "values": values} for name, values in presets.items()],
             "sentences": {m["name"]: m["sentence"] for m in found if m["sentence"]}}
    outputs.write_text(path, json.dumps(whole, indent=1) + "\n")
