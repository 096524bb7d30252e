# SPDX-License-Identifier: Apache-2.0
"""What the processor does for a frame of the rasterizer after a camera move, in the host that usdview has, beside Storm's.

Mesa's GALLIUM_NOOP=1 takes all commands of OpenGL and draws nothing, so that what is left is the processor's share of a
frame on a machine with a graphics card: host, renderer, and the part of the driver that takes commands. Milliseconds of all
threads together, medians over the moves, in processes one after another. Where `perf` is installed, it tells whose code that
was, with the start of the process.
"""
import os
import shutil
import statistics
import subprocess
import sys
import tempfile

import benchRun
import hydraBuild
import inProcess
import viewportBench
from patina.cli import outputs

STAGES = {"diffuseBox": "/World/camera", **{name: row[0] for name, row in viewportBench.STAGES.items()
                                           if name != viewportBench.MADE}}
NOTHING = {"GALLIUM_NOOP": "1", "LIBGL_ALWAYS_SOFTWARE": "1"}
# whose code: how the names of its libraries begin
OWNERS = {"Patina": ("hdPatina", "libpatina"), "driver": ("swrast", "libgallium", "libLLVM", "libGL", "libEGL", "libglapi"),
          "OpenUSD": ("libusd", "engineHost", "libtbb"), "system": ("libc.", "ld-", "[kernel", "libm.", "libstdc++", "[vdso")}


def flags(camera, renderer, options):
    plugin, settings = viewportBench.RENDERERS[renderer]
    return ["--renderer", plugin, "--camera", camera, "--size", options.size, "--repeats", options.repeats,
            *(word for setting in settings for word in ("--set", setting))]


def milliseconds(stage, camera, renderer, options):
    """:returns: processor milliseconds of a move, None where the renderer does not run here"""
    process = hydraBuild.run_engine(stage, *flags(camera, renderer, options), **NOTHING)
    report = benchRun.told(process, renderer)
    return report and 1e3 * statistics.median(report["processor"])


def owners(stage, camera, renderer, options):
    """:returns: shares of OWNERS and of the rest in a process of many moves; empty without perf"""
    if not shutil.which("perf"):
        return {}
    with tempfile.TemporaryDirectory() as folder:
        samples = os.path.join(folder, "samples")
        command = ["perf", "record", "-q", "-F", "999", "-o", samples, "--", hydraBuild.folder("engineHost"), str(stage),
                   *map(str, flags(camera, renderer, options))]
        subprocess.run(command, env=hydraBuild.environment(**NOTHING), capture_output=True, check=False)
        process = subprocess.run(["perf", "report", "-i", samples, "--stdio", "--sort", "dso", "-g", "none"],
                                 capture_output=True, text=True, check=False)
    shares = dict.fromkeys((*OWNERS, "others"), 0.0)
    for line in process.stdout.splitlines():
        words = line.split()
        if len(words) >= 2 and words[0].endswith("%"):
            owner = next((who for who, begins in OWNERS.items() if words[1].startswith(begins)), "others")
            shares[owner] += float(words[0][:-1]) / 100.0
    return shares if sum(shares.values()) > 0.5 else {}


def main(arguments):
    parser = benchRun.Parser("frame", __doc__, "1280x720", repeats=(100, "moves in each process"))
    parser.add_argument("stages", nargs="*", choices=[[], *STAGES], help="of testenv/scenes (default: all)")
    options = parser.parse(arguments)
    missing = hydraBuild.missing() or hydraBuild.missing_engine()
    if missing:
        sys.exit(missing)
    results = {}
    for name in options.stages or STAGES:
        stage = inProcess.scene(name)
        results[name] = found = {}
        for renderer in ("rasterizer", "Storm"):
            took = milliseconds(stage, STAGES[name], renderer, options)
            if took is not None:
                found[renderer] = {"milliseconds": took, "shares": owners(stage, STAGES[name], renderer, options)}
        print(name + "".join(f"   {who} {one['milliseconds']:.1f} ms" for who, one in found.items()))
        for who, one in found.items():
            if one["shares"]:
                print(f"  of {who}'s process: " + ", ".join(f"{owner} {100 * share:.0f} %"
                                                            for owner, share in one["shares"].items()), flush=True)
    outputs.write_json(options.json, {"size": options.size, "repeats": options.repeats, "stages": results})
    return 0
