# SPDX-License-Identifier: Apache-2.0
"""Stages of seven frames in which something moves, and what `patina denoise --around` makes of them.

    ./patina python testenv/sequences.py [camera object ...] [--samples 4,16] [--around 0,1,2] [--size 160x90] [--runs 2]

For each stage: mean relMSE and FLIP of a frame, and flicker: the mean of (e' - e)^2 / (reference^2 + 0.01), where e and e' are
the errors of a pixel in a frame and in the next. Squares are products of the errors beside two references of other seeds, whose
noise so cancels; FLIP is beside their mean, denoised. `noisy` is what was denoised. `hard` is relMSE where vectors of motion do
not say what is seen (the mirror, the ball of glass, the block that a shadow crosses), where something moves, or in the three
frames about a flash.
"""
import argparse
import os
import sys
import tempfile

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import checkout

    checkout.enter()

import numpy as np  # noqa: E402

import usda  # noqa: E402
from usda import lobe, prim  # noqa: E402

FRAMES = 7
HERE = os.path.dirname(os.path.abspath(__file__))
CHECKER = os.path.join(HERE, "scenes", "textures", "checker.png")
LENS = (24, 20.955, 11.787)


def _even(start, step):
    """:returns: samples of a value that changes by `step` each frame"""
    return {frame: tuple(a + frame * b for a, b in zip(start, step)) for frame in (0, FRAMES + 1)}


def _room(*held, camera=(0, 1.5, 6), lamp=120.0, white=(0.75, 0.72, 0.68)):
    """A room with a lamp that shines at the ceiling, so that most light is indirect."""
    return usda.stage(
        usda.camera(name="camera", lens=LENS, clippingRange=(0.01, 100), at=camera),
        prim("RectLight", "lamp", intensity=lamp, width=0.8, height=0.8, at=(1.2, 1.9, 1), turn=(90, 0, 0)),
        usda.floor("floor", 4, bind="tiles", st=[(0, 0), (6, 0), (6, 6), (0, 6)]),
        usda.card("back", (4, 3), z=-4, bind="white"),
        usda.mesh("left", [(-3, -1, 4), (-3, -1, -4), (-3, 3, -4), (-3, 3, 4)], bind="red"),
        usda.mesh("right", [(3, -1, -4), (3, -1, 4), (3, 3, 4), (3, 3, -4)], bind="green"),
        usda.mesh("ceiling", [(-4, 3, -4), (4, 3, -4), (4, 3, 8), (-4, 3, 8)], bind="white"),
        prim("Cube", "block", size=1.2, at=(-1.2, 0.6, -1), turn=(0, 30, 0), bind="blue"),
        *held,
        usda.material("tiles", {
            "reader": ("UsdPrimvarReader_float2", {"string varname": "st"}),
            "image": ("UsdUVTexture", {"file": CHECKER, "float2 st": "<reader>", "token wrapS": "repeat",
                                       "token wrapT": "repeat"}),
            "surface": ("UsdPreviewSurface", {"color3f diffuseColor": "<image>", "roughness": 0.6})}),
        *(lobe(name, "oren_nayar_diffuse_bsdf", color=color) for name, color in (
            ("white", white), ("red", (0.6, 0.12, 0.1)), ("green", (0.15, 0.5, 0.15)), ("blue", (0.1, 0.15, 0.6)))),
        startTimeCode=1, endTimeCode=FRAMES)


def _ball(bind="blue"):
    return prim("Sphere", "ball", radius=0.5, at=BALL, bind=bind)


BALL = _even((-1.6, 0.5, 1), (0.35, 0, 0))
PAN = _even((-0.6, 1.5, 6.3), (0.12, 0, -0.06))
MIRROR = lobe("mirror", "conductor_bsdf", roughness=(0.0, 0.0))
GLASS = lobe("glass", "dielectric_bsdf", roughness=(0.0, 0.0), scatter_mode="RT")
GLOSS = lobe("gloss", "conductor_bsdf", roughness=(0.1, 0.1))


