# SPDX-License-Identifier: Apache-2.0
"""Frames of a sequence, averaged: light that changes from frame to frame must not be."""
import numpy as np

from patina.chart.sweeps import Sweep
from patina.cli.compiled import _patina

SIZE = 48
NOISE = 0.7  # standard deviation of a pixel over its level
REACH = 3.5 * np.sqrt(2.0) * NOISE / 15.0  # difference of the means of 15 x 15 pixels beyond which nothing is taken


def _frame(level, seed):
    """A wall that stands still, as path traced pixels of few samples see it: gamma variates of shape 2."""
    noise = level * np.random.default_rng(seed).gamma(2.0, 0.5, (SIZE, SIZE)).astype(np.float32)
    wall = np.ones((SIZE, SIZE), np.float32)
    still = np.zeros((SIZE, SIZE, 2), np.float32)
    return {"color": np.repeat(noise[..., None], 3, axis=2), "alpha": wall, "denoisingAlbedo": np.full((SIZE, SIZE, 3), 0.5),
            "denoisingNormal": np.repeat(wall[..., None], 3, axis=2), "depth": wall, "motionForward": still,
            "motionBackward": still}


def sweeps(count):
    x = [0.0, *np.logspace(-2, 0.5, count - 1)]
    tested, plain = [], []
    for change in x:
        frames = [_frame(1.0 if seed == 2 else 1.0 + change, seed) for seed in range(5)]
        tested.append(float(_patina.accumulate(frames, 2)[0].mean()))
        plain.append(float(np.mean([frame["color"].mean() for frame in frames])))
    # Four of five frames have at most that difference; and three standard errors of the picture's mean.
    bound = 0.8 * REACH + 3.0 * NOISE / SIZE
    return [Sweep("light that changes for a frame", "sequences",
                  "A mean of frames takes light from frames in which it is another.", "change of the light around", x,
                  "mean of the picture", {"tested mean": tested, "mean of all frames": plain}, truth=1.0, chosen="tested mean",
                  bound=bound, failing="mean of all frames", log_x=True, shows=5)]
