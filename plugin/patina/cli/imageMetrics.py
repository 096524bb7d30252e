# SPDX-License-Identifier: Apache-2.0
"""Numbers that say how two images differ. Arrays are (height, width, channels) of floats."""
import importlib.util

import numpy as np

REL_MSE_EPSILON = 0.01  # keeps black pixels of the reference from deciding everything


def finite_pixels(a, b):
    """:returns: mask (height, width) of the pixels that are numbers in both images"""
    return np.isfinite(a).all(axis=-1) & np.isfinite(b).all(axis=-1)


def count_not_finite(image):
    """:returns: dict of how many values are NaN and how many are infinite"""
    return {"nan": int(np.isnan(image).sum()), "inf": int(np.isinf(image).sum())}


def differences(a, b):
    """RMSE, relMSE, signed mean error and largest difference of a from the reference b, over the
    pixels that are numbers in both; None for all where there is no such pixel.

    relMSE is mean((a - b)^2 / (b^2 + 0.01)) over pixels and channels (Rousselle, Knaus and Zwicker
    2011, with their epsilon).
    """
    mask = finite_pixels(a, b)
    if not mask.any():
        return dict.fromkeys(("rmse", "relMSE", "meanError", "relativeMeanError", "maxDifference", "maxAt"))
    x, y = a[mask].astype(np.float64), b[mask].astype(np.float64)
    d = x - y
    largest = np.where(mask, np.abs(np.where(mask[..., None], a - b, 0.0)).max(axis=-1), -1.0)
    row, column = np.unravel_index(int(np.argmax(largest)), largest.shape)
    mean = float(y.mean())
    return {
        "rmse": float(np.sqrt(np.mean(d * d))),
        "relMSE": float(np.mean(d * d / (y * y + REL_MSE_EPSILON))),
        "meanError": float(d.mean()),
        "relativeMeanError": float(d.mean() / mean) if mean else None,
        "maxDifference": float(np.abs(d).max()),
        "maxAt": [int(column), int(row)],
    }


# flip-evaluator ends the process beside a reference below about 1e-7. Its exposures follow the reference's luminance, so images
# that are scaled by a power of two differ as much as before.
DIM = 1e-3


def flip_missing():
    """:returns: why FLIP cannot be measured on this machine; empty where it can"""
    if importlib.util.find_spec("flip_evaluator"):
        return ""
    return "FLIP is not measured: PyPI's flip-evaluator is not installed (./patina installs it where it may)"


def mean_flip(a, b, high_dynamic_range):
    """Mean of the FLIP error map, by NVIDIA's own implementation (Andersson et al. 2020, 2021).

    :param high_dynamic_range: linear radiance rather than display values in [0, 1]
    :returns: the mean, 0..1; None where flip-evaluator is not installed, where no pixel is a number in both, and beside a
        linear reference that is black
    """
    if flip_missing():
        return None
    mask = finite_pixels(a, b)[..., None]
    if not mask.any():  # black images would stand for both, and these are equal
        return None
    test, reference = (np.ascontiguousarray(np.where(mask, image, 0.0), dtype=np.float32) for image in (a, b))
    if high_dynamic_range:
        test, reference = np.maximum(test, 0.0), np.maximum(reference, 0.0)
    else:
        test, reference = np.clip(test, 0.0, 1.0), np.clip(reference, 0.0, 1.0)
    if high_dynamic_range and not (reference > 0.0).any():  # its exposures come from the reference's luminance
        return 0.0 if np.array_equal(test, reference) else None
    if high_dynamic_range and reference.max() < DIM:
        scale = 2.0 ** (-1 - np.floor(np.log2(float(reference.max()))))
        largest = np.finfo(np.float32).max
        test, reference = (np.minimum(image.astype(np.float64) * scale, largest).astype(np.float32)
                           for image in (test, reference))
    import flip_evaluator

    _, mean, _ = flip_evaluator.evaluate(reference, test, "HDR" if high_dynamic_range else "LDR",
                                         applyMagma=False)
    return float(mean)
