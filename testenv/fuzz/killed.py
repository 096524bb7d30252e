# SPDX-License-Identifier: Apache-2.0
"""Renders that kill -9 ends at random moments: whoever resumes them gets the bits of a render that nobody has killed, and until
then the old image stays. Both back ends, whole frames and parts, AOVs, Cryptomatte and denoised colour."""
import hashlib
import importlib.util
import json
import os
import random as randoms
import signal
import sys
import time

import outcomes
from usda import camera, prim, stage

EXTENSION = ".json"
LINES = False
CPU_SECONDS = 100  # a driver in software compiles for half a minute before it draws
STAGE = stage(camera(at=(0, 0, 6)), prim("Sphere", "ball"), prim("Cube", "box", at=(1, 0, -1)), prim("DomeLight", "dome"),
              up="")
FEATURES = {"cryptomatte": ("--aov", "cryptoObject", "--cryptomatteLevels", "4"),
            "aovs": ("--aov", "depth", "--aov", "normal"), "denoise": ("--denoise",), "tolerance": ("--tolerance", "0.05")}
PATIENCE = 30.0  # seconds after which a render counts as hanging, when one that nobody kills has taken a tenth


def make(seed):
    """:returns: the bytes of an input: how to render, and after which shares of the time that this takes to kill it"""
    r = randoms.Random(seed)
    backend = r.choice(("embree", "embree", "embree", "raster"))
    return json.dumps({"backend": backend,
                       "features": sorted(r.sample(sorted(FEATURES), r.choice((0, 1, 1, 2)))),
                       "parts": r.choice((1, 1, 2, 3)) if backend == "embree" else 1,
                       "kills": [round(r.uniform(0.0, 1.1), 3) for _ in range(r.randint(1, 4))], "seed": r.randint(0, 9),
                       "samples": r.choice((8, 32, 64)), "every": r.choice((0.001, 0.02, 0.2))}, indent=1).encode() + b"\n"


def _render(words, folder, seconds=None):
    """:param seconds: after which it is killed
    :returns: the exit status, or None where it was killed"""
    process = os.fork()
    if not process:
        outcomes.end_with_parent()
        outcomes.leave(outcomes.command(words, folder))
    if seconds is None:
        return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        ended, state = os.waitpid(process, os.WNOHANG)
        if ended:
            return os.waitstatus_to_exitcode(state)
        time.sleep(0.0005)
    os.kill(process, signal.SIGKILL)
    state = os.waitpid(process, 0)[1]
    if os.WIFSIGNALED(state):
        print("counted: kills", file=sys.stderr)
    return None if os.WIFSIGNALED(state) else os.waitstatus_to_exitcode(state)


def _pixels(path):
    """:returns: a digest of an image's channels and values. In this process alone, at the end: what OpenEXR starts
        is missing in processes that are forked later"""
    import numpy as np

    import _patina

    image = _patina.read_image(path)
    return hashlib.sha256(repr(image.channels).encode() + np.array(image.pixels).tobytes()).hexdigest()


def execute(path, folder):
    """Renders, kills and resumes, in a process that may die. :returns: the exit status"""
    with open(path, encoding="utf-8") as file:
        asked = json.load(file)
    features = [name for name in asked["features"] if name != "denoise" or importlib.util.find_spec("pyoidn")]
    with open(os.path.join(folder, "shot.usda"), "w", encoding="utf-8") as file:
        file.write(STAGE)
    flags = ["--camera", "/camera", "-w", "64", "--imageHeight", "48", "--samples", str(asked["samples"]), "--threads", "2",
             "--seed", str(asked["seed"]), "--backend", asked["backend"], "--quiet",
             *(word for name in features for word in FEATURES[name])]
    start = time.monotonic()
    status = _render(["record", "shot.usda", "plain.exr", *flags], folder)
    taken = time.monotonic() - start
    if status < 0:  # it met the bound of the processor's time, say
        os.kill(os.getpid(), -status)
    if status:
        return status  # what is refused in any case, with its message
    flags += ["--checkpointSeconds", str(asked["every"])]
    images = [f"part{k}.exr" for k in range(1, asked["parts"] + 1)] if asked["parts"] > 1 else ["shot.exr"]
    for k, image in enumerate(images, 1):
        words = ["record", "shot.usda", image, *flags, "--resume"]
        if asked["parts"] > 1:  # which are rendered whole, again
            words = ["record", "shot.usda", image, *flags, "--part", f"{k}/{asked['parts']}", "--partial", f"shot.{k}.part"]
        outcomes.put_old(folder, image)
        for share in asked["kills"]:
            status = _render(words, folder, share * taken)
            if status:
                return outcomes.broken(f"{image} cannot be resumed: it ends with {status}")
            if not os.path.exists(os.path.join(folder, image)):
                return outcomes.broken("the image that was there before is lost")
            if status == 0:
                break
        if _render(words, folder, max(PATIENCE, 10 * taken)) != 0:
            return outcomes.broken(f"{image} cannot be resumed, or never ends")
    if asked["parts"] > 1:
        status = _render(["merge", *(f"shot.{k}.part" for k in range(1, asked["parts"] + 1)), "shot.exr", "--quiet"], folder)
        if status:
            return outcomes.broken(f"parts that were resumed cannot be merged: it ends with {status}")
    os.chdir(folder)
    if _pixels("shot.exr") != _pixels("plain.exr"):
        return outcomes.broken("a render that was killed and resumed has other bits")
    return 0
