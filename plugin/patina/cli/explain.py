# SPDX-License-Identifier: Apache-2.0
"""Shows how a material is modelled: its network as authored, the simplified graph, the plan of lobes, the parts that were left
out, and the method at each choice point that matters, with its predicted error and time. A file of several materials begins
with a summary, one line each; --verbose shows them all in full. Warnings come last, grouped by cause as in `patina record`.

  patina explain shot.usda --tolerance 0.01    what the planner would choose for 1 % of error
  patina explain shot.usda:/looks/gold         one material in full

For a whole stage with a tolerance it also builds the scene and prints the choices for it: the edges of subdivision surfaces
(for an image of 960 pixels from the first camera), the length of paths, and for the rasterizer how each material is lit. With
--levels measured it draws the levels of detail alone, and tells their errors and which are taken.
"""
import dataclasses
import os
from concurrent.futures import ThreadPoolExecutor

from patina.cli import causes, materials, methods, outputs, planText, recordFlags, sceneChoices, statistics
from patina.cli.compiled import _patina


def add_arguments(parser):
    parser.add_argument("material", metavar="STAGE|MATERIAL", help=materials.EVERY_HELP)
    materials.add_flags(parser)
    recordFlags.add_tolerance_flag(parser)
    recordFlags.add_levels_flag(parser)
    parser.add_argument("--backend", default="embree", choices=["embree", "raster"],
                        help="the renderer whose choices for the scene are shown, with --tolerance (default: embree)")
    parser.add_argument("--verbose", "-v", action="store_true", help="all materials in full, after the summary")
    parser.add_argument("--json", metavar="FILE", help="write texts and warnings as JSON: --json to standard "
                                                       "output, --json=FILE to a file")


def run(arguments):
    recordFlags.check_levels(arguments, "explain")
    found, warnings = materials.load(arguments.material, arguments.set, every=True)
    outputs.check_all([arguments.json])
    chosen = methods.parse(arguments.method)
    tolerance = arguments.tolerance
    with ThreadPoolExecutor(os.cpu_count()) as pool:  # most of it is reading textures
        plans = list(pool.map(lambda pair: (pair[0], _patina.plan_material(pair[1], chosen, tolerance)), found))
    choices, lit, levels = _of_scene(arguments, chosen, tolerance)
    texts = []
    for (name, network), (_, plan) in zip(found, plans):
        planned = {choice["point"]: choice["method"] for choice in plan["choices"]}
        texts.append((name, _patina.explain_material(network, warnings, dict(chosen, **planned))))
    if arguments.json:
        outputs.write_json(arguments.json, {
            "materials": [{"name": name, "text": text, "plan": plan} for (name, text), (_, plan) in zip(texts, plans)],
            "error": max(plan["error"] for _, plan in plans), "scene": [dict(choice) for choice in choices],
            "lit": planText.lit(lit), "levels": [dataclasses.asdict(root) for root in levels],
            "causes": statistics.Causes(warnings).groups,
            "warnings": warnings})
        return
    several = len(texts) > 1
    if several:
        print("\n".join(planText.summary_lines(texts, plans)))
    for i, (name, text) in enumerate(texts if arguments.verbose or not several else ()):
        if several:
            print(f"\n=== {causes.printable(name)}")
        for line in text.rstrip("\n").split("\n"):
            print(causes.printable(line))
        print("\n".join(planText.lines(plans[i][1])))
    if several:
        print("\n" + "\n".join(planText.scene_lines(plans, tolerance)))
    if choices or lit:
        print("\n".join(planText.choice_lines(choices) + planText.level_lines(levels) + planText.lit_lines(lit)))
    if several and not arguments.verbose:
        one = causes.printable(f"{arguments.material}:{texts[0][0]}")
        print(f"\n--verbose shows all of them in full, {one} one")
    statistics.report(warnings)


def _of_scene(arguments, chosen, tolerance):
    """:returns: choices of the scene, plans of its back end and measured levels of detail; nothing without a tolerance and of
        what is no stage"""
    file, name = materials.split(arguments.material)
    if tolerance < 0.0 or name or materials.is_document(file):
        return [], {}, []
    return sceneChoices.of_stage(file, arguments.set, chosen, tolerance, arguments.backend, arguments.levels == "measured")
