# SPDX-License-Identifier: Apache-2.0
"""Do two ways draw the same picture of a stage? By tiles, as `patina.regression.welch` has them.

With one seed both take the same samples. Where no tile then differs by more than MARGIN, the pictures agree. Else renders with
seeds of their own are compared by Welch's test until a tile differs or the last look is reached."""
import math

import numpy as np

from patina.regression import welch

MARGIN = 0.01  # of a tile's value
# Of a picture's mean: so much smaller is the area of a ball of UsdImagingDelegate, seen along its axis. It has ten sides and is
# subdivided; the limit of a decagon, a cubic B-spline, has (4 + 2 cos 36 degrees) / 6 of its radius.
COARSE = 1.0 - ((4.0 + 2.0 * math.cos(math.radians(36.0))) / 6.0) ** 2
LOOKS = (4, 12)  # renders of each way
FIRST_SEED, OTHER_SEEDS = 1, 100001  # the two ways share no random numbers


def at_once(found, wanted):
    """:param found: picture of one way
    :param wanted: picture of the other, with the same seed
    :returns: the largest relative difference of a tile, 0 where all bits are the same"""
    if found.shape != wanted.shape:
        return float("inf")
    if (found == wanted).all():
        return 0.0
    a, b = welch.tiles([found])[0], welch.tiles([wanted])[0]
    return float((np.abs(a - b) / (np.abs(b) + welch.FLOOR * np.abs(b).mean() + 1e-12)).max())


def is_coarse(found, wanted):
    """:returns: whether tiles differ, and the means of the pictures hardly do, as where shapes are a little smaller"""
    if not MARGIN < at_once(found, wanted) < float("inf"):
        return False
    means = [image.mean(axis=(0, 1)) for image in (found, wanted)]
    return bool((np.abs(means[0] - means[1]) <= COARSE * means[1] + 1e-6).all())


def decide(found, wanted, draw_found, draw_wanted):
    """:param draw_found: function of a seed -> picture, or None where it fails
    :returns: dict of `word` (same, agrees, differs, undecided, failed), `worst` and `text`"""
    worst = at_once(found, wanted)
    if worst <= MARGIN:
        return {"word": "same" if worst == 0.0 else "agrees", "worst": worst, "text": ""}
    if not np.isfinite(worst):
        return {"word": "differs", "worst": -1.0, "text": "the pictures have different sizes"}
    first, second, interval = [], [], None
    for number in LOOKS:
        first += [draw_found(FIRST_SEED + i) for i in range(len(first), number)]
        second += [draw_wanted(OTHER_SEEDS + i) for i in range(len(second), number)]
        if any(image is None for image in first + second):
            return {"word": "failed", "worst": worst, "text": "a render with another seed failed"}
        interval = welch.compare(welch.tiles(first), welch.tiles(second), looks=len(LOOKS))
        which = interval.outside(MARGIN)
        if which.any():
            return {"word": "differs", "worst": float(np.abs(interval.difference[which]).max()),
                    "text": f"{which.any(axis=-1).sum()} of {which[..., 0].size} tiles: {interval.worst(which, most=1)}"}
    agrees = interval.half.max() <= 5 * MARGIN
    return {"word": "agrees" if agrees else "undecided", "worst": float(np.abs(interval.difference).max()),
            "text": "" if agrees else f"noise hides differences below {100 * interval.half.max():.2g} %"}
