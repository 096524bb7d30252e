# SPDX-License-Identifier: Apache-2.0
"""Makes an image of the parts of a frame (`patina record --part`), with the bits of the frame rendered at once.

  patina record shot.usda shot.exr --part 1/2 --partial shot.1.part
  patina record shot.usda shot.exr --part 2/2 --partial shot.2.part
  patina merge shot.1.part shot.2.part shot.exr

Each part describes how it was made: the stage with all of its layers and textures, the settings, the version and the
instruction set. Parts that do not belong together are refused, and missing ones are named. The channels of the image follow
from the flags that the parts were made with.
"""
import contextlib
import os
import tempfile

from patina import inputs, limits
from patina.cli import frames, outputs
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError
from patina.cli.progress import Progress
from patina.farm import merging, missing, parts


def add_arguments(parser):
    parser.add_argument("files", metavar="FILE", nargs="+", help="parts of one frame, in any order")
    parser.add_argument("image", metavar="IMAGE", help="the image to write, in any format that `patina record` writes; "
                                                      "a place for frames (###) takes the parts' frame")
    parser.add_argument("--renderMissing", action="store_true",
                        help="render the parts that are missing, here and with the flags of the others, beside IMAGE")
    parser.add_argument("--allowMixed", action="store_true",
                        help="take parts of other builds and instruction sets: the image has no defined bits then")
    parser.add_argument("--threads", type=int, default=0, metavar="N", help="threads (default: all cores)")
    limits.add_flag(parser)
    parser.add_argument("--json", metavar="FILE",
                        help="statistics of the frame: --json to standard output, --json=FILE to a file")
    parser.add_argument("--quiet", "-q", action="store_true", help="errors only")


def run(arguments):
    found = parts.Parts(arguments.files, arguments.allowMixed)
    _note(arguments.files, found.first)
    if frames.has_place(arguments.image) and found.first.frame is not None:
        arguments.image = frames.image_name(arguments.image, found.first.frame, found.first.decimals)
    outputs.check_all([arguments.image, arguments.json])
    _patina.check_image_path(arguments.image)
    absent = found.missing()
    if absent and not arguments.renderMissing:
        raise CommandError(f"{parts.names(absent)} (--renderMissing renders them)")
    with _folder_beside(arguments.image) if absent else contextlib.nullcontext() as folder:
        made = []
        for part in absent:
            made.append(os.path.join(folder, f"{part.number}.part"))
            Progress("", arguments.quiet).say(f"rendering part {part}")
            missing.render(found.first, part, made[-1], arguments)
        if made:
            found = parts.Parts(arguments.files + made, arguments.allowMixed)
            _note(arguments.files, found.first)
        reported = merging.merge(found, arguments.image, arguments.threads)
    if arguments.json:
        reported.write(arguments.json)


def _note(files, description):
    """So that the image is written over none of them, and over nothing that the parts were made of."""
    for file in files:
        inputs.note(file)
    for name in description.identity["files"]:
        if not name.startswith("anonymous "):
            inputs.note(os.path.join(description.folder, name))


def _folder_beside(image):
    """:returns: a folder of its own for parts; it goes with the block"""
    folder, name = os.path.split(os.path.abspath(image))
    try:
        return tempfile.TemporaryDirectory(prefix=name + ".", dir=folder)
    except OSError as error:
        raise CommandError(f"cannot make a folder in {folder}: {error.strerror}") from error
