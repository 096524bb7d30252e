# SPDX-License-Identifier: Apache-2.0
"""Runs libFuzzer's programs, which follow coverage, until they reach nothing new."""
import os
import re
import signal
import subprocess
import threading
import time

_COVERED = re.compile(r"\bcov: (\d+)")
_UNITS = re.compile(r"stat::number_of_executed_units: (\d+)|^Done (\d+) runs|^#(\d+)\t", re.MULTILINE)  # of the last line
IN_MEMORY = "/dev/shm" if os.path.isdir("/dev/shm") else None  # for files of inputs, and what a program leaves when it dies
ENDING_SECONDS = 30  # of a program that was asked to end
TOLD = 1 << 20  # characters that are kept of what a program says, of its end


def _processor_seconds(pid):
    """:returns: seconds of processors that a process has had, of all its threads; 0 where it is gone"""
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as file:
            fields = file.read().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Plateau:
    """For how long no new edge was reached, over runs that go on from each other. Seconds are those of processors: a program
    that waits for one tries nothing."""

    def __init__(self):
        self.edges, self.used, self.since = 0, 0.0, 0.0

    def hear(self, line):
        found = _COVERED.search(line)
        if found and int(found.group(1)) > self.edges:
            self.edges, self.since = int(found.group(1)), self.used

    def seconds(self):
        return self.used - self.since


def run(command, plateau, most, **options):
    """:param plateau: Plateau, which hears each line
    :param most: seconds of processors without a new edge after which the program is asked to end
    :param options: of subprocess.Popen
    :returns: (exit status, 0 where it was asked to end; what it said; inputs that it ran)"""
    told, size = [], 0
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                          **options) as process:
        asked = threading.Event()

        def watch():
            before = plateau.used
            while process.poll() is None and not asked.is_set():
                plateau.used = max(plateau.used, before + _processor_seconds(process.pid))
                if plateau.seconds() >= most:
                    asked.set()
                    process.send_signal(signal.SIGINT)
                time.sleep(0.2)
            try:
                process.wait(ENDING_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
        watcher = threading.Thread(target=watch)
        watcher.start()
        for line in process.stdout:
            plateau.hear(line)
            told.append(line)
            size += len(line)
            while size > TOLD and len(told) > 1:
                size -= len(told.pop(0))
        watcher.join()
    text = "".join(told)
    counts = [int("".join(found)) for found in _UNITS.findall(text)]
    return 0 if asked.is_set() else process.returncode, text, counts[-1] if counts else 0
