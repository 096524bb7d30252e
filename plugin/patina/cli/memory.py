# SPDX-License-Identifier: Apache-2.0
"""How much memory this process has, in bytes."""
import resource
import sys


def resident():
    """:returns: memory that it has now, or None where the system does not tell"""
    try:
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * resource.getpagesize()
    except (OSError, ValueError, IndexError):
        return None


def peak():
    """:returns: the most that it has had"""
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most if sys.platform == "darwin" else most * 1024


def text(size):
    """:returns: a size in words; of None a dash"""
    if size is None:
        return "-"
    for unit, bytes_ in (("GB", 1 << 30), ("MB", 1 << 20)):
        if size >= bytes_:
            return f"{size / bytes_:.{2 if unit == 'GB' else 0}f} {unit}"
    return f"{size / 1024:.0f} kB"
