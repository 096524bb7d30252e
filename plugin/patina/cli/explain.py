"""Shows what becomes of a material: its network as authored, the simplified graph, the plan of
lobes, what was left out, and the method at each choice point that matters. Of a stage without a named
material all materials are shown.
"""
import json
import sys

from patina.cli import compiled, materials, methods, statistics


def add_arguments(parser):
    parser.add_argument("material", metavar="STAGE|MATERIAL", help=materials.MATERIAL_HELP.replace(
        "the only material", "every material"))
    parser.add_argument("--set", action="append", default=[], metavar="PRIM.INPUT=VALUE",
                        help="change an input before (repeatable)")
    methods.add_flag(parser)
    parser.add_argument("--json", metavar="FILE", help="write texts and warnings as JSON: --json to standard "
                                                       "output, --json=FILE to a file")


def run(arguments):
    found, warnings = materials.load(arguments.material, arguments.set, every=True)
    module = compiled.load()
    chosen = methods.parse(arguments.method)
    texts = [(name, module.explain_material(network, warnings, chosen)) for name, network in found]
    if arguments.json:
        text = json.dumps({"materials": [{"name": name, "text": text} for name, text in texts],
                           "warnings": warnings}, indent=2)
        if arguments.json == "-":
            print(text)
        else:
            with open(arguments.json, "w", encoding="utf-8") as file:
                file.write(text + "\n")
        return
    for i, (name, text) in enumerate(texts):
        if len(texts) > 1:
            print(("\n" if i else "") + f"=== {name}")
        print(text.rstrip("\n"))
    for line in statistics.lines(warnings):
        print("warning: " + line, file=sys.stderr)
