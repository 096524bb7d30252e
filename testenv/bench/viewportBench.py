# SPDX-License-Identifier: Apache-2.0
"""First images, and images after edits, in the host that usdview and usdrecord have: UsdImagingGLEngine with OpenGL.

The path tracer shows blocks of pixels before a slow first pass ends, so its rows say also when there was something to see.
Patina's two back ends beside Storm and hdEmbree, each in a process of its own, of one sample or pass. A first image begins with
the stage's file: opening it is in the time. Cycles of `patina bench path` draws the made stage, too. Its scene stands ready in
memory and only its first image counts. hdEmbree shows neither materials nor lights. A stage of one's own needs a camera:
FILE:CAMERA.
"""
import json
import os
import statistics
import subprocess
import sys
import tempfile

import benchRun
import hydraBuild
import inProcess
from patina.cli import outputs

RENDERERS = {  # plugin, settings
    "rasterizer": ("HdPatinaRendererPlugin", ("backend=raster", "samples=1")),
    "path tracer": ("HdPatinaRendererPlugin", ("backend=embree", "samples=1")),
    "Storm": ("HdStormRendererPlugin", ()),
    "hdEmbree": ("HdEmbreeRendererPlugin", ("convergedSamplesPerPixel=1",)),
}
OWN = ("rasterizer", "path tracer")
# Stage: camera, an edit of a material, one of a light; each ends at these numbers. Of testenv/scenes, but the first.
MADE = "hundredTextures"
STAGES = {
    MADE: ("/camera", "/materials/m0/surface.roughness=0.6", "/lights/sky.intensity=1"),
    "shaderball": ("/World/camera", "/World/materials/coat/surface.diffuseColor=0.55,0.1,0.1", ""),
    "instances": ("/World/camera", "/World/materials/green/diffuse.color=0.1,0.3,0.1", ""),
    "texturedMesh": ("/World/camera", "/World/materials/checker/surface.roughness=0.4", ""),
    "manyLights": ("/World/camera", "", "/World/light0.intensity=200"),
}
ROWS = {"first": "first image", "first seen": "something to see", "material": "after an edit of a material",
        "material seen": "something to see", "light": "after an edit of a light", "light seen": "something to see",
        "moved": "after a camera move", "moved seen": "something to see"}


def settings_of(options):
    """:returns: what pathWorker.save() takes besides a scene"""
    return {"width": options.pixels[0], "height": options.pixels[1], "depth": 8, "threads": 0}


def made(folder, options):
    """Writes the stage with a hundred textures. :returns: its file"""
    import pathPatina
    import pathScenes
    import pathWorker

    pathWorker.save(pathScenes.SCENES[MADE](folder), folder, settings_of(options))
    return pathPatina.write(folder)[0]


def host(stage, camera, renderer, options, edit="", image=""):
    """:returns: the report of one process, None where the renderer does not run here or takes too long"""
    plugin, settings = RENDERERS[renderer]
    flags = [word for setting in settings for word in ("--set", setting)] + (["--edit", edit] if edit else [])
    with tempfile.TemporaryDirectory() as folder:
        caches = {"PATINA_CACHE": folder, "MESA_SHADER_CACHE_DIR": folder} if options.cold else {}
        try:
            process = hydraBuild.run_engine(stage, *([image] if image else []), "--renderer", plugin, "--camera", camera,
                                            "--size", options.size, "--repeats", options.repeats, *flags,
                                            timeout=options.limit, **caches)
        except subprocess.TimeoutExpired:
            print(f"{renderer} took more than {options.limit} s", file=sys.stderr)
            return None
    return benchRun.told(process, renderer)


