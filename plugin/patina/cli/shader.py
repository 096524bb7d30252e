# SPDX-License-Identifier: Apache-2.0
"""Writes a material as shader text for another renderer, or as a MaterialX document.

  patina shader brass.mtlx --target glsl                            to standard output
  patina shader set.usda:/looks/brass --target mtlx --output brass.mtlx
  patina shader brass.mtlx --target osl --output brass.osl

glsl and essl are Patina's own: the functions that its rasterizer and its pages run, with every sample and density. The others
are made by MaterialX's generators (PyPI's materialx, which this command installs) from the expanded graph. That is the material
after shading models are replaced by their graphs, constants are folded, and parts that no light reaches are dropped. mtlx
writes that graph, or with --form authored the nodes as authored, whatever file they are from.

A text describes one material, so --set is applied first. For a language with several stages the pixel stage is written;
--stage chooses another.
"""
import sys

from patina.cli import materials, methods, outputs, statistics
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError, UsageError
from patina.shader import document, generators, own
from patina.view import albedo

OWN = ("glsl", "essl")
GENERATED = ("osl", "mdl", "msl")
EXTENSIONS = (".mtlx",)


def add_arguments(parser):
    parser.add_argument("material", metavar="MATERIAL", help=materials.MATERIAL_HELP)
    parser.add_argument("--target", required=True, choices=OWN + GENERATED + ("mtlx",), metavar="LANGUAGE",
                        help="glsl (4.50), essl (GLSL ES 3.00), osl, mdl, msl or mtlx (MaterialX 1.39)")
    parser.add_argument("--output", metavar="FILE", help="file to write (default: standard output)")
    parser.add_argument("--form", default="expanded", choices=["expanded", "authored"],
                        help="for mtlx: the expanded graph, or the nodes as authored (default: expanded)")
    parser.add_argument("--stage", default="pixel", choices=["pixel", "vertex"],
                        help="for msl: the stage to write (default: pixel)")
    parser.add_argument("--largestTexture", type=int, default=1024, metavar="N", dest="largest_texture",
                        help="for glsl and essl: largest side of the textures that --json describes (default: 1024)")
    parser.add_argument("--albedoTable", metavar="FILE.exr", dest="albedo_table",
                        help="for glsl and essl: write the table that lobes look up")
    materials.add_flags(parser)
    parser.add_argument("--json", metavar="FILE", help="write text, textures and primvars as JSON: --json to standard output, "
                                                       "--json=FILE to a file")


def run(arguments):
    _check_usage(arguments)
    found, warnings = materials.load(arguments.material, arguments.set)
    name, network = found[0]
    if arguments.output:
        outputs.check(arguments.output, EXTENSIONS if arguments.target == "mtlx" else ())
    outputs.check_all([arguments.output, arguments.json, arguments.albedo_table])
    report = {"material": name, "target": arguments.target}
    if arguments.target in OWN:
        report.update(_own(network, arguments, warnings))
    else:
        report.update(_of_document(name, network, arguments, warnings))
    report["warnings"] = warnings
    if arguments.output:
        outputs.write_text(arguments.output, report["text"])
    if not outputs.write_json(arguments.json, report) and not arguments.output:
        sys.stdout.write(report["text"])
    statistics.report(warnings, json=bool(arguments.json))


def _check_usage(arguments):
    if not 1 <= arguments.largest_texture <= 16384:
        raise UsageError("patina shader: --largestTexture is 1 to 16384")
    if arguments.target not in OWN and (arguments.method or arguments.albedo_table):
        raise UsageError("patina shader: --method and --albedoTable are for glsl and essl; the others have methods of "
                         "their own")
    if arguments.form == "authored" and arguments.target != "mtlx":
        raise UsageError("patina shader: --form authored is for mtlx; shader text is made from the expanded graph")
    if arguments.stage != "pixel" and arguments.target != "msl":
        raise UsageError(f"patina shader: {arguments.target} has one stage")


def _own(network, arguments, warnings):
    text, material = own.shader(network, arguments.target, methods.parse(arguments.method), arguments.largest_texture)
    warnings += material["warnings"]
    if arguments.albedo_table:
        _write_table(arguments.albedo_table)
    return {"text": text, "leftOut": [said for _, said in material["leftOut"]],
            "primvars": [list(pair) for pair in material["primvars"]],
            "textures": [{"file": texture["file"], "wrap": list(texture["wrap"]), "nearest": texture["nearest"],
                          "size": list(reversed(texture["texels"].shape[:2]))} for texture in material["textures"]],
            "parameterTable": list(material["parameters"])}


def _write_table(path):
    with outputs.Together() as files:
        _patina.write_image(files.add(path), albedo.in_rows(_patina.albedo_table())[..., None])


def _of_document(name, network, arguments, warnings):
    if arguments.form == "expanded":
        network, found = _patina.expand_material(network)
        warnings += found
    try:
        text = document.document(network, name.rstrip("/").rpartition("/")[2], warnings)
    except document.Unwritable as error:
        raise CommandError(f"{arguments.material}: {error}") from error
    return {"text": text} if arguments.target == "mtlx" else _generated(text, arguments, warnings)


def _generated(text, arguments, warnings):
    if not generators.installed():
        raise CommandError(f"--target {arguments.target}: MaterialX's generators are missing; `pip install materialx` has them")
    text = generators.harmless(text, warnings)
    try:
        stages = generators.generate(text, arguments.target)
    except generators.NotGenerated as error:
        raise CommandError(f"{arguments.material}: MaterialX {generators.version()} cannot write it as {arguments.target}: "
                           f"{error}") from error
    if arguments.stage not in stages:
        raise CommandError(f"--stage {arguments.stage}: MaterialX has written no such stage")
    return {"text": stages[arguments.stage], "stages": stages}
