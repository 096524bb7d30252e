# SPDX-License-Identifier: Apache-2.0
"""The Pareto front: points that nothing else beats in both time and error."""
import math


def pareto(points):
    """Those of (cost, error, ...) that no other beats in both, by cost."""
    best, kept = math.inf, []
    for point in sorted(points, key=lambda p: (p[0], p[1])):
        if point[1] < best:
            best = point[1]
            kept.append(point)
    return kept