def measure(name, stage, camera, edits, options):
    """:returns: renderer -> seconds of each of ROWS that it was asked for, and peak memory"""
    runs = {renderer: {} for renderer in RENDERERS}
    for run in range(options.runs):
        for renderer in list(runs):  # in turns
            # hdEmbree sees no edit: one process is enough for the camera.
            for kind, edit in list(edits.items())[:1 if renderer == "hdEmbree" else None]:
                image = os.path.join(options.images, f"{name} {renderer}.exr".replace(" ", "-")) if options.images else ""
                report = host(stage, camera, renderer, options, edit, image if run == 0 else "")
                if report is None:
                    runs.pop(renderer)
                    break
                seconds, found = report["seconds"], runs[renderer]
                if run == 0 and kind == next(iter(edits)):
                    print(f"{name}, {renderer}: OpenGL draws on {report['device']}", file=sys.stderr)
                seen = report["seen"]
                found.setdefault("first", []).append(seconds["open"] + seconds["first"])
                found.setdefault("first seen", []).append(seconds["open"] + seen["first"])
                found.setdefault("memory", []).append(report["peakMemory"])
                found.setdefault("moved", []).extend(seconds["moved"])
                found.setdefault("moved seen", []).extend(seen["moved"])
                if edit and renderer != "hdEmbree":
                    found.setdefault(kind, []).extend(seconds["edited"])
                    found.setdefault(kind + " seen", []).extend(seen["edited"])
    return {renderer: {key: statistics.median(values) for key, values in found.items()} for renderer, found in runs.items()}


def cycles(folder, options):
    """Times the first image of the made stage. :returns: Cycles and its version -> as of measure(); empty without it"""
    import pathBench

    command = pathBench.peers("Cycles").get("Cycles")
    if not command:
        return {}
    found = []
    for _ in range(options.runs):
        process = subprocess.run([*command, folder], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        lines = [line for line in process.stdout.splitlines() if line.startswith("path bench: ")]
        if not lines:
            print(f"Cycles does not run here: {benchRun.reason(process)}", file=sys.stderr)
            return {}
        found.append(json.loads(lines[0][len("path bench: "):]))
    return {f"Cycles {found[0]['version']}": {"first": statistics.median(told["first"] for told in found)}}


def show(name, found):
    """Prints a table of one stage. A ratio is that of one of Patina's back ends to a peer; below 1 it needs less."""
    print(name)
    for key, label in ROWS.items():
        cells = [f"{renderer} {values[key]:.3f} s" for renderer, values in found.items() if key in values]
        if len(cells) < 2:
            continue
        ratios = [f"{own} x{found[own][key] / values[key]:.2f} of {peer}" for own in OWN if key in found.get(own, {})
                  for peer, values in found.items() if peer not in OWN and values.get(key)]
        print(f"  {label:<28}" + ", ".join(cells) + ("   " + ", ".join(ratios) if ratios else ""))
    memory = ", ".join(f"{who} {values['memory'] / 1e6:.0f} MB" for who, values in found.items() if "memory" in values)
    print(f"  {'peak memory':<28}{memory}", flush=True)


def main(arguments):
    parser = benchRun.Parser("viewport", __doc__, "640x360", runs=(5, "processes of each, of which medians are shown"),
                               repeats=(5, "moves and edits in each process"))
    parser.add_argument("stages", nargs="*", help=f"of {', '.join(STAGES)} (default: all), or FILE:CAMERA")
    parser.add_argument("--limit", type=float, default=300, help="seconds of a process, after which it is left out (300)")
    parser.add_argument("--cold", action="store_true", help="begin with empty caches of shaders")
    parser.add_argument("--images", metavar="FOLDER", help="writes what each renderer drew last")
    options = parser.parse(arguments)
    reason = hydraBuild.missing() or hydraBuild.missing_engine()
    if reason:
        print(reason)
        return 0
    if options.images:
        os.makedirs(options.images, exist_ok=True)
    results = {}
    for wanted in options.stages or STAGES:
        with tempfile.TemporaryDirectory() as folder:
            if wanted in STAGES:
                camera, material, light = STAGES[wanted]
                name, stage = wanted, made(folder, options) if wanted == MADE else inProcess.scene(wanted)
                edits = {kind: edit for kind, edit in (("material", material), ("light", light)) if edit}
            elif ":" in wanted:
                stage, camera = wanted.rsplit(":", 1)
                name, edits = os.path.splitext(os.path.basename(stage))[0], {"": ""}
            else:
                parser.error(f"there is no stage {wanted}; a file needs a camera: FILE:CAMERA")
            found = measure(name, stage, camera, edits, options)
            if wanted == MADE:
                found.update(cycles(folder, options))
        results[name] = found
        show(name, found)
    outputs.write_json(options.json, {"size": options.size, "cold": options.cold, "stages": results})
    return 0
