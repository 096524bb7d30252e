# SPDX-License-Identifier: Apache-2.0
"""The flags of `patina record`, and the render settings that they mean."""
import math

from patina import limits
from patina.cli import denoiser, frames, methods, overrides, rows, settingFlags, snapshots
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError, UsageError
from patina.farm import cut

COMPLEXITIES = {"low": 1.0, "medium": 1.1, "high": 1.2, "veryhigh": 1.3}
DEFAULT_SAMPLES = 64
MAX_SAMPLES = 65536  # where only --tolerance or --seconds ends the render
ALL_AOVS = tuple(name for row in rows.read("hdDelegate/film/aovs.def", "AOV") if "all" in row.words
                 for name in row.words["all"] or [row.values[0]])
LIGHT_AOVS = tuple(row.values[0] for row in rows.read("hdDelegate/film/aovs.def", "AOV")
                   if "paths" in row.words or row.values[0] == "shadow")
OUTLIERS = ("keep", "spread")
LARGEST_SIZE = 65536
MAX_PIXELS = 1 << 28
_SETTINGS_HELP = ("take camera, resolution, products, AOVs, purposes and `patina:` settings from this UsdRenderSettings prim; "
                  "`stage` is the one that the stage's metadata name. Flags are stronger. Without IMAGE all its products are "
                  "written to their own names; with IMAGE the first, to IMAGE")
_PASS_HELP = ("draw what the collections of this UsdRenderPass prim say (renderVisibility, prune, cameraVisibility, "
              "matte), with the render settings of its renderSource. It takes the place of --settings")
_TEXTS = {"DEFAULT_SAMPLES": DEFAULT_SAMPLES, "MAX_SAMPLES": MAX_SAMPLES}  # of helps in the table of settings


def add_arguments(parser):
    parser.add_argument("stage", metavar="STAGE", help="a .usd, .usda, .usdc or .usdz file")
    parser.add_argument("image", metavar="IMAGE", nargs="?",
                        help="the image to write: .exr holds linear colour and all AOVs; .png, .jpg, .tif and others hold "
                             "the colour as a display shows it. With --frames the name holds the frame's place (####, <F4> "
                             "or %%04d). It may be left out with --settings")
    _add_stage_flags(parser.add_argument_group("the stage"))
    _add_render_flags(parser.add_argument_group("the render"))
    _add_output_flags(parser.add_argument_group("the image"))
    _add_run_flags(parser.add_argument_group("the run"))


def _add_stage_flags(group):
    group.add_argument("--camera", "-cam", metavar="PATH", help="the camera's prim path, or its name alone (default: "
                       "the stage's first camera; without any the whole stage is framed)")
    time = group.add_mutually_exclusive_group()
    time.add_argument("--frames", "-f", metavar="FRAMESPEC", help=frames.FRAMESPEC_HELP)
    time.add_argument("--defaultTime", "-d", action="store_true",
                      help="render the default time (otherwise: the stage's startTimeCode)")
    group.add_argument("--purposes", metavar="PURPOSE[,PURPOSE...]", default="render",
                       help="purposes to draw besides `default`: render, proxy, guide; or none (default: render)")
    group.add_argument("--complexity", "-c", type=_complexity, default=1.0, metavar="LEVEL",
                       help="least refinement of subdivision surfaces: low, medium, high, veryhigh or a number from "
                            "1.0 to 2.0; edges are refined to --edgeLength in any case (default: low)")
    add_levels_flag(group)
    group.add_argument("--mask", metavar="PATH[,PATH...]", help="populate only these prims and what is above and "
                                                                 "below them")
    group.add_argument("--sessionLayer", metavar="FILE", help="open the stage with this session layer")
    group.add_argument("--layer", action="append", default=[], metavar="FILE",
                       help="a layer over the stage, which itself is not changed (repeatable; later ones are stronger, and all "
                            "are stronger than the session layer)")
    group.add_argument("--settings", "--renderSettingsPrimPath", "-rs", metavar="PRIM", help=_SETTINGS_HELP)
    group.add_argument("--renderPassPrimPath", "-rp", metavar="PRIM", help=_PASS_HELP)
    group.add_argument("--set", action="append", default=[], metavar="PRIM.INPUT=VALUE", help=overrides.SET_HELP)
    group.add_argument("--disableCameraLight", action="store_true",
                       help="no headlight where the stage has no lights")


