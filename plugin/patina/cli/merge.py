"""Makes an image of the parts of a frame (`patina record --part`), with the bits of the frame rendered at once.

  patina record shot.usda shot.exr --part 1/2 --partial shot.1.part
  patina record shot.usda shot.exr --part 2/2 --partial shot.2.part
  patina merge shot.1.part shot.2.part shot.exr

Parts say what made them: the stage with all of its layers and textures, the settings, the version and what it computes with.
Those that do not belong together are refused, and missing ones are named. What the image's file holds follows from the
flags that the parts were made with.
"""
import os

from patina import inputs
from patina.cli import compiled, frames, outputs
from patina.cli.errors import CommandError
from patina.cli.progress import Progress


def add_arguments(parser):
    parser.add_argument("files", metavar="FILE", nargs="+", help="parts of one frame, in any order")
    parser.add_argument("image", metavar="IMAGE", help="what to write, in any format that `patina record` writes; "
                                                      "a place for frames (###) takes the parts' frame")
    parser.add_argument("--renderMissing", action="store_true",
                        help="render the parts that are missing, here and with the flags of the others, beside IMAGE")
    parser.add_argument("--allowMixed", action="store_true",
                        help="take parts of other builds and instruction sets: the image has no defined bits then")
    parser.add_argument("--threads", type=int, default=0, metavar="N", help="default: all cores")
    parser.add_argument("--json", metavar="FILE",
                        help="statistics of the frame: --json to standard output, --json=FILE to a file")
    parser.add_argument("--quiet", "-q", action="store_true", help="errors only")


def run(arguments):
    from patina.farm import merging, missing, parts

    module = compiled.load()
    _note(arguments.files)
    found = parts.Parts(module, arguments.files, arguments.allowMixed)
    if frames.has_place(arguments.image) and found.first.frame is not None:
        arguments.image = frames.image_name(arguments.image, found.first.frame, 0)
    outputs.check_all([arguments.image, arguments.json])
    module.check_image_path(arguments.image)
    absent = found.missing()
    made = []
    try:
        if absent and not arguments.renderMissing:
            raise CommandError(f"{parts.names(absent)} (--renderMissing renders them)")
        for part in absent:
            made.append(f"{arguments.image}.{part.number}.part")
            Progress("", arguments.quiet).say(f"rendering part {part}")
            missing.render(found.first, part, made[-1], arguments)
        if made:
            _note(arguments.files)
            found = parts.Parts(module, arguments.files + made, arguments.allowMixed)
        told = merging.merge(module, found, arguments.image, arguments.threads)
    finally:
        for file in made:
            if os.path.exists(file):
                os.remove(file)
    if arguments.json:
        told.write(arguments.json)


def _note(files):
    """So that the image is written over none of them."""
    for file in files:
        inputs.note(file)
