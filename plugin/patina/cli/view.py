"""Writes one HTML page that shows materials in a browser: no server, no network, opens from a file.

The page draws with WebGL2, by the very lobes of the rasterizer, and has a slider for every input of
the materials. It needs Node and npm once, to fetch and bundle what the page is made of.
"""
import os
import sys

from patina.cli import materials, methods, statistics
from patina.cli.errors import CommandError, UsageError

LARGEST_PAGE_MATERIALS = 64


def add_arguments(parser):
    parser.add_argument("material", metavar="MATERIAL", nargs="+", help=materials.MATERIAL_HELP.replace(
        "the only material", "every material"))
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="the page, FILE.html")
    parser.add_argument("--title", metavar="TEXT", help="of the page (default: the materials' names)")
    parser.add_argument("--environment", action="append", default=[], metavar="FILE",
                        help="latitude-longitude map to light with (repeatable; the first is shown)")
    parser.add_argument("--textureSize", type=int, default=1024, metavar="N",
                        help="largest side of textures and environments in the page (default: 1024)")
    parser.add_argument("--set", action="append", default=[], metavar="PRIM.INPUT=VALUE",
                        help="change an input before (repeatable)")
    methods.add_flag(parser)


def run(arguments):
    from patina.view import build

    if not 1 <= arguments.textureSize <= 4096:
        raise UsageError("patina view: --textureSize is 1 to 4096")
    text, warnings = build.page_of(arguments)
    for line in warnings:
        print("warning: " + line, file=sys.stderr)
    temporary = f"{arguments.output}.{os.getpid()}.tmp"
    try:
        with open(temporary, "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(temporary, arguments.output)
    except OSError as error:
        raise CommandError(f"cannot write {arguments.output}: {error.strerror}") from error
    print(f"{arguments.output}: {len(text) / 1e6:.2f} MB")
