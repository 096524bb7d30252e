"""How far the rasterizer may be from the path tracer, per scene: budgets.json beside this file. Budgets only go down,
unless somebody writes down why one had to rise.

budgets.json: `quick` and `full` are settings (samples, width); `scenes` maps a name to
  same    true where both back ends have the same answer to direct light
  why     what the rasterizer leaves out, where they differ by design; or why FLIP is not below LARGEST_FLIP yet
  checks  what else stands for the scene: tests against other renderers or closed forms
  quick   worst 8x8 block and bias of the mean that the test allows: beside direct light where both have the same answer,
          else beside all light. The pixels of a pass share their light samples, so few passes are off as a whole, by chance;
          a budget is the largest of SEEDS seeds of the rasterizer, and the test looks at the first
  full    what was measured: FLIP against direct light and against all light, RMSE, bias, seconds; `flipSeeds` between two
          seeds of the path tracer
  truth   the same direct light beside many more path traced samples: how many, and FLIP of both back ends' images from
          them. Where FLIP is above LARGEST_FLIP the rasterizer's has to be below it, or no larger than the path tracer's
  raised  reasons of the budgets that rose
"""
import json
import os

FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "budgets.json")
SLACK, LEAST = 1.1, 0.004  # between a measurement and the budget that it sets
LARGEST_FLIP = 0.01        # where both have the same answer
SEEDS = 3


def load():
    with open(FILE, encoding="utf-8") as file:
        return json.load(file)


def save(budgets):
    with open(FILE, "w", encoding="utf-8") as file:
        json.dump(budgets, file, indent=1)
        file.write("\n")


def settle(entry, kind, found, reason=None):
    """Sets budgets of one scene from a measurement.

    :param entry: of the scene, changed in place
    :param kind: "quick" (with slack) or "full" (as measured)
    :param found: dict of measured numbers; bias counts by its size
    :param reason: why a budget may rise
    :returns: names of budgets that would have to rise and were left as they are"""
    held = entry.setdefault(kind, {})
    refused = []
    for key, value in found.items():
        if value is None:
            continue
        wanted = abs(value) * SLACK + LEAST if kind == "quick" else value
        if key.startswith("seconds"):
            held[key] = round(wanted, 1)
        elif key not in held or abs(wanted) <= abs(held[key]):
            held[key] = rounded(wanted)
        elif abs(rounded(wanted)) > abs(held[key]):
            if reason is None:
                refused.append(f"{kind} {key}: {rounded(wanted)} above {held[key]}")
            else:
                entry.setdefault("raised", []).append(f"{kind} {key} {held[key]} -> {rounded(wanted)}: {reason}")
                held[key] = rounded(wanted)
    return refused


def rounded(value):
    return float(f"{value:.3g}")
