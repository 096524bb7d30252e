# SPDX-License-Identifier: Apache-2.0
"""Frames in Hydra beside hdEmbree and Storm, each renderer in a process of its own, in the same host.

Seconds until the first image of one sample (Hydra's population and the building of acceleration structures
are in it), until the image after a camera move, for both until there is something to see (Patina shows blocks of pixels
before a slow pass ends), peak memory; and rays per second of an ambient occlusion frame:
one camera ray and 16 cosine-distributed occlusion rays per hit, from the time of many samples less that of
half as many. hdEmbree casts the same rays. Storm draws the stage in UsdImagingGLEngine: its times are for
orientation.
"""
import os
import statistics
import tempfile

import benchRun
import benchStages
import hydraBuild
from patina.cli import outputs

RENDERERS = {  # plugin, how it calls the settings of the workload
    "Patina": ("HdPatinaRendererPlugin", {"samples": "samples", "occlusion": ["integrator=ambientOcclusion",
                                                                            "ambientOcclusionSamples=16"]}),
    "hdEmbree": ("HdEmbreeRendererPlugin", {"samples": "convergedSamplesPerPixel",
                                            "occlusion": ["enableAmbientOcclusion=true", "ambientOcclusionSamples=16"]}),
}
MOVES = 5
RAYS_PER_HIT = 17


def run_host(stage, renderer, samples, size, moves=0, outputs=()):
    """:returns: the report of the host"""
    plugin, names = RENDERERS[renderer]
    settings = [f"{names['samples']}={samples}", *names["occlusion"]]
    flags = [word for setting in settings for word in ("--set", setting)]
    flags += [word for output in outputs for word in ("--aov", output)]
    process = hydraBuild.run_host(stage, "--renderer", plugin, "--camera", "/camera", "--size", f"{size[0]}x{size[1]}",
                                  "--repeats", moves, "--json", "-", *flags, *(["--pickAll"] if outputs else []))
    return benchRun.told(process, renderer)


def hits_of(stage, size):
    """:returns: share of the pixels that show geometry"""
    picks = run_host(stage, "Patina", 1, size, outputs=("primId", "instanceId"))["picks"]
    return sum(pick["pixels"] for pick in picks if pick["primId"] >= 0) / (size[0] * size[1])


def measure(stage, renderer, size, samples, hits):
    first = run_host(stage, renderer, 1, size, moves=MOVES)
    moved, moved_seen = (statistics.median(first["seconds"][f"{name}{i}"] for i in range(MOVES))
                         for name in ("moved", "movedSeen"))
    few, many = (run_host(stage, renderer, count, size)["seconds"]["render"] for count in (samples // 2, samples))
    rays = size[0] * size[1] * (samples - samples // 2) * (1.0 + (RAYS_PER_HIT - 1) * hits)
    return {"first": first["seconds"]["render"], "first seen": first["seconds"]["seen"], "moved": moved,
            "moved seen": moved_seen, "memory": first["peakMemory"],
            "rays": rays / max(many - few, 1e-9)}


def measure_storm(stage, size):
    """:returns: the same of Storm, without rays; None where it does not run"""
    if hydraBuild.missing_engine():
        return None
    process = hydraBuild.run_engine(stage, "--renderer", "HdStormRendererPlugin", "--camera", "/camera", "--size",
                                    f"{size[0]}x{size[1]}", "--repeats", MOVES)
    report = benchRun.told(process, "Storm")
    return report and {"first": report["seconds"]["first"], "moved": statistics.median(report["seconds"]["moved"]),
                       "memory": report["peakMemory"]}


def _cell(value, unit):
    return "-" if value is None else f"{value:.3f} s" if unit == "s" else f"{value / 1e6:.1f} {unit}"


def show(results):
    """Prints a table; a ratio below 1 means that Patina needs less, above 1 for rays that it is faster."""
    rows = [("first", "first image", "s"), ("first seen", "something to see", "s"), ("moved", "after a camera move", "s"),
            ("moved seen", "something to see", "s"), ("memory", "peak memory", "MB"),
            ("rays", "rays per second", "M/s")]
    for stage, found in results.items():
        print(stage)
        for key, label, unit in rows:
            cells = "".join(f"{name} {_cell(values.get(key), unit):<14}" for name, values in found.items())
            ratios = "".join(f"  x{found['Patina'][key] / values[key]:.2f} of {name}" for name, values in found.items()
                             if name != "Patina" and values.get(key))
            print(f"  {label:<22}{cells}{ratios}")


def main(arguments):
    parser = benchRun.Parser("hydra", __doc__, "640x480", samples=(32, "of a pixel"))
    parser.add_argument("stages", nargs="*", help="with a camera at /camera (default: stages made for this)")
    options = parser.parse(arguments)
    reason = hydraBuild.missing()
    if reason:
        print(reason)
        return 0
    size = options.pixels
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        stages = {os.path.basename(s): s for s in options.stages} or benchStages.write_all(folder)
        for name, stage in stages.items():
            hits = hits_of(stage, size)
            found = {renderer: measure(stage, renderer, size, options.samples, hits) for renderer in RENDERERS}
            storm = measure_storm(stage, size)
            if storm:
                found["Storm"] = storm
            results[name] = found
            show({name: found})
    outputs.write_json(options.json, {"size": size, "samples": options.samples, "stages": results})
    return 0
