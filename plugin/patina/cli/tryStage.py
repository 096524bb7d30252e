# SPDX-License-Identifier: Apache-2.0
"""Reads a stage in a process that may die, before this one does: OpenUSD may crash on damaged files."""
import os
import signal
import subprocess
import sys

from patina import limits

_SECONDS = 60  # and one more for each MiB
_MEMORY = 0.5  # of the machine's: what takes more to compose leaves no room for a render of it
_TOO_MUCH = "the file is damaged, or asks for too much"
_ENDED = 3  # status of a process that ran out of it
# Opens layers, composes, and reads every value, as a render does.
_READ = """
import sys
sys.path[:] = [folder for folder in sys.path if folder]  # not the current one: its resource.py is not meant
import ctypes, os, resource, signal
signal.alarm(int(sys.argv[4]))  # its parent may be gone, or held
if sys.platform.startswith("linux"):
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: where its parent ends
from pxr import Usd
resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
resource.setrlimit(resource.RLIMIT_DATA, (int(sys.argv[2]), int(sys.argv[2])))
try:
    stage = Usd.Stage.Open(sys.argv[1])
    for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()):
        for attribute in prim.GetAttributes():
            attribute.Get()
            attribute.GetTimeSamples()
except MemoryError:
    os._exit(int(sys.argv[3]))
"""


def why_trial_fails(path):
    """:returns: why a stage is not to be opened, as in "makes OpenUSD fail (Segmentation fault): the file is damaged"; "" when
    it may be, also where OpenUSD itself says what is wrong with it, or the file is no larger than the limit untriedBytes"""
    size = os.path.getsize(path)
    if size <= limits.value("untriedBytes"):
        return ""
    seconds = _SECONDS + (size >> 20)
    memory = int(_MEMORY * os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    try:
        done = subprocess.run([sys.executable, "-c", _READ, path, str(memory), str(_ENDED), str(seconds + 1)],
                              stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=seconds,
                              check=False)
    except subprocess.TimeoutExpired:
        return f"is not read by OpenUSD within {seconds} s: {_TOO_MUCH}"
    if done.returncode == _ENDED or (done.returncode < 0 and b"bad_alloc" in done.stderr):  # on a thread of OpenUSD
        return f"takes more than {memory / 1e9:.1f} GB of memory: {_TOO_MUCH}"
    if done.returncode >= 0:
        return ""
    return f"makes OpenUSD fail ({signal.strsignal(-done.returncode)}): the file is damaged"
