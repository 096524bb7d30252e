# SPDX-License-Identifier: Apache-2.0
"""The colour of a frame with that of the frames around it, on frames whose truth is known.

Noise is a gamma variate of shape 2, whose standard deviation is 0.7 of the level, as path traced pixels of some samples have.
Bounds of weights come from the t distribution: of what stands still, less than 0.2 of the neighbours' weight is lost, since
P(|t8| > 1.5) + P(|t48| > 2.5) + P(|t224| > 2.5) = 0.20, where weights begin to fall in windows of 9, 49 and 225 pixels."""
import numpy as np
import pytest

import _patina

HEIGHT, WIDTH, SHAPE = 48, 80, 2.0
LOST = 0.2
CURRENT = 2  # of frames -2 to 2


def frame(seed, time=0, light=1.0, pan=0.0, ball=None, shape=SHAPE):
    """:param light: radiance of the wall, a number or an array
    :param pan: pixels that the wall moves in a frame, to the right
    :param ball: left edge at time 0, width and way in a frame of a square before the wall
    :returns: arrays of a frame, and the truth"""
    y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)
    truth = (1.0 + 0.3 * np.sin((x - pan * time) / 12.0)) * light
    before = np.zeros((HEIGHT, WIDTH), bool)
    if ball:
        left, width, way = ball
        before = (x >= left + way * time) & (x < left + way * time + width) & (y > 12) & (y < 36)
        truth = np.where(before, 8.0, truth)
    motion = np.zeros((HEIGHT, WIDTH, 2))
    motion[..., 0] = np.where(before, ball[2] if ball else 0.0, pan)
    noise = np.random.default_rng([seed, time + 100]).gamma(shape, 1.0 / shape, truth.shape)
    arrays = {"color": np.repeat((truth * noise)[..., None], 3, axis=2), "alpha": np.ones_like(truth),
              "denoisingAlbedo": np.full((HEIGHT, WIDTH, 3), 0.5), "depth": np.where(before, 9.5, 10.0),
              "denoisingNormal": np.broadcast_to([0.0, 0.0, 1.0], (HEIGHT, WIDTH, 3)),
              "motionForward": motion, "motionBackward": -motion}
    return {name: np.ascontiguousarray(array, np.float32) for name, array in arrays.items()}, truth


def sequence(seed, light=None, **scene):
    """:param light: function of the time
    :returns: arrays of five frames, and the truth of the middle one"""
    made = [frame(seed, time, light(time) if light else 1.0, **scene) for time in range(-2, 3)]
    return [arrays for arrays, _ in made], made[CURRENT][1]


def squared(seed, where=np.s_[:, :], **scene):
    """:returns: mean squared error of the mean of the frames, of the frame alone, and mean number of frames"""
    frames, truth = sequence(seed, **scene)
    color, shares = _patina.accumulate(frames, CURRENT)
    return [float(((pixels[..., 0] - truth) ** 2)[where].mean()) for pixels in (color, frames[CURRENT]["color"])] + [
        float(shares[where].mean())]


def not_larger(pairs):
    """Asserts that the first of each pair is not larger in the mean: by a t test, one-sided, 1 %."""
    differences = np.array([a - b for a, b in pairs])
    error = differences.std(ddof=1) / np.sqrt(len(differences))
    t99 = {12: 2.718, 16: 2.602}[len(differences)]
    assert differences.mean() <= t99 * error, pairs


@pytest.mark.parametrize("pan", [0.0, 1.0, 1.3])
def test_the_error_falls_as_of_a_mean(pan):
    """Five frames leave a fifth of the variance; with a fifth of the weights lost, 1 / (1 + 4 * 0.8). Half a pixel beside its
    place the wall differs by at most 0.0125, whose square is nothing beside the variance of 0.5. Eight pictures of 1800 pixels
    know a variance to 4 % (the fourth moment of the noise is 6 times the square of the second): three of these."""
    inner = np.s_[8:-8, 8:-8]
    errors = np.array([squared(seed, inner, pan=pan) for seed in range(8)]).mean(axis=0)
    assert 0.2 * 0.88 < errors[0] / errors[1] < 1.12 / (1.0 + 4.0 * (1.0 - LOST)), errors
    assert errors[2] > 1.0 + 4.0 * (1.0 - LOST)


def test_samples_are_weights():
    """A frame of one sample between frames of four, whose variance is a quarter: as of 17 samples."""
    found = []
    for seed in range(8):
        frames = [frame(seed, time, shape=SHAPE * (1 if time == 0 else 4))[0] for time in range(-2, 3)]
        for time, arrays in zip(range(-2, 3), frames):
            arrays["sampleCount"] = np.full((HEIGHT, WIDTH), 1 if time == 0 else 4, np.float32)
        truth = frame(seed)[1]
        color, _ = _patina.accumulate(frames, CURRENT)
        found.append([((pixels[..., 0] - truth) ** 2).mean() for pixels in (color, frames[CURRENT]["color"])])
    ratio = np.divide(*np.mean(found, axis=0))
    assert 0.88 / 17.0 < ratio < 1.12 / (1.0 + 16.0 * (1.0 - LOST))


def test_what_an_object_uncovers_is_its_own():
    """To the bit: the frame before saw the object there, so the pixel's chain ends."""
    ball = (30, 12, 5.0)
    before, after = (frame(3, time, ball=ball)[0] for time in (-1, 0))
    color, shares = _patina.accumulate([before, after], 1)
    uncovered = np.s_[14:34, 25:30]
    np.testing.assert_array_equal(color[uncovered], after["color"][uncovered])
    assert (shares[uncovered] == 1.0).all()
    assert shares[14:34, 32:40].mean() > 1.5  # the object itself is followed


