# SPDX-License-Identifier: Apache-2.0
"""Growth: seconds to the first image, of a sample, and memory, while there is ever more of one thing.

Stages are made for it (growthStages.py), in sizes ten times apart, and each is drawn in a process of its own: opened and
translated (the first two are Python and OpenUSD), built, and drawn once. Times are of processors. The exponent between two
sizes n and m is log(time of m / time of n) / log(m / n): 1 is linear, 2 is quadratic, and less than 1 is a start that
everything else hides behind. Runs take turns over the sizes, and medians count.

Lights are held to a logarithm: what a sample takes grows by as much from 10 to 100 as from 10,000 to 100,000. Textures are
drawn in a fixed memory for texels, of which the largest stage has ten times as many.
"""
import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile

from patina.cli import outputs

HERE = os.path.dirname(os.path.abspath(__file__))

TEXTURE_MEMORY = 32  # MiB
PARTS = ("open", "read", "draw", "first")


def measure(stage, options, settings):
    """:returns: what growthWorker.py tells of a stage
    :raises SystemExit: with its reason"""
    command = [sys.executable, os.path.join(HERE, "growthWorker.py"), stage, options.size, str(options.samples), *settings]
    process = subprocess.run(command, capture_output=True, text=True, check=False)
    if process.returncode != 0:
        raise SystemExit(f"{stage}: {(process.stderr.strip().splitlines() or ['no message'])[-1]}")
    return json.loads(process.stdout.strip().splitlines()[-1])


def axis(name, options):
    """:returns: list of dicts of one size each: its number, medians of processor seconds by part, of a sample, and megabytes"""
    import growthStages

    make, sizes = growthStages.AXES[name]
    sizes = [size for size in sizes if size <= options.most]
    settings = [f"textureMemory={TEXTURE_MEMORY}"] if name == "textures" else []
    found = {size: [] for size in sizes}
    with tempfile.TemporaryDirectory(prefix="growthBench") as folder:
        stages = {}
        for size in sizes:
            own = os.path.join(folder, str(size))
            os.makedirs(own)
            stages[size] = make(own, size)
        for _ in range(options.runs):
            for size in sizes:
                found[size].append(measure(stages[size], options, settings))
    rows = []
    for size in sizes:
        runs = found[size]
        row = {"size": size, **{part: statistics.median(run[part]["processor"] for run in runs) for part in PARTS}}
        row["wall"] = statistics.median(run["first"]["wall"] for run in runs)
        for part in ("sample", "peak", "textures"):
            row[part] = statistics.median(run[part] for run in runs)
        rows.append(row)
    return rows


def exponents(rows, part):
    """:returns: the slope of log over log from each row to the next"""
    return [math.log(max(b[part], 1e-9) / max(a[part], 1e-9)) / math.log(b["size"] / a["size"]) for a, b in zip(rows, rows[1:])]


def show(name, rows):
    print(f"\n| {name} | open, translate, build and draw | first image | a sample of all pixels | memory |\n"
          "|---|---|---|---|---|")
    for i, row in enumerate(rows):
        slope = {part: f" ({exponents(rows[i - 1:i + 1], part)[0]:.2f})" if i else "" for part in ("first", "sample", "peak")}
        texels = f", {row['textures']:.0f} of texels" if row["textures"] else ""
        print(f"| {row['size']:,} | {row['open']:.2f} + {row['read']:.2f} + {row['draw']:.2f} s | "
              f"{row['first']:.2f} s{slope['first']} | {1e3 * row['sample']:.1f} ms{slope['sample']} | "
              f"{row['peak']:.0f} MB{slope['peak']}{texels} |", flush=True)
    if len(rows) > 1:
        print()
        steps = [1e3 * (b["sample"] - a["sample"]) / math.log10(b["size"] / a["size"]) for a, b in zip(rows, rows[1:])]
        print(f"steepest: first image {max(exponents(rows, 'first')):.2f}, memory {max(exponents(rows, 'peak')):.2f} "
              "(target: at most 1)"
              + ("; ms of a sample that ten times as many cost, step by step: " + ", ".join(f"{step:.0f}" for step in steps)
                 + " (target: the same)" if name == "lights" else ""), flush=True)


def main(arguments):
    import growthStages

    parser = argparse.ArgumentParser(prog="patina bench growth", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("axes", nargs="*", help=f"of {', '.join(growthStages.AXES)} (default: all)")
    parser.add_argument("--size", default="160x120", help="of the images (default: 160x120)")
    parser.add_argument("--samples", type=int, default=9, help="from which the time of one is taken (default: 9)")
    parser.add_argument("--runs", type=int, default=3, help="processes of each size (default: 3)")
    parser.add_argument("--most", type=float, default=math.inf, help="of a thing: leaves larger stages out")
    parser.add_argument("--json", help="writes the figures to this file")
    options = parser.parse_args(arguments)
    outputs.check_all([options.json])
    unknown = [name for name in options.axes if name not in growthStages.AXES]
    if unknown or options.runs < 1 or options.samples < 2:
        parser.error(f"there is nothing called {unknown[0]}" if unknown else "--runs takes at least 1, --samples at least 2")
    results = {}
    for name in options.axes or growthStages.AXES:
        results[name] = axis(name, options)
        show(name, results[name])
    outputs.write_json(options.json, {"size": options.size, "samples": options.samples, "runs": options.runs, "axes": results})
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
