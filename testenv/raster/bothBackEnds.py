#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders test scenes by both back ends and writes one HTML page: a table of RMSE, FLIP, bias and times, then the images.

    bothBackEnds.py OUTPUT_FOLDER [SCENE...] [--samples N] [--width PIXELS] [--truth N] [--update] [--assets] [--resume]
                    [--sheets N]

Without names all of testenv/scenes, with --assets also all stages under $PATINA_ASSETS and each material of its documents.
The page also shows what earlier runs with the same samples and width left in the folder, so that it can be made in pieces;
those whose largest block of 8 x 8 pixels differs most come first. --resume renders no pair again that this build left in
the folder. --sheets pastes the pairs into images of N each, in the page's order: rasterizer, direct light, difference.

The path tracer renders twice: stopped after direct light, which is what the rasterizer draws, and whole. --update writes
what was measured to recordedPairs.json, from which --table prints the rows of docs/measurements/rasterPairs.md; they are no
bounds (those are equivalence.py's). --truth also holds both direct images against so many path traced samples; pairs that
the folder holds are not rendered again then.
"""
import argparse
import os
import sys
import time

if __name__ == "__main__":
    folder = os.path.dirname(os.path.abspath(__file__))
    sys.path[:0] = [folder, os.path.join(folder, "..")]
    import checkout

    checkout.enter()

import everyAsset  # noqa: E402
import pairs  # noqa: E402
import pairsPage  # noqa: E402
import pairsSheet  # noqa: E402
import recordedPairs  # noqa: E402
from pairs import SCENES, needs_opengl, numbers, pixels, record  # noqa: E402, F401  (for tests beside this)


def report(row):
    text = f"{row['name']:22}"
    for depth, found in row["traced"].items():
        text += (f" {'direct' if depth == pairs.DIRECT else 'all'}: bias {100 * found['bias']:+7.2f} %  RMSE "
                 f"{found['rmse']:.4f}  FLIP {pairsPage.flip_text(found['flip'])}  worst block {100 * found['worst']:3.0f} % ")
    return text + f" {row['rasterSeconds']:.1f} s, {found['seconds']:.1f} s"


def progress(number, count, rendered, seconds):
    """:returns: how far the run is, and about how long the rest takes where as many of it are rendered as until now"""
    left = seconds / number * (count - number) / 60 if rendered else 0
    return f"{number:3d}/{count}, {left:3.0f} min left: "


def worst_first(rows):
    """:param rows: name -> row
    :returns: list of rows: those that failed, then by the largest difference of a block in direct light"""
    return sorted(rows.values(), key=lambda row: (-row["traced"][pairs.DIRECT]["worst"]
                                                  if "error" not in row else -float("inf"), row["name"]))


def measured(row):
    """:returns: what recordedPairs.json holds of a row"""
    direct = row["traced"][pairs.DIRECT]
    whole = row["traced"][pairs.WHOLE]
    return {"flip": direct["flip"], "rmse": direct["rmse"], "bias": direct["bias"], "flipWhole": whole["flip"],
            "rmseWhole": whole["rmse"], "biasWhole": whole["bias"], "secondsRaster": row["rasterSeconds"],
            "secondsDirect": direct["seconds"], "secondsWhole": whole["seconds"]}


def table(held):
    """Prints the table of docs/measurements/rasterPairs.md."""
    print("| scene | RMSE | FLIP | bias | all light: FLIP | bias | seconds, raster : traced |\n|---|---|---|---|---|---|---|")
    for name, entry in held["scenes"].items():
        f = entry.get("full")
        if f:
            cells = [name, f"{f['rmse']:.4f}", f"{f.get('flip', 0):.4f}", f"{100 * f['bias']:+.2f} %"]
            cells += [f"{f['flipWhole']:.3f}", f"{100 * f['biasWhole']:+.1f} %"] if "flipWhole" in f else ["", ""]
            cells += [f"{f['secondsRaster']:.0f} : {f['secondsDirect']:.0f}" if "secondsRaster" in f else ""]
            print("| " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--samples", type=int)
    parser.add_argument("--width", type=int)
    parser.add_argument("--truth", type=int, metavar="N")
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--assets", action="store_true")
    parser.add_argument("--resume", action="store_true")
    parser.add_argument("--sheets", type=int, metavar="N")
    parser.add_argument("--table", action="store_true")
    a = parser.parse_intermixed_args()
    held = recordedPairs.load()
    if a.table:
        return table(held)
    if not a.folder:
        parser.error("a folder is needed")
    if a.sheets is not None and a.sheets < 1:
        parser.error("--sheets: a sheet has at least one row")
    if a.sheets:
        pairsSheet.check()
    settings = held["settings"] if a.update else {"samples": 32, "width": 64}
    samples, width = a.samples or settings["samples"], a.width or settings["width"]
    if a.update and (samples, width) != (settings["samples"], settings["width"]):
        parser.error("--update goes with the samples and width of recordedPairs.json")
    os.makedirs(a.folder, exist_ok=True)
    rows, remarks = {}, {}
    every = pairs.names()
    if a.assets:
        every += everyAsset.names()
    chosen = a.scenes or every
    for name in every:
        before = None if name in chosen else pairs.kept(name, a.folder, samples, width)
        if before:
            rows[name] = before
            remarks[name] = held["scenes"].get(name, {}).get("why", "")
    start, rendered = time.monotonic(), 0
    for position, name in enumerate(chosen):
        entry = held["scenes"].setdefault(name, {}) if not name.startswith(everyAsset.PREFIX) else {}
        remarks[name] = entry.get("why", "")
        try:
            depths = (pairs.DIRECT, pairs.WHOLE)
            row = pairs.kept(name, a.folder, samples, width) if a.truth or a.resume else None
            if not row or any(depth not in row["traced"] for depth in depths) or a.resume and not pairs.of_this_build(row):
                row = pairs.pair(name, a.folder, samples, width, depths)
                pairs.keep(row, a.folder)
                rendered += 1
            print(progress(position + 1, len(chosen), rendered, time.monotonic() - start) + report(row), flush=True)
            if a.truth:
                found = pairs.beside_truth(row, pairs.truth_of(name, a.folder, a.truth, width), a.truth)
                print(f"{name:22} beside {a.truth} samples: FLIP {found['raster']:.4f} rasterized, "
                      f"{found['traced']:.4f} traced")
                if a.update:
                    entry["truth"] = {**{key: recordedPairs.rounded(value) for key, value in found.items()}, "samples": a.truth}
            if a.update:
                entry["full"] = {key: recordedPairs.rounded(value) for key, value in measured(row).items() if value is not None}
                recordedPairs.save(held)
        except RuntimeError as error:
            row = {"name": name, "error": str(error)}
            print(f"{name:22} {error}", flush=True)
        rows[name] = row
        page = pairsPage.write(worst_first(rows), a.folder, f"Both back ends, {samples} samples, {width} pixels wide", remarks)
    print(page)
    for sheet in pairsSheet.write(worst_first(rows), a.folder, a.sheets) if a.sheets else []:
        print(sheet)


if __name__ == "__main__":
    main()