def test_a_moving_object_leaves_no_ghost():
    """Around its edges, over and beside it, in 12 pictures."""
    near = np.s_[13:35, 15:60]
    not_larger([squared(seed, near, ball=(30, 12, 5.0), pan=0.5)[:2] for seed in range(12)])


@pytest.mark.parametrize("factor", [0.25, 4.0])
def test_a_flash_is_its_own(factor):
    """To the bit: over 15 x 15 pixels the difference is 11 of its standard errors or more, and 3.5 end a chain."""
    frames, _ = sequence(1, light=lambda time: factor if time == 0 else 1.0)
    color, _ = _patina.accumulate(frames, CURRENT)
    np.testing.assert_array_equal(color, frames[CURRENT]["color"])


@pytest.mark.parametrize("change", [0.02, 0.05, 0.1, 0.2])
def test_a_change_that_noise_hides_stays_below_the_noise(change):
    """Where weight is left, the mean over 225 pixels differs by at most 3.5 standard errors of it: 3.5 * sqrt(0.5 + 0.5) / 15
    of the level, and four of five frames have that error at most."""
    frames, truth = sequence(1, light=lambda time: 1.0 + (change if time else 0.0))
    color, _ = _patina.accumulate(frames, CURRENT)
    bias = (color[..., 0] - truth).mean() / truth.mean()
    assert abs(bias) < 0.8 * min(change, 3.5 / 15.0) + 3 * np.sqrt(0.5 / truth.size)


@pytest.mark.parametrize("speed", [2.0, 4.0])
def test_a_moving_shadow_is_not_smeared(speed):
    """Where it was in the two frames before, in 16 pictures."""
    x = np.arange(WIDTH)
    swept = np.s_[8:-8, 40 - int(2 * speed):40 + int(2 * speed)]
    not_larger([squared(seed, swept, light=lambda time: np.where(x < 40 + speed * time, 0.3, 1.0), shape=20.0)[:2]
                for seed in range(16)])


def test_colour_follows_the_surface_not_its_texture():
    """A texture of fine stripes that moves by part of a pixel: without noise, each frame has its own stripes to the last."""
    frames = []
    for time in range(-2, 3):
        arrays, _ = frame(0, time, pan=1.5, shape=1e12)
        stripes = 0.5 + 0.1 * np.sin(2.0 * (np.arange(WIDTH) - 1.5 * time))
        arrays["denoisingAlbedo"][:] = stripes[None, :, None]
        arrays["color"][:] = stripes[None, :, None]
        frames.append(arrays)
    color, shares = _patina.accumulate(frames, CURRENT)
    # Albedos have 0.05 added before they are divided, so a tenth of the difference of stripes stays at most.
    np.testing.assert_allclose(color, frames[CURRENT]["color"], atol=0.1 * 0.2)
    assert shares.mean() > 2.0


@pytest.mark.parametrize("aov,value", [("depth", 1e10), ("denoisingNormal", 1.0), ("alpha", 0.5), ("motionForward", 3.0),
                                       ("denoisingAlbedo", 2.0), ("color", np.nan), ("depth", np.nan), ("sampleCount", 0.0)])
def test_another_surface_is_left_alone(aov, value):
    """In the frames around; of the frame itself what has no surface stays as it is."""
    frames, _ = sequence(1)
    for arrays in frames:
        arrays["sampleCount"] = np.ones((HEIGHT, WIDTH), np.float32)
    for arrays in frames[:CURRENT] + frames[CURRENT + 1:]:
        arrays[aov][:] = value
        if aov == "motionForward":
            arrays["motionBackward"][:] = value
    color, shares = _patina.accumulate(frames, CURRENT)
    np.testing.assert_array_equal(color, frames[CURRENT]["color"])
    assert (shares == 1.0).all()


def test_a_pixel_that_is_no_number_takes_the_frames_around():
    frames, truth = sequence(1)
    frames[CURRENT]["color"][20, 30] = np.nan
    frames[CURRENT]["color"][21, 40, 1] = np.inf
    color, shares = _patina.accumulate(frames, CURRENT)
    assert np.isfinite(color).all() and (color[[20, 21], [30, 40]] > 0.0).all()
    alone, _ = _patina.accumulate(frames[CURRENT:CURRENT + 1], 0)
    assert (alone[[20, 21], [30, 40]] == 0.0).all()
    assert 0.0 < shares[20, 30] <= 4.0


def test_threads_change_no_bit():
    frames, _ = sequence(1, ball=(30, 12, 5.0), pan=0.7)
    one, *others = [_patina.accumulate(frames, CURRENT, threads)[0] for threads in (1, 2, 3, 0)]
    for other in others:
        np.testing.assert_array_equal(other, one)


def test_motion_out_of_all_bounds():
    frames, _ = sequence(1)
    for value in (np.nan, np.inf, -1e30, 1e9):
        frames[CURRENT]["motionForward"][:10] = value
        color, shares = _patina.accumulate(frames, CURRENT)
        assert np.isfinite(color).all() and (shares <= 5.0).all()


def test_arrays_that_do_not_fit_are_refused():
    frames, _ = sequence(1)
    with pytest.raises(IndexError):
        _patina.accumulate(frames, 5)
    with pytest.raises(KeyError, match="no depth"):
        _patina.accumulate([{name: array for name, array in frames[0].items() if name != "depth"}], 0)
    with pytest.raises(ValueError, match="alpha has not the size"):
        _patina.accumulate([{**frames[0], "alpha": frames[0]["alpha"][:-1]}], 0)