def _add_render_flags(group):
    group.add_argument("--backend", default="embree", choices=["embree", "raster"],
                       help="the renderer (default: embree, which also takes over where raster finds no OpenGL)")
    settingFlags.add(group, "the render", _TEXTS, after={"indirectClamp": _add_denoise_flag,
                                                         "environmentSamples": methods.add_flag})


def _add_denoise_flag(group):
    group.add_argument("--denoise", action="store_true",
                       help="the colour as Open Image Denoise cleans it, led by albedo and normals; OpenEXR files keep the "
                            "noisy one as color.noisy (./patina installs pyoidn for it; else $PATINA_OIDN_LIBRARY names "
                            "the library)")
    group.add_argument("--denoiseAovs", action="store_true",
                       help="as --denoise, and AOVs of light as well, each by itself with the same guides; they then add up to "
                            "the colour only nearly")
    group.add_argument("--denoiseLater", action="store_true",
                       help="also write the AOVs that `patina denoise` reads, and take a seed of its own for each frame: "
                            "--seed and a thousand times the time code (of IMAGE alone)")


def add_levels_flag(group):
    group.add_argument("--levels", default="stage", choices=["stage", "measured"],
                       help="levels of detail: `stage` draws what overrides, heuristics or the default index choose; with a "
                            "--tolerance `measured` draws each level before, and takes those of fewest triangles whose errors "
                            "fit a tenth of it (default: stage)")


def check_levels(arguments, command):
    if arguments.levels == "measured" and not arguments.tolerance > 0.0:
        raise UsageError(f"patina {command}: --levels measured needs a --tolerance above 0")


def add_tolerance_flag(group):
    settingFlags.add_one(group, "tolerance")


def _add_output_flags(group):
    group.add_argument("--imageWidth", "-w", type=_size, metavar="PIXELS", help="width of the image (default: 960)")
    group.add_argument("--imageHeight", type=_size, metavar="PIXELS",
                       help="height of the image (default: from the width and the camera's aperture or fields of view)")
    settingFlags.add(group, "the image", _TEXTS)
    group.add_argument("--makeOutputPath", "--make-output-path", action="store_true",
                       help="make the folders of what is written, where they are not there")
    group.add_argument("--dataWindow", type=_window, metavar="X0,Y0,X1,Y1",
                       help="render only these pixels, both corners included, counted from the upper left; pixels beyond the "
                            "image are overscan, which an OpenEXR file keeps beside its frame")
    group.add_argument("--aov", action="append", default=[], metavar="NAME",
                       help=f"also write this (repeatable, OpenEXR only): {', '.join(ALL_AOVS)}, any primvars:NAME, "
                            f"or all; light by its paths: {', '.join(LIGHT_AOVS)}, or NAME=lpe:EXPRESSION, in which "
                            "'key' is a light group")
    group.add_argument("--deep", metavar="FILE.exr",
                       help="also write a deep image: the samples of each pixel front to back, with R, G, B, A, Z and ZBack, "
                            "of surfaces, partial coverage and volumes. Flattened it is IMAGE before any denoising. Path "
                            "tracer only")
    group.add_argument("--half", action="store_true", help="OpenEXR: colour as 16-bit floats")
    group.add_argument("--compression", default="zip", metavar="NAME",
                       choices=["none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"],
                       help="OpenEXR: none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa, dwab (default: zip)")
    group.add_argument("--bits", type=int, default=8, choices=[8, 16, 32],
                       help="bits per channel of PNG and TIFF (default: 8; 32: TIFF with linear floats)")
    group.add_argument("--outliers", default="spread", choices=OUTLIERS, metavar="NAME",
                       help="pixels that a few very bright samples have decided (fireflies), in images that a display shows: "
                            "spread gives their light to the pixels around, so that the picture's mean stays; keep shows them. "
                            "OpenEXR and linear values always keep them (default: spread)")
    group.add_argument("--display", default="", metavar="NAME", help="OCIO display (default: sRGB, or that of $OCIO)")
    group.add_argument("--view", default="", metavar="NAME", help="OCIO view (default: the display's first)")
    group.add_argument("--colorCorrectionMode", "-color", default="openColorIO", metavar="MODE",
                       choices=["disabled", "sRGB", "openColorIO"],
                       help="disabled writes linear values; sRGB and openColorIO show them through the display "
                            "transform (default: openColorIO, which is sRGB unless $OCIO says otherwise)")
    group.add_argument("--outputFolder", metavar="FOLDER",
                       help="of products that --settings writes to their own names: names are meant from here, and it is made "
                            "where it is missing (default: the current folder)")
    group.add_argument("--allowOutside", action="store_true",
                       help="write products whose names lead out of that folder, wherever the stage says")


