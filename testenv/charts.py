#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the project's own charts again, on this machine, and writes those that documents show.

    charts.py [--out FOLDER] [--only KIND]... [--quick]
    charts.py --redraw           draws those that have a table anew, from the table: nothing is measured

Kinds are those of `patina chart`: lobes, scenes, splats, stability, predictions; and features, of `patina bench`. Each runs
in a process of its own; of what it writes the files named below go to the folder (default: docs/charts). --quick takes small
pictures and few samples, to see whether it all works. The whole takes about an hour on two cores.
"""
import argparse
import glob
import os
import shutil
import subprocess
import sys
import tempfile

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import checkout

    checkout.enter()

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
ROOM = os.path.join(ROOT, "testenv", "scenes")
# All of them to 5 and 1 %. A tenth of a percent takes a hundred times the samples of one percent: of few pixels, where that is
# affordable.
EVERY = [os.path.relpath(path, ROOT) for path in sorted(glob.glob(os.path.join(ROOM, "*.usda")))
         + sorted(glob.glob(os.path.join(ROOM, "classic", "*.usda")))]
DEAR = ("manyLights", "media", "roughDielectricSlab", "shaderball", "volume")
CHEAP = ("furnace", "lightDistant", "lightDome")


def named(names):
    return [path for path in EVERY if os.path.splitext(os.path.basename(path))[0] in names]


FEW = [path for path in EVERY if path not in named(DEAR + CHEAP)]
PREDICTIONS = ["--predictions", "--backend", "embree", "--maxSamples", "4000000", "--methodSamples", "512", "--quiet"]
SCENES = ("diffuseBox", "lightDome", "shaderball", "roughGlass", "texturedDiffuse")
# kind -> (arguments of patina chart, more than once where a table is made of several, those of --quick instead, files kept)
KINDS = {
    "lobes": ([["--lobes"]], ["--lobes", "--point", "fresnel"],
              ["lobes.csv", "directionalAlbedo_ior_1_5.svg", "energyCompensation_white_metal.svg", "fresnel_ior_1_5.svg",
               "thinFilm_1_33_on_ior_1_5.svg", "diffuse_white.svg"]),
    "scenes": ([[f"testenv/scenes/{name}.usda" for name in SCENES]
               + ["--imageWidth", "128", "--maxSamples", "64", "--seconds", "240", "--quiet"]],
               [f"testenv/scenes/{SCENES[0]}.usda", "--imageWidth", "32", "--maxSamples", "4", "--quiet"],
               ["scenes.csv", "*-relMSE.svg", "*-flip.svg", "*-rmse.svg"]),
    # "knot": testenv/splatKnot.py --alone, which leaves nothing to the rasterizer that it draws otherwise
    "splats": ([["knot", "--imageWidth", "96", "--maxSamples", "16", "--tolerances", "none", "--referenceSamples", "256",
                 "--quiet"]],
               ["knot", "--imageWidth", "32", "--maxSamples", "4", "--tolerances", "none", "--quiet"],
               ["splatKnot-relMSE.svg"]),
    "predictions": ([PREDICTIONS + EVERY + ["--imageWidth", "12", "--tolerances", "0.05,0.01", "--seconds", "300"],
                     PREDICTIONS + named(CHEAP) + ["--imageWidth", "6", "--tolerances", "0.001", "--seconds", "600"],
                     PREDICTIONS + FEW + ["--imageWidth", "3", "--tolerances", "0.001", "--seconds", "600"]],
                    ["--predictions", f"testenv/scenes/{SCENES[0]}.usda", "--backend", "embree", "--imageWidth", "8",
                     "--tolerances", "0.5", "--methodSamples", "4", "--seconds", "1", "--quiet"],
                    ["predictions.csv"]),
    "features": ([["bench", "features"]], ["bench", "features", "--only", "filters", "--width", "8", "--reference", "16"],
                 ["features.csv", "feature_*.svg"]),
    "stability": ([["--stability"]], ["--stability", "--points", "6"], ["stability.svg"]),
}
LARGEST = 1 << 20  # bytes: documents show the folder


def run(kind, folder, quick):
    """:returns: paths of the kept files; exits where the command fails"""
    commands, small, kept = KINDS[kind]
    written = {}  # name -> path
    for arguments in [small] if quick else commands:
        with tempfile.TemporaryDirectory() as made:
            bench = arguments[0] == "bench"
            if arguments[0] == "knot":
                arguments = [os.path.join(made, "splatKnot.usdc"), *arguments[1:]]
                knot = os.path.join(ROOT, "testenv", "splatKnot.py")
                subprocess.run([sys.executable, knot, arguments[0], "--alone"], check=True)
            command = [sys.executable, "-m", "patina", *([] if bench else ["chart"]), *arguments,
                       "--charts" if bench else "--out", made]
            print("patina", *command[3:-2], flush=True)
            found = subprocess.run(command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            if found.returncode != 0:
                sys.exit(f"{kind}: {found.stderr.strip()}")
            for path in (path for pattern in kept for path in sorted(glob.glob(os.path.join(made, pattern)))):
                name = os.path.basename(path)
                if name in written:
                    append(path, written[name])
                else:
                    written[name] = shutil.copy(path, folder)
    if not written:
        sys.exit(f"{kind}: nothing was written")
    return list(written.values())


def redraw(folder):
    """:returns: paths of the charts of scenes, lobes and features, drawn from their tables"""
    from patina import experiment
    from patina.chart import lobes, sceneCharts, sceneResults

    with tempfile.TemporaryDirectory() as made:
        sceneCharts.write(sceneResults.read_csv(os.path.join(folder, "scenes.csv")), made)
        rows = [dict(row, ns=float(row["ns"]), mean=float(row["mean"]))
                for row in experiment.read_csv(os.path.join(folder, "lobes.csv"))]
        lobes.write_charts(rows, made)
        sys.path.append(os.path.join(ROOT, "testenv", "bench"))
        import featureBench

        featureBench.draw(featureBench.read(os.path.join(folder, "features.csv")), made)
        return [shutil.copy(path, folder) for kind in ("scenes", "lobes", "features") for pattern in KINDS[kind][2]
                for path in sorted(glob.glob(os.path.join(made, pattern)))]


def append(table, whole):
    """The rows of one CSV file below those of another with the same columns."""
    with open(table, encoding="utf-8") as rows, open(whole, "a", encoding="utf-8") as file:
        file.writelines(rows.readlines()[1:])


def summarize(path):
    """A table of predictions in a few words."""
    from patina.chart import predictions

    print(predictions.summary(predictions.read(path)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default=os.path.join(ROOT, "docs", "charts"))
    parser.add_argument("--only", action="append", choices=KINDS)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--redraw", action="store_true")
    a = parser.parse_args()
    if a.redraw:
        print("\n".join(redraw(a.out)))
        return
    os.makedirs(a.out, exist_ok=True)
    for kind in a.only or KINDS:
        for path in run(kind, a.out, a.quick):
            print(f"  {path}")
            if os.path.basename(path) == "predictions.csv":
                summarize(path)
    size = sum(os.path.getsize(path) for path in glob.glob(os.path.join(a.out, "*")))
    print(f"{size / 1024:.0f} KiB")
    if size > LARGEST:
        sys.exit(f"{a.out} has more than 1 MiB: documents show it")


if __name__ == "__main__":
    main()
