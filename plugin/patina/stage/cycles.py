# SPDX-License-Identifier: Apache-2.0
"""Point instancers that hold themselves, by any way through prototypes and native instances."""
import bisect
import graphlib
import itertools

from pxr import Usd

from . import kinds

MOST_STEPS = 5000000  # a stage that would take more is taken for one that has such instancers


def are_in(stage):
    """:returns: whether a point instancer lies below one of its own prototypes, or below a prototype of one that does"""
    below = _holders(stage)
    paths, graph, steps = sorted(below), graphlib.TopologicalSorter(), 0
    for path, roots in below.items():
        for held in itertools.chain.from_iterable(_within(paths, root) for root in roots):
            steps += 1
            if steps > MOST_STEPS:
                return True
            graph.add(path, held)
    try:
        graph.prepare()
    except graphlib.CycleError:
        return True
    return False


def _holders(stage):
    """:returns: path of a point instancer or a native instance -> paths of what it holds"""
    found = {}
    for root in [stage.GetPseudoRoot(), *stage.GetPrototypes()]:
        for prim in Usd.PrimRange(root, Usd.PrimAllPrimsPredicate):
            if prim.IsInstance():
                found[str(prim.GetPath())] = [str(prim.GetPrototype().GetPath())]
            elif "PointInstancer" in kinds.schemas_of(prim):
                targets = prim.GetRelationship("prototypes").GetForwardedTargets()
                found[str(prim.GetPath())] = [str(_composed(stage, path)) for path in targets]
    return found


def _composed(stage, path):
    """:returns: where what stands at a path is listed: in a prototype where it is a native instance's"""
    prim = stage.GetPrimAtPath(path)
    return prim.GetPrimInPrototype().GetPath() if prim and prim.IsInstanceProxy() else path


def _within(paths, root):
    """Yields those of sorted paths that are a path, or below it."""
    at = bisect.bisect_left(paths, root)
    if at < len(paths) and paths[at] == root:
        yield root
    for i in range(bisect.bisect_left(paths, root + "/"), bisect.bisect_left(paths, root + "0")):
        yield paths[i]
