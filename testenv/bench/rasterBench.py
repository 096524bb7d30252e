# SPDX-License-Identifier: Apache-2.0
"""Frames of the rasterizer, beside Storm in the same host where OpenUSD is found, each in a process of its own.

Seconds until the first image (reading the stage and building shaders are in it), after an edit of a material (of a light
where a stage has no material) and after a camera move, each of one pass; then where they go: translating the stage, building
buffers and shaders, ids and depths, shadow maps, shading, reading back. The driver's cache of shaders on disk is warm, unless
--cold. Storm draws in UsdImagingGLEngine and casts no shadows unless lights ask for them: its times are for orientation.
"""
import os
import statistics
import tempfile

import benchRun
import hydraBuild
import inProcess
from patina.cli import outputs

CAMERA = "/World/camera"
# Stage of testenv/scenes: what is edited, up to these numbers.
STAGES = {
    "shaderball": "/World/materials/coat/surface.diffuseColor=0.55,0.1,0.1",
    "instances": "/World/materials/green/diffuse.color=0.1,0.3,0.1",
    "texturedMesh": "/World/materials/checker/surface.roughness=0.4",
    "manyLights": "/World/light0.intensity=200",
    "diffuseBox": "/World/materials/red/diffuse.color=0.65,0.05,0.05",
}
FRAMES = {"first": "first image", "edited": "after an edit", "moved": "after a camera move"}


def measure(stage, size, edit, repeats, cold, backend):
    """:returns: what rasterTimes.py tells
    :raises SystemExit: with its reason when it cannot"""
    with tempfile.TemporaryDirectory() as folder:
        fresh = {"PATINA_CACHE": folder, "MESA_SHADER_CACHE_DIR": folder} if cold else {}
        script = os.path.join(benchRun.HERE, "rasterTimes.py")
        return benchRun.figures(stage, [script, stage, f"{size[0]}x{size[1]}", edit, repeats, backend],
                                env=dict(os.environ, **fresh))


def measure_storm(stage, size, edit, repeats):
    """:returns: the same of Storm, None where it does not run"""
    if hydraBuild.missing() or hydraBuild.missing_engine():
        return None
    process = hydraBuild.run_engine(stage, "--renderer", "HdStormRendererPlugin", "--camera", CAMERA, "--size",
                                    f"{size[0]}x{size[1]}", "--repeats", repeats, "--edit", edit)
    report = benchRun.told(process, "Storm")
    if report is None:
        return None
    seconds = report["seconds"]
    return {"first": seconds["open"] + seconds["first"], "edited": statistics.median(seconds["edited"]),
            "moved": statistics.median(seconds["moved"])}


def show(name, found):
    """Prints a table of one stage; a ratio below 1 means that Patina needs less."""
    print(name)
    for key, label in FRAMES.items():
        shares = found["Patina"]["shares"][key]
        line = f"  {label:<22}{found['Patina'][key]:8.3f} s"
        storm = (found.get("Storm") or {}).get(key)
        if storm:
            line += f"   Storm {storm:.3f} s, x{found['Patina'][key] / storm:.2f}"
        print(line + "   " + ", ".join(f"{share} {seconds:.3f}" for share, seconds in shares.items() if seconds >= 0.0005))
    print(f"  {'peak memory':<22}{found['Patina']['memory'] / 1e6:8.0f} MB")


def main(arguments):
    parser = benchRun.Parser("raster", __doc__, "1280x720", repeats=(5, "edits and moves, of which medians are shown"))
    parser.add_argument("stages", nargs="*", choices=[[], *STAGES], help="of testenv/scenes (default: all five)")
    parser.add_argument("--cold", action="store_true", help="begin with empty caches of shaders")
    parser.add_argument("--backend", default="raster", choices=["raster", "embree"])
    parser.add_argument("--noStorm", action="store_true")
    options = parser.parse(arguments)
    size = options.pixels
    results = {}
    for name in options.stages or STAGES:
        stage = inProcess.scene(name)
        found = {"Patina": measure(stage, size, STAGES[name], max(1, options.repeats), options.cold, options.backend)}
        storm = None if options.noStorm else measure_storm(stage, size, STAGES[name], max(1, options.repeats))
        if storm:
            found["Storm"] = storm
        results[name] = found
        show(name, found)
    outputs.write_json(options.json, {"size": size, "repeats": options.repeats, "stages": results})
    return 0
