# SPDX-License-Identifier: Apache-2.0
"""Rays of one scene: python rayWorker.py FOLDER RECORDER SAMPLES RUNS, with the recorder preloaded. Prints a line of JSON: how
many rays of either kind the frame traces, and processor seconds of the frame and of its rays alone, run by run."""
import ctypes
import json
import os
import sys
import time

sys.path.append(os.path.dirname(os.path.abspath(__file__)))  # the launcher keeps folders of scripts out
import pathPatina  # noqa: E402


def main(folder, recorder, samples, runs):
    library = ctypes.CDLL(recorder)
    library.patinaRecorded.restype = library.patinaReplay.restype = ctypes.c_long
    draw = pathPatina.prepare(folder)
    draw(1, 999, os.devnull, False)
    library.patinaRecord(1)
    draw(samples, 1, os.devnull, False)
    library.patinaRecord(0)
    found = {"intersect": library.patinaRecorded(0), "occluded": library.patinaRecorded(1), "frame": [], "bare": []}
    for _ in range(runs):
        begin = time.process_time()
        draw(samples, 1, os.devnull, False)
        middle = time.process_time()
        found["hits"] = library.patinaReplay()
        found["frame"].append(middle - begin)
        found["bare"].append(time.process_time() - middle)
    print(json.dumps(found), flush=True)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
