# SPDX-License-Identifier: Apache-2.0
"""A movie through Slurm: slurm.sh starts one on this machine, dask-jobqueue asks it for workers, and the bits are compared.

    ./patina python testenv/farm/slurmMovie.py FOLDER [--frames 1:6] [--cut 2] [--workers 2]
"""
import argparse
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import checkout  # noqa: E402

checkout.enter()

import movie  # noqa: E402

SLURM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "slurm.sh")
MISSING = 3  # exit status of slurm.sh where a program or a right is missing


def run(folder, frames, cut, workers, flags):
    """:returns: (the finished process, images that differ, names of images)"""
    stage = movie.write_stage(folder)
    farmed = os.path.join(folder, "farm")
    os.makedirs(farmed, exist_ok=True)
    farm = movie.command("farm", stage, os.path.join(farmed, "movie.####.exr"), f"--frames={frames}", f"--cut={cut}",
                         f"--engine=slurm:{workers}", "--engineOption=memory=400MiB", "--engineOption=walltime=00:20:00",
                         "--engineOption=interface=lo", "--engineOption=log_directory=" + os.path.join(folder, "jobs"),
                         "--engineOption=local_directory=" + os.path.join(folder, "scratch"), *flags)
    environment = dict(os.environ, SLURM_CORES=str(max(2, workers)))
    process = subprocess.run([SLURM, os.path.join(folder, "slurm"), *farm], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             text=True, env=environment, timeout=900)
    names = movie.at_once(stage, os.path.join(folder, "once"), frames, flags)
    return process, movie.different(names, os.path.join(folder, "once"), farmed), names


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--frames", default="1:6")
    parser.add_argument("--cut", default="2")
    parser.add_argument("--workers", type=int, default=2)
    arguments, flags = parser.parse_known_args()
    os.makedirs(arguments.folder, exist_ok=True)
    process, wrong, names = run(os.path.abspath(arguments.folder), arguments.frames, arguments.cut, arguments.workers,
                                flags or ["--imageWidth=160", "--samples=16"])
    print(process.stdout, end="")
    print(f"status {process.returncode}, {len(names) - len(wrong)} of {len(names)} images have equal bits")
    return 1 if process.returncode or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
