# SPDX-License-Identifier: Apache-2.0
"""A plan of methods as text: what was chosen at every choice point, and what that is expected to do."""
import math

from patina.cli import causes


def seconds_of(plan, key="ns"):
    """:returns: nanoseconds of all choices together"""
    return sum(choice[key] for choice in plan["choices"])


def lines(plan):
    """:param plan: of _patina.plan_material()

    :returns: list of lines
    """
    whose = "plan of the fallback" if plan["fallback"] else "plan"
    if not plan["choices"]:
        return [f"{whose}: no choice point with a truth or with noise matters to "
                + ("displayColor" if plan["fallback"] else "this material")]
    tolerance = plan["tolerance"]
    head = "default methods" if tolerance < 0.0 else f"tolerance {tolerance:g}"
    result = [f"{whose}: {head}; albedo {plan['albedo']:.2f} at most" +
              (", parameters vary: the worst that they show counts" if plan["varies"] else ""),
              f"  {'choice point':<20}{'method':<14}{'predicted error':>16}{'ns':>9}{'of truth':>10}{'of default':>12}"]
    for choice in plan["choices"]:
        error = f"{choice['error']:.2g}" if choice["measured"] else "not measured"
        result.append(f"  {choice['point']:<20}{choice['method']:<14}{error:>16}{choice['ns']:>9.0f}"
                      f"{_ratio(choice['ns'], choice['nsTruth']):>10}{_ratio(choice['ns'], choice['nsDefault']):>12}"
                      + ("  forced" if choice["forced"] else ""))
    spent = seconds_of(plan)
    result.append(f"  {'together':<34}{plan['error']:>16.2g}{spent:>9.0f}{_ratio(spent, seconds_of(plan, 'nsTruth')):>10}"
                  f"{_ratio(spent, seconds_of(plan, 'nsDefault')):>12}")
    if tolerance > 0.0 and plan["error"] > tolerance:
        result.append(f"  the forced methods alone are expected to miss the tolerance {tolerance:g}")
    return result


def summary_lines(texts, plans):
    """One line for each material.

    :param texts: list of (name, what _patina.explain_material() says)
    :param plans: list of (name, plan), likewise
    :returns: list of lines of a table: lobes that a ray meets, parts that were left out, and as `lines` has them the error and
        the time of all methods together"""
    width = max([len("material")] + [len(causes.printable(name)) for name, _ in texts])
    result = [f"{'material':<{width}}{'lobes':>7}{'left out':>10}{'predicted error':>17}{'of default':>12}  methods"]
    for (name, text), (_, plan) in zip(texts, plans):
        begins = [line.partition(" ")[0] for line in text.splitlines()]
        spent = _ratio(seconds_of(plan), seconds_of(plan, "nsDefault"))
        result.append(f"{causes.printable(name):<{width}}{begins.count('lobe'):>7}{begins.count('left'):>10}{plan['error']:>17.2g}"
                      f"{spent:>12}  " + (", ".join(choice["method"] for choice in plan["choices"]) or "-")
                      + (" (of displayColor, which is shown)" if plan["fallback"] else ""))
    return result


def _ratio(value, base):
    return f"{value / base:.3g}x" if base > 0.0 else "-"


def scene_lines(plans, tolerance):
    """The plans of all materials, summed up for an image of the scene.

    :param plans: list of (name, plan)
    """
    errors = [(plan["error"], name) for name, plan in plans]
    worst, name = max(errors)
    spent = {key: sum(seconds_of(plan, key) for _, plan in plans) for key in ("ns", "nsTruth", "nsDefault")}
    result = [f"scene: methods are expected to cost a relative luminance error of {worst:.2g} where {name} fills the image, "
              f"{sum(e for e, _ in errors) / len(errors):.2g} as the mean of its materials",
              f"scene: lobes take {_ratio(spent['ns'], spent['nsTruth'])} the time of the truths and "
              f"{_ratio(spent['ns'], spent['nsDefault'])} that of the defaults"]
    if tolerance > 0.0:
        noise = math.sqrt(max(tolerance**2 - worst**2, 0.0))
        result.append(f"scene: noise may take {noise:.2g} of the tolerance {tolerance:g}")
    elif tolerance == 0.0:
        result.append("scene: all samples are taken")
    return result


def choice_lines(choices):
    """:param choices: of the scene as a whole, as Renderer.progress() tells them; times are over those of the default

    :returns: list of lines
    """
    lines = []
    for choice in choices:
        error = f"expected error {choice['error']:.2g}" if choice["point"] != "roulette" else "noise alone"
        what = "time x variance" if choice["point"] == "roulette" else "time"
        lines.append(f"scene: {choice['point']} {choice['method']}, {error}, {choice['ns']:.3g} times the {what} of the default"
                     + (", forced" if choice["forced"] else ""))
    return lines


def level_lines(roots):
    """:param roots: measuredLevels.Roots
    :returns: list of lines"""
    return [f"scene: level {root.names[root.chosen]} of {root.path}, expected error {root.errors[root.chosen]:.2g}, "
            f"{root.triangles[root.chosen]} of {root.triangles[root.truth]} triangles" for root in roots]


LIGHT_POINTS = ("domeLight", "environmentSamples", "areaLight")


def lit(plans):
    """:param plans: material path -> plan, as Renderer.progress() tells them

    :returns: dict of material path -> choices of how the rasterizer lights it
    """
    found = {path or "displayColor": [dict(c) for c in plan["choices"] if c["point"] in LIGHT_POINTS]
             for path, plan in plans.items()}
    return {path: choices for path, choices in found.items() if choices}


def lit_lines(plans):
    """:returns: list of lines, materials with the same choices together"""
    groups = {}
    for path, choices in lit(plans).items():
        text = ", ".join(f"{c['point']} {c['method']}" + (f" (expected error {c['error']:.2g})" if c["error"] else "") +
                         (f" in {_ratio(c['ns'], c['nsDefault'])} the time of samples" if c["method"] != "sampled" and
                          c["nsDefault"] > 0.0 else "") for c in choices)
        groups.setdefault(text, []).append(path)
    return [f"scene: {text}: {', '.join(paths)}" for text, paths in groups.items()]


def of_scene(plans, choices=()):
    """:param plans: material path -> plan, as Renderer.progress() tells them
    :param choices: of the scene as a whole

    :returns: dict for --json: by material the predicted error and what was chosen, by choice point the materials' choices, and
        those of the scene
    """
    materials = {path or "displayColor": {"error": plan["error"], "albedo": plan["albedo"],
                                          "methods": {choice["point"]: choice["method"] for choice in plan["choices"]}}
                 for path, plan in plans.items()}
    points = {}
    for material in materials.values():
        for point, method in material["methods"].items():
            points.setdefault(point, {}).setdefault(method, 0)
            points[point][method] += 1
    scene = {choice["point"]: {name: choice[name] for name in ("method", "error", "forced")} for choice in choices}
    return {"error": max([m["error"] for m in materials.values()], default=0.0), "methods": points, "materials": materials,
            "scene": scene}


def metadata(plan):
    """:param plan: of of_scene()

    :returns: one line for an image's metadata: materials with the same choices together
    """
    groups = {}
    for path, material in plan["materials"].items():
        chosen = " ".join(f"{point}={method}" for point, method in material["methods"].items())
        groups.setdefault(chosen, []).append(f"{path} ({material['error']:.2g})")
    lines = [f"{chosen}: {', '.join(paths)}" for chosen, paths in groups.items()]
    scene = " ".join(f"{point}={choice['method']}" for point, choice in plan["scene"].items())
    return "; ".join(lines + ([f"{scene}: scene"] if scene else []))
