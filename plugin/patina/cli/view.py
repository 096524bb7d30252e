# SPDX-License-Identifier: Apache-2.0
"""Writes one HTML page that shows materials in a browser: no server, no network, opens from a file.

The page draws with WebGL2 and the lobes of the rasterizer, and has a slider for every input of the
materials. It shows the shader, which can be changed and compiled there, and the plan, with the change
that other methods would make. It needs Node and npm once, to fetch and bundle the page's script.
"""
import os

from patina.cli import materials, outputs, statistics
from patina.cli.errors import UsageError
from patina.library import page
from patina.view import build

DEMOS = {"classic": "the classic reflectance models as steel and hematite, and the limits of each",
         "layers": "standard_surface with its layers switched on one by one"}


def add_arguments(parser):
    parser.add_argument("material", metavar="MATERIAL", nargs="*", help=materials.EVERY_HELP)
    parser.add_argument("--demo", choices=sorted(DEMOS), help="a page that is part of Patina: " + "; ".join(
        f"{name}, {text}" for name, text in DEMOS.items()))
    parser.add_argument("--library", action="store_true", help="a page of pictures instead: every material of Patina's library "
                                                               "in both back ends, with its source")
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="the page, FILE.html")
    parser.add_argument("--title", metavar="TEXT", help="title of the page (default: the materials' names)")
    parser.add_argument("--environment", action="append", default=[], metavar="FILE",
                        help="latitude-longitude map to light with (repeatable; the first is shown)")
    parser.add_argument("--stage", metavar="STAGE", help="the stage with the lights, domes and shapes (default: the first "
                                                         "MATERIAL that is a stage)")
    parser.add_argument("--shape", action="append", metavar="PRIM",
                        help="a mesh or implicit prim of the stage to look at, besides sphere, shader ball and plane "
                             "(repeatable; default: the first four that show one of the materials)")
    parser.add_argument("--controls", metavar="FILE", help="JSON that says which sliders there are, their labels, "
                                                           "ranges and units, and presets")
    parser.add_argument("--writeControls", metavar="FILE", help="write that JSON as it is, to be edited")
    parser.add_argument("--compare", action="store_true", help="embed a path-traced picture of each material, with a "
                                                               "wipe and the FLIP figure")
    parser.add_argument("--compareShapes", action="store_true", help="--compare on every shape of the page")
    parser.add_argument("--compareWidth", type=int, default=256, metavar="N",
                        help="size of those pictures, and of the library's (default: 256)")
    parser.add_argument("--compareSamples", type=int, default=256, metavar="N", help="samples of those pictures (default: 256)")
    parser.add_argument("--textureSize", type=int, default=1024, metavar="N",
                        help="largest side of textures and environments in the page (default: 1024)")
    materials.add_flags(parser)


def run(arguments):
    if not 16 <= arguments.compareWidth <= 2048 or not 1 <= arguments.compareSamples <= 65536:
        raise UsageError("patina view: --compareWidth is 16 to 2048, --compareSamples 1 to 65536")
    text, warnings = _library(arguments) if arguments.library else _page(arguments)
    statistics.report(warnings, json=False)
    outputs.write_text(arguments.output, text)
    print(f"{arguments.output}: {len(text) / 1e6:.2f} MB")


def _library(arguments):
    if arguments.material or arguments.demo:
        raise UsageError("patina view: --library brings its own materials")
    outputs.check_all([arguments.output])
    return page.document(arguments.compareWidth, arguments.compareSamples)


def _page(arguments):
    if arguments.demo:
        if arguments.material:
            raise UsageError("patina view: --demo brings its own materials")
        folder = os.path.join(os.path.dirname(build.__file__), "demos")
        arguments.material = [os.path.join(folder, arguments.demo + ".usda")]
        arguments.controls = arguments.controls or os.path.join(folder, arguments.demo + ".json")
    if not arguments.material:
        raise UsageError("patina view: no MATERIAL (see patina view --help)")
    if not 1 <= arguments.textureSize <= 4096:
        raise UsageError("patina view: --textureSize is 1 to 4096")
    return build.page_of(arguments)