def _add_run_flags(group):
    group.add_argument("--resume", action="store_true",
                       help="continue from IMAGE.checkpoint, if it is there and fits")
    settingFlags.add(group, "the run", _TEXTS)
    group.add_argument("--keepCheckpoint", action="store_true",
                       help="save the checkpoint at the end and keep it, to add samples later with --resume")
    group.add_argument("--onlyWhole", action="store_true",
                       help="a signal that ends the render early leaves no image of fewer samples, only the checkpoint")
    group.add_argument("--part", type=cut.part, metavar="K/TILES[xRANGES]",
                       help="render one part of the frame, from 1 to TILES times RANGES: its tiles are cut into so many "
                            "groups, and the samples of each into so many ranges; --partial takes it")
    group.add_argument("--partial", metavar="FILE", help="the part's file; `patina merge` makes IMAGE of all of them, with the "
                                                         "bits of the frame rendered at once")
    group.add_argument("--snapshot", type=_not_negative, default=0.0, metavar="S",
                       help="write the image so often while it renders, beside IMAGE (see --snapshotSuffix); it is removed "
                            "when IMAGE is written (default: 0, never; the signal SIGUSR1 asks for one in any case)")
    group.add_argument("--snapshotSuffix", type=_suffix, default=snapshots.SUFFIX, metavar="TEXT",
                       help=f"of the names of snapshots, before the extension (default: {snapshots.SUFFIX})")
    group.add_argument("--report", metavar="FILE.html",
                       help="one page that needs no network: image and AOVs to wipe through, samples and error of each pixel, "
                            "time by phase and by material, memory, warnings, the plan, and the command. With --frames of the "
                            "last frame, or of each where the name has a place for it")
    limits.add_flag(group)
    group.add_argument("--strict", action="store_true", help="warnings make the render fail")
    group.add_argument("--json", metavar="FILE",
                       help="statistics (times by phase, rays, samples, memory, warnings): --json to standard "
                            "output, --json=FILE to a file")
    loud = group.add_mutually_exclusive_group()
    loud.add_argument("--verbose", "-v", action="store_true",
                      help="also time and memory of each phase of a frame: read, translate, build, sample, write")
    loud.add_argument("--quiet", "-q", action="store_true", help="errors only: no progress, no warnings")


def settings_of(arguments):
    """:returns: dict of render settings; width, height and checkpointFile are not known yet"""
    settings = {name: getattr(arguments, name) for name in settingFlags.names()}
    endless = arguments.tolerance > 0.0 or arguments.seconds > 0.0
    settings["samples"] = arguments.samples or (MAX_SAMPLES if endless else DEFAULT_SAMPLES)
    settings["methods"] = methods.parse(arguments.method)
    guides = denoiser.aovs(settings, arguments.backend) if arguments.denoise else ()
    settings["aovs"] = list(dict.fromkeys([*aovs_of(arguments), *guides]))
    settings["deep"] = bool(arguments.deep)
    _check_display(arguments)
    if arguments.dataWindow:
        settings["dataWindow"] = arguments.dataWindow
    return settings