def _passed(scene, start):
    """A test scene with a camera that moves. :param start: its place"""
    over = prim("Camera", "camera", at=_even(start, (0.06, 0, -0.03)), specifier="over")
    return usda.stage(prim("Xform", "World", over, specifier="over"), startTimeCode=1, endTimeCode=FRAMES,
                      subLayers=f"[@{os.path.join(HERE, 'scenes', scene + '.usda')}@]")


def stages():
    """:returns: dict of name -> text of a stage"""
    mirror = usda.card("pane", (1.2, 1.0), z=-3.9, at=(0.8, 1.3, 0), bind="mirror")
    return {
        "still": _room(),
        "camera": _room(camera=PAN),
        "object": _room(_ball()),
        # Light through the open side of the room, and a slat behind the camera.
        "shadow": _room(prim("DistantLight", "sun", intensity=8, angle=0.5, normalize=True, turn=(-15, 0, 0)),
                        usda.card("slat", (0.4, 1.2), at=_even((-1.5, 1.9, 7), (0.3, 0, 0)), bind="white")),
        "lamp": _room(lamp={1: 120, 3: 120, 3.01: 360, 4: 360, 4.01: 120, 7: 120}),
        "mirror": _room(mirror, _ball(), MIRROR, camera=PAN),
        "gloss": _room(usda.card("pane", (1.2, 1.0), z=-3.9, at=(0.8, 1.3, 0), bind="gloss"), _ball(), GLOSS, camera=PAN),
        "glass": _room(_ball("glass"), GLASS, camera=PAN),
        "blur": _room(_ball()).replace("(0.01, 100)", """(0.01, 100)
    double shutter:open = -0.25
    double shutter:close = 0.25"""),
        "hair": _passed("hair", (-0.24, 1.15, 5.7)),
    }


def _along(samples, frame):
    """:returns: what an `_even` value is in a frame, or a constant"""
    if not isinstance(samples, dict):
        return np.array(samples, float)
    first, last = (np.array(samples[time], float) for time in (0, FRAMES + 1))
    return first + (last - first) * frame / (FRAMES + 1)


# Where a stage is hard: the camera's place, the middle of a card that faces it, and half its width and height.
PANE = (0.8, 1.3, -3.9)
HARD = {"shadow": ((0, 1.5, 6), (-1.2, 0.6, -0.4), 0.85, 0.6), "object": ((0, 1.5, 6), BALL, 0.8, 0.6),
        "mirror": (PAN, PANE, 1.2, 1.0), "gloss": (PAN, PANE, 1.2, 1.0), "glass": (PAN, BALL, 0.6, 0.6),
        "blur": ((0, 1.5, 6), BALL, 0.8, 0.6)}


def hard(name, shape):
    """:returns: mask (frames, height, width) of a stage's hard pixels: those of a card, or of the frames around a flash"""
    frames, height, width = shape[:3]
    mask = np.zeros((frames, height, width), bool)
    for i in range(frames):
        if name == "lamp":
            mask[i] = i + 1 in (3, 4, 5)
        elif name in HARD:
            camera, middle, *half = HARD[name]
            x, y, z = _along(middle, i + 1) - _along(camera, i + 1)
            scale = LENS[0] / LENS[1] * width / -z  # pixels of a unit there
            left, top = width / 2 + (x - half[0]) * scale, height / 2 - (y + half[1]) * scale
            box = [max(0, int(v)) for v in (top, top + 2 * half[1] * scale, left, left + 2 * half[0] * scale)]
            mask[i, box[0]:box[1], box[2]:box[3]] = True
    return mask


def squares(pixels, truths):
    """:param pixels: frames x height x width x 3
    :param truths: two independent references of them
    :returns: relative squared errors of all values, and of how the errors change from frame to frame: without bias"""
    from patina.cli import imageMetrics

    weight = 1.0 / (truths.mean(axis=0) ** 2 + imageMetrics.REL_MSE_EPSILON)
    a, b = (pixels - truth for truth in truths)
    return a * b * weight, np.diff(a, axis=0) * np.diff(b, axis=0) * weight[1:]


