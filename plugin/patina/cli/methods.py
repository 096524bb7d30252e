# SPDX-License-Identifier: Apache-2.0
"""--method POINT=NAME: forces a method at a choice point of the planner."""
import textwrap

from patina import limits
from patina.cli.compiled import _patina
from patina.cli.errors import UsageError


def add_flag(group):
    group.add_argument("--method", action=limits.Collect, listing=_listing, default=[], metavar="POINT=NAME",
                       help="force a method at a choice point (repeatable); --method list shows all of them")


def parse(texts):
    """:returns: dict of choice point -> method"""
    methods = {}
    for text in texts:
        point, equals, name = text.partition("=")
        if not point or not equals or not name:
            raise UsageError(f"patina: --method {text}: write it as POINT=NAME")
        methods[point] = name
    problem = _patina.check_methods(methods) if methods else ""
    if problem:
        raise UsageError(f"patina: --method: {problem}")
    return methods


def _measured(figures):
    """One line for what `patina chart --lobes` measured; the worst of all subjects."""
    if figures is None:
        return []
    if figures["errorOf"] == "effort":
        return [f"measured: time x variance {figures['mean']:.2g} of the default's in the mean, {figures['largest']:.2g} at "
                "most"]
    return [f"measured: mean {figures['errorOf']} {'' if figures['errorOf'] == 'noise' else 'error '}"
            f"{figures['mean']:.2g}, largest {figures['largest']:.2g}, {figures['cost']:.2g} times the default's time"]


def _listing():
    lines = []
    points = _patina.choice_points()
    indent = 4 + max(len(name) for _, names in points for name, _ in names)
    for point, names in points:
        lines.append(point)
        for i, (name, description) in enumerate(names):
            text = textwrap.wrap(("(the default) " if i == 0 else "") + description, 90)
            text += _measured(_patina.method_figures(point, name))
            lines += [f"  {name:<{indent - 2}}{text[0] if text else ''}".rstrip()]
            lines += [" " * indent + more for more in text[1:]]
    return "\n".join(lines)