def _check_display(arguments):
    """Before anything is rendered: an image that has no display transform is lost when it is written."""
    if _patina.rendering_space(arguments.renderingColorSpace) is None:
        raise CommandError(f"--renderingColorSpace: '{arguments.renderingColorSpace}' is no linear colour space (known are: "
                           f"{', '.join(_patina.color_spaces())})")
    if arguments.colorCorrectionMode == "disabled":
        return
    for flag, wanted, known in (("display", arguments.display, lambda m: m.displays()),
                                ("view", arguments.view, lambda m: m.views(arguments.display or m.displays()[0]))):
        if wanted and wanted not in known(_patina):
            raise CommandError(f"--{flag}: there is no {flag} '{wanted}' (there are: {', '.join(known(_patina))})")


def aovs_of(arguments):
    """:returns: names besides color and alpha"""
    names = [*denoiser.GUIDES, *denoiser.MOTION, "sampleCount"] if arguments.denoiseLater else []
    for name in arguments.aov:
        names += ALL_AOVS if name == "all" else [name]
    return [name for name in dict.fromkeys(names) if name not in ("color", "alpha")]


def seed_of(arguments, seed, frame):
    """:param frame: its time code, or None for the default time
    :returns: the seed of a frame's render"""
    return (seed + round(1000 * (frame or 0.0))) % 2**32 if arguments.denoiseLater else seed


def image_options_of(arguments):
    """:returns: dict of image options"""
    options = {"half": arguments.half, "compression": arguments.compression, "bits": arguments.bits,
               "display": arguments.display, "view": arguments.view, "rendering_color_space": arguments.renderingColorSpace,
               "pixel_aspect_ratio": arguments.pixelAspectRatio,
               "raw": arguments.colorCorrectionMode == "disabled",
               "outliers": arguments.outliers, "aovs": ["color", "alpha"] + aovs_of(arguments)}
    return options


def purposes_of(arguments):
    """:returns: list of purposes, `default` among them unless a UsdRenderSettings prim leaves it out"""
    names = arguments.purposes.replace(",", " ").split()
    for name in names:
        if name not in ("default", "render", "proxy", "guide", "none"):
            raise UsageError(f"patina record: --purposes: there is no purpose '{name}'")
    always = ["default"] if getattr(arguments, "defaultPurpose", True) else []
    return always + [name for name in dict.fromkeys(names) if name not in ("default", "none")]


def _complexity(text):
    if text in COMPLEXITIES:
        return COMPLEXITIES[text]
    value = float(text)
    if not 1.0 <= value <= 2.0:
        raise ValueError
    return value


def _integer(text, minimum, maximum):
    value = int(text)
    if not minimum <= value <= maximum:
        raise ValueError
    return value


def _count(text):
    return _integer(text, 1, 2**31 - 1)


def _size(text):
    return _integer(text, 1, LARGEST_SIZE)


def _seed(text):
    return _integer(text, 0, 2**32 - 1)


def _not_negative(text):
    value = float(text)
    if not (value >= 0.0 and math.isfinite(value)):
        raise ValueError
    return value


def _suffix(text):
    if not text or "/" in text or "\0" in text:
        raise ValueError
    return text


def _window(text):
    values = [int(word) for word in text.split(",")]
    if len(values) != 4 or values[2] < values[0] or values[3] < values[1] or max(map(abs, values)) >= 2**31:
        raise ValueError
    return values


# argparse shows the name of the function in its message about a bad value.
for _function, _name in ((_complexity, "complexity"), (_count, "count (1 or more)"), (_size, "size in pixels"),
                         (_seed, "seed"), (_not_negative, "number (0 or more)"), (_window, "window X0,Y0,X1,Y1"),
                         (_suffix, "text without a slash")):
    _function.__name__ = _name
