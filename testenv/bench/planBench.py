# SPDX-License-Identifier: Apache-2.0
"""The plan: time to a tolerance with planned methods, beside the same tolerance without a plan.

Without a plan every choice point has the method that tolerance 0 takes there: walks, quadrature, paths of 1024 surfaces, edges
of half a pixel. Both sample until the noise is within what the same tolerance leaves, and both start from a stage that is read
and nothing more, so building and compiling count. Times are of processors; runs take turns; a row is the median of the ratios
of its runs. Quadrature may take minutes for a pass, so renders end after --seconds. Where only the one without a plan does, the
ratio is a bound ("at most"). Where both end early, by seconds or by samples, the ratio is that of the time of a sample.
"""
import os
import statistics
import time

import benchRun
import inProcess
from patina import experiment
from patina.cli import outputs

# Below the folder of assets: public stages of others, of all kinds. The standard shader ball is ASWF's, the others are of the
# USD working group.
ASSETS = (
    "StandardShaderBall/standard_shader_ball_scene.usda",
    "SubdivisionSurfaces/Creases_SpinningPyramids.usda",
    "Teapot/Teapot.usd",
    "test_assets/AlphaBlendModeTest/AlphaBlendModeTest.usd",
    "test_assets/MaterialXTest/basicTextured.usda",
    "test_assets/NormalsTextureBiasAndScale/NormalsTextureBiasAndScale.usda",
    "test_assets/RoughnessTest/RoughnessTest.usdz",
    "test_assets/TextureTransformTest/TextureTransformTest.usd",
    "test_assets/USDZ/BrainStem/BrainStem.usdz",
    "test_assets/USDZ/CesiumMan/CesiumMan.usdz",
    "test_assets/schemaTests/usdGeom/primitives/all_primitives.usda",
    "test_assets/schemaTests/usdGeom/meshes/subdiv_catmullClark/subdiv_catmullClark.usda",
)
SCENES = ("diffuseBox", "hair", "instances", "lightDome", "lightSphere", "plastic", "roughConductor", "roughGlass",
          "shaderball", "subdivision", "texturedMesh", "volume")


def stages_of(options):
    """:returns: name -> file"""
    if options.stages:
        return {os.path.splitext(os.path.basename(path))[0]: path for path in options.stages}
    if not options.assets:
        return {name: inProcess.scene(name) for name in SCENES}
    paths = [os.path.join(options.assets, *name.split("/")) for name in ASSETS]
    missing = [path for path in paths if not os.path.exists(path)]
    if missing:
        raise SystemExit(f"patina bench plan: there is no {missing[0]}")
    return {os.path.splitext(os.path.basename(path))[0]: path for path in paths}


def truths_of(stage):
    """:returns: choice point -> the method that tolerance 0 takes there; where materials differ (points of noise), none"""
    stage.image(0, samples=1, tolerance=0.0, dataWindow=(0, 0, 0, 0))
    found = {}
    for choice in [*stage.state["sceneChoices"], *(c for plan in stage.state["plans"].values() for c in plan["choices"])]:
        found.setdefault(choice["point"], set()).add(choice["method"])
    return {point: next(iter(methods)) for point, methods in found.items() if len(methods) == 1}


class Once:
    """A stage that has been read and not been drawn; drawn once to the tolerance."""

    def __init__(self, path, options, methods):
        self.stage = inProcess.Stage(path, "-w", options.width, "--tolerance", options.tolerance,
                                     "--samples", options.samples, "--minSamples", 4, "--seconds", options.seconds)
        self.stage.settings.update(maxDepth=-1, methods=methods, threads=options.threads)

    def seconds(self, seed):
        """:returns: processor seconds, samples of a pixel, whether it ended before the tolerance was reached, and the error
            that the plan expects"""
        stage, begin, wall = self.stage, time.process_time(), time.perf_counter()
        film = stage.film(seed=seed)
        took, counts = time.process_time() - begin, film.resolve("sampleCount")
        ended = counts.max() >= stage.settings["samples"] or time.perf_counter() - wall >= stage.settings["seconds"]
        return took, float(counts.mean()), bool(ended), stage.state["statistics"].get("predictedError", 0.0)


def measure(path, options):
    """:returns: a row: the ratio, and seconds and samples of both"""
    truths = truths_of(inProcess.Stage(path, "-w", options.width))
    runs = []
    for run in range(options.runs):
        both = {"plan": {}, "without": truths}
        order = list(both) if run % 2 == 0 else list(both)[::-1]
        runs.append({name: Once(path, options, both[name]).seconds(run + 1) for name in order})
    row = experiment.spread([ratio_of(run["plan"], run["without"]) for run in runs])
    row["expected"] = runs[0]["plan"][3]
    for name in ("plan", "without"):
        row[name] = {"seconds": statistics.median(run[name][0] for run in runs),
                     "samples": statistics.median(run[name][1] for run in runs), "ended": any(run[name][2] for run in runs)}
    return row


def ratio_of(plan, without):
    """:param plan,without: what Once.seconds() tells of both"""
    samples = without[1] / plan[1] if plan[2] and without[2] else 1.0
    return plan[0] / without[0] * samples


def main(arguments):
    parser = benchRun.Parser("plan", __doc__, width=(64, "of the images"), samples=(4096, "at most"),
                               runs=(5, "pairs of images"), threads=(0, "of a render"))
    parser.add_argument("stages", nargs="*", help="(default: those of --assets, else scenes of testenv)")
    parser.add_argument("--assets", metavar="FOLDER", help="takes twelve public stages from it: StandardShaderBall, Teapot, "
                                                           "SubdivisionSurfaces and test_assets of the USD working group")
    parser.add_argument("--tolerance", type=float, default=0.01, help="(default: 0.01)")
    parser.add_argument("--seconds", type=float, default=120.0, help="of a render at most (default: 120)")
    options = parser.parse(arguments)
    if options.runs < 1 or options.tolerance <= 0.0:
        parser.error("--runs takes at least 1, --tolerance more than 0")
    results = {}
    print(f"to a tolerance of {options.tolerance:g}")
    print("\n".join(experiment.table(("stage", "with the plan, over without", "seconds", "samples of a pixel"))))
    for name, path in stages_of(options).items():
        row = results[name] = measure(path, options)
        early = row["without"]["ended"] and ("of a sample" if row["plan"]["ended"] else "at most")
        print(experiment.table_row((
            name, f"{early + ' ' if early else ''}{row['ratio']:.2f} ({row['least']:.2f} to {row['most']:.2f})",
            f"{row['plan']['seconds']:.2f}, {row['without']['seconds']:.2f}",
            f"{row['plan']['samples']:.0f}, {row['without']['samples']:.0f}")), flush=True)
    ratios = [row["ratio"] for row in results.values()]
    print(f"median {statistics.median(ratios):.2f} (target: at most 0.5), largest {max(ratios):.2f} (target: 1.05)")
    outputs.write_json(options.json, {"tolerance": options.tolerance, "width": options.width, "stages": results})
    return 0
