# SPDX-License-Identifier: Apache-2.0
"""Memory of a session: python sessionMemory.py STAGE WIDTHxHEIGHT BACKEND [BACKEND ...]. Renders one scene by one back end
after the other, one sample per pixel, and keeps them all. Prints a line of JSON after each: megabytes on the heap, resident,
and the most that were resident. Needs glibc."""
import ctypes
import json
import resource
import sys

import _patina
import rasterTimes
from patina import experiment

MEGABYTE = 2.0 ** 20


class Heap(ctypes.Structure):
    """The fields of glibc's mallinfo2()."""
    _fields_ = [(name, ctypes.c_size_t) for name in ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks",
                                                     "uordblks", "fordblks", "keepcost")]


def report(what):
    libc = ctypes.CDLL("libc.so.6")
    libc.mallinfo2.restype = Heap
    libc.malloc_trim(0)
    heap = libc.mallinfo2()
    with open("/proc/self/statm", encoding="ascii") as file:
        resident = int(file.read().split()[1]) * resource.getpagesize()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(json.dumps({"after": what, "heap": round((heap.uordblks + heap.hblkhd) / MEGABYTE),
                      "resident": round(resident / MEGABYTE), "peak": round(peak)}), flush=True)


def main(stage, size, *backends):
    frames = rasterTimes.Frames(stage, tuple(int(n) for n in size.split("x")), backends[0])
    report("scene")
    kept = []
    for backend in backends:
        renderer, film = _patina.make_renderer(backend), _patina.Film()
        kept.append((renderer, film))
        experiment.draw(renderer, frames.scene, frames.info.camera, frames.settings, film)
        report(backend)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