def errors(pixels, truths, clean, mask):
    """:param clean: the reference of FLIP
    :param mask: hard pixels
    :returns: dict of the means over the frames"""
    from patina.cli import imageMetrics

    error, flicker = squares(pixels, truths)
    flips = [imageMetrics.mean_flip(a.astype(np.float32), b.astype(np.float32), True) for a, b in zip(pixels, clean)]
    return {"relMSE": error.mean(), "flip": np.nan if None in flips else np.mean(flips), "flicker": flicker.mean(),
            "hard": error[mask].mean() if mask.any() else np.nan}


def recorded(stage, folder, name, *arguments):
    """:returns: the pattern of a stage's frames, which are recorded"""
    import inProcess

    pattern = os.path.join(folder, name + ".###.exr")
    inProcess.record(stage, pattern, "--frames", f"1:{FRAMES}", *arguments)
    return pattern


def pictures(pattern, channels="RGB"):
    import inProcess

    return np.array([inProcess.pixels(pattern.replace("###", f"{frame:03d}"), channels) for frame in range(1, FRAMES + 1)],
                    np.float64)


def denoised(pattern, around, *arguments):
    """:returns: the pattern of the frames that `patina denoise` makes of others"""
    import inProcess

    made = pattern.replace(".###", f".{around}.###")
    inProcess.patina("denoise", pattern, made, "--frames", f"1:{FRAMES}", "--around", around, "--quiet", *arguments)
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    texts = stages()
    parser.add_argument("names", nargs="*", default=list(texts))
    parser.add_argument("--samples", default="4,16")
    parser.add_argument("--around", default="0,1,2")
    parser.add_argument("--size", default="160x90")
    parser.add_argument("--reference", type=int, default=128, help="samples of each of two references")
    parser.add_argument("--runs", type=int, default=1, help="seeds, whose numbers are averaged")
    parser.add_argument("--keep", metavar="FOLDER", help="keep the frames there")
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = a.keep or temporary
        os.makedirs(folder, exist_ok=True)
        print("| stage | samples | denoised | relMSE | FLIP | flicker | hard |\n|---|---|---|---|---|---|---|")
        for name in a.names:
            _measure(name, texts[name], folder, a)


def _measure(name, text, folder, a):
    stage = os.path.join(folder, name + ".usda")
    with open(stage, "w", encoding="utf-8") as file:
        file.write(text)
    width, height = a.size.split("x")
    more = ["-w", width, "--imageHeight", height, "--camera", "camera"] + ([] if name == "blur" else ["--disableMotionBlur"])
    truth = [os.path.join(folder, f"{name}.reference{seed}.###.exr") for seed in (77, 78)]
    for seed, pattern in zip((77, 78), truth):
        if not os.path.exists(pattern.replace("###", f"{FRAMES:03d}")):
            recorded(stage, folder, f"{name}.reference{seed}", "--samples", a.reference, "--seed", seed, "--denoise", *more)
    truths = np.array([pictures(pattern, ["color.noisy." + c for c in "RGB"]) for pattern in truth])
    clean = np.mean([pictures(pattern) for pattern in truth], axis=0)
    mask = hard(name, truths.shape[1:])
    for samples in a.samples.split(","):
        found = {}
        for run in range(a.runs):
            noisy = recorded(stage, folder, f"{name}.{samples}.{run}", "--samples", samples, "--denoiseLater", "--seed",
                             run * 100000, *more)
            found.setdefault("noisy", []).append(errors(pictures(noisy), truths, clean, mask))
            for around in a.around.split(","):
                found.setdefault(f"around {around}", []).append(errors(pictures(denoised(noisy, around)), truths, clean, mask))
        for way, numbers in found.items():
            mean = {key: np.mean([n[key] for n in numbers]) for key in numbers[0]}
            print(f"| {name} | {samples} | {way} | " + " | ".join(f"{mean[key]:.3g}" for key in mean) + " |", flush=True)


if __name__ == "__main__":
    main()
