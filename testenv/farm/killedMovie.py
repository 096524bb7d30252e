# SPDX-License-Identifier: Apache-2.0
"""A movie on local workers of Dask, one of which is killed every few seconds: is it whole, with the bits of one process?

    ./patina python testenv/farm/killedMovie.py FOLDER [--frames 1:24] [--cut 2x2] [--workers 4] [--every 3]
"""
import argparse
import glob
import os
import random
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import checkout  # noqa: E402

checkout.enter()

import movie  # noqa: E402


def worker_processes(process):
    """:returns: Dask's worker processes below the farm's"""
    import psutil

    found = []
    for child in psutil.Process(process.pid).children():
        try:
            if "spawn_main" in " ".join(child.cmdline()):
                found.append(child)
        except psutil.Error:
            continue
    return found


def run(folder, frames, cut, workers, every, flags, seed=1):
    """:returns: (exit status, how many workers were killed, images that differ, names of images)"""
    import psutil

    stage = movie.write_stage(folder)
    begin = time.monotonic()
    names = movie.at_once(stage, os.path.join(folder, "once"), frames, flags)
    # A part that takes as long as its worker lives would never be done.
    every = max(every, (time.monotonic() - begin) / len(names))
    farmed = os.path.join(folder, "farm")
    os.makedirs(farmed, exist_ok=True)
    chance, killed = random.Random(seed), 0
    process = subprocess.Popen(movie.command("farm", stage, os.path.join(farmed, "movie.####.exr"), f"--frames={frames}",
                                             f"--cut={cut}", f"--engine=local:{workers}", *flags))
    last, seen, known = time.monotonic(), set(), 0  # parts and images that were seen, and how many at the last kill
    while process.poll() is None:
        time.sleep(0.05)
        seen.update(glob.glob(os.path.join(farmed, "**", "*.exr"), recursive=True))
        # On a busy machine workers may start more slowly than they are killed: something is done between two kills.
        alive = worker_processes(process) if len(seen) > known and time.monotonic() - last >= every else []
        if alive:
            victim = chance.choice(alive)
            try:
                victim.kill()
                killed += 1
                print(f"killed worker process {victim.pid}", flush=True)
            except psutil.Error:
                pass
            last, known = time.monotonic(), len(seen)
    return process.returncode, killed, movie.different(names, os.path.join(folder, "once"), farmed), names


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--frames", default="1:24")
    parser.add_argument("--cut", default="2x2")
    parser.add_argument("--workers", type=int, default=4)
    parser.add_argument("--every", type=float, default=3.0,
                        help="least seconds between two kills, or what a frame takes at once where that is longer")
    arguments, flags = parser.parse_known_args()
    os.makedirs(arguments.folder, exist_ok=True)
    status, killed, wrong, names = run(os.path.abspath(arguments.folder), arguments.frames, arguments.cut, arguments.workers,
                                       arguments.every, flags or ["--imageWidth=240", "--samples=64"])
    print(f"status {status}, {killed} workers killed, {len(names) - len(wrong)} of {len(names)} images have equal bits")
    return 1 if status or wrong or not killed else 0


if __name__ == "__main__":
    sys.exit(main())
