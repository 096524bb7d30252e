# SPDX-License-Identifier: Apache-2.0
"""Growth: seconds to the first image, of a sample, and memory, while there is ever more of one thing.

Stages are made for it (growthStages.py), in sizes ten times apart, and each is drawn in a process of its own: opened and
translated (the first two are Python and OpenUSD), built, and drawn once. Times are of processors. The exponent between two
sizes n and m is log(time of m / time of n) / log(m / n): 1 is linear, 2 is quadratic, and less than 1 is a start that
everything else hides behind. Runs take turns over the sizes, and medians count.

Lights are held to a logarithm: what a sample takes grows by as much from 10 to 100 as from 10,000 to 100,000. Textures are
drawn in a fixed memory for texels, of which the largest stage has ten times as many.
"""
import math
import os
import tempfile

import benchRun
from patina import experiment
from patina.cli import outputs

HERE = os.path.dirname(os.path.abspath(__file__))

TEXTURE_MEMORY = 32  # MiB
PARTS = ("open", "read", "draw", "first")


def measure(stage, options, settings):
    """:returns: what growthWorker.py tells of a stage
    :raises SystemExit: with its reason"""
    return benchRun.figures(stage, [os.path.join(HERE, "growthWorker.py"), stage, options.size, options.samples, *settings])


def axis(name, options):
    """:returns: list of dicts of one size each: its number, medians of processor seconds by part, of a sample, and megabytes"""
    import growthStages

    make, sizes = growthStages.AXES[name]
    sizes = [size for size in sizes if size <= options.most]
    settings = [f"textureMemory={TEXTURE_MEMORY}"] if name == "textures" else []
    with tempfile.TemporaryDirectory(prefix="growthBench") as folder:
        stages = {}
        for size in sizes:
            stages[size] = make(tempfile.mkdtemp(dir=folder), size)
        found = experiment.turns(options.runs, sizes, lambda size, _: measure(stages[size], options, settings))
    return [{"size": size, **experiment.medians(runs, PARTS, lambda run, part: run[part]["processor"]),
             **experiment.medians(runs, ["wall"], lambda run, clock: run["first"][clock]),
             **experiment.medians(runs, ("sample", "peak", "textures"))} for size, runs in found.items()]


def exponents(rows, part):
    """:returns: the slope of log over log from each row to the next"""
    return [math.log(max(b[part], 1e-9) / max(a[part], 1e-9)) / math.log(b["size"] / a["size"]) for a, b in zip(rows, rows[1:])]


def show(name, rows):
    print("\n" + "\n".join(experiment.table((name, "open, translate, build and draw", "first image", "a sample of all pixels",
                                            "memory"))))
    for i, row in enumerate(rows):
        slope = {part: f" ({exponents(rows[i - 1:i + 1], part)[0]:.2f})" if i else "" for part in ("first", "sample", "peak")}
        texels = f", {row['textures']:.0f} of texels" if row["textures"] else ""
        print(experiment.table_row((
            f"{row['size']:,}", f"{row['open']:.2f} + {row['read']:.2f} + {row['draw']:.2f} s",
            f"{row['first']:.2f} s{slope['first']}", f"{1e3 * row['sample']:.1f} ms{slope['sample']}",
            f"{row['peak']:.0f} MB{slope['peak']}{texels}")), flush=True)
    if len(rows) > 1:
        print()
        steps = [1e3 * (b["sample"] - a["sample"]) / math.log10(b["size"] / a["size"]) for a, b in zip(rows, rows[1:])]
        print(f"steepest: first image {max(exponents(rows, 'first')):.2f}, memory {max(exponents(rows, 'peak')):.2f} "
              "(target: at most 1)"
              + ("; ms of a sample that ten times as many cost, step by step: " + ", ".join(f"{step:.0f}" for step in steps)
                 + " (target: the same)" if name == "lights" else ""), flush=True)


def main(arguments):
    import growthStages

    parser = benchRun.Parser("growth", __doc__, "160x120", samples=(9, "from which the time of one is taken"),
                               runs=(3, "processes of each size"))
    parser.add_argument("axes", nargs="*", help=f"of {', '.join(growthStages.AXES)} (default: all)")
    parser.add_argument("--most", type=float, default=math.inf, help="of a thing: leaves larger stages out")
    options = parser.parse(arguments)
    results = {}
    for name in parser.known(options.axes, growthStages.AXES, options.runs >= 1 and options.samples >= 2,
                             "--runs takes at least 1, --samples at least 2"):
        results[name] = axis(name, options)
        show(name, results[name])
    outputs.write_json(options.json, {"size": options.size, "samples": options.samples, "runs": options.runs, "axes": results})
    return 0
