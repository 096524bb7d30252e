# SPDX-License-Identifier: Apache-2.0
"""Runs libFuzzer's programs, which follow coverage, until they reach nothing new."""
import contextlib
import glob
import json
import os
import re
import signal
import subprocess
import tempfile
import threading
import time

import keptFindings
import seeds
from patina.farm import digests

_COVERED = re.compile(r"\bcov: (\d+)")
_UNITS = re.compile(r"stat::number_of_executed_units: (\d+)|^Done (\d+) runs|^#(\d+)\t", re.MULTILINE)  # of the last line
IN_MEMORY = "/dev/shm" if os.path.isdir("/dev/shm") else None  # for files of inputs, and what a program leaves when it dies
ENDING_SECONDS = 30  # of a program that was asked to end
LONGEST_INPUT = 4096  # bytes
NEW_EDGES = 1000  # one in so many may be new on a plateau; none where there are fewer
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
    """For how long all but a thousandth of the edges are known, over runs that go on from each other. A program of a million
    inputs an hour still meets a rare edge now and then. Seconds are those of processors: a program that waits for one tries
    nothing."""

    def __init__(self, program=None, place=None):
        """:param program: path of what runs, whose bytes must be those of before
        :param place: path of a file that keeps the plateau; None where there is none"""
        self.edges, self.used = 0, 0.0
        self._rises = [(0.0, 0)]  # when, how many from then on
        self._place, self._program = place, program and digests.content(program)
        with contextlib.suppress(OSError, ValueError, KeyError, TypeError):
            with open(place, encoding="utf-8") as file:
                kept = json.load(file)
            if kept["program"] == self._program:
                self.used, self._rises = float(kept["used"]), [(float(when), int(edges)) for when, edges in kept["rises"]]
                self.edges = self._rises[-1][1]

    def keep(self):
        """For the next run of the same program, which goes on with its inputs."""
        if self._place:
            with open(self._place, "w", encoding="utf-8") as file:
                json.dump({"program": self._program, "used": self.used, "rises": self._rises}, file)

    def hear(self, line):
        found = _COVERED.search(line)
        if found and int(found.group(1)) > self.edges:
            self.edges = int(found.group(1))
            self._rises.append((self.used, self.edges))

    def seconds(self):
        return self.used - next(when for when, edges in self._rises if edges >= self.edges - self.edges // NEW_EDGES)


def run(command, plateau, most, **options):
    """:param plateau: Plateau, which hears each line
    :param most: seconds of a plateau after which the program is asked to end
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


def search(name, command, corpus, seconds, plateau, seed, say, why, read, lines, options, program=None):
    """Runs a program for a time; after a finding it goes on, with another seed.

    :param command: the program and flags of its own
    :param corpus: folder of inputs; new ones that reach new code are added to that of the name
    :param plateau: seconds of a plateau after which it ends
    :param why: function of an input's file and of what was said -> (kind, reason)
    :param read: function of an input's file, its kind and a folder -> the bytes that are kept
    :param lines: function of the folder of inputs and another -> (lines that they reach, all)
    :param options: function of a folder -> those of subprocess.Popen
    :param program: path of the program, where it is compiled: the plateau of a corpus goes on as long as that is the same
    :returns: as generated.run(), with lines, edges, and how long the plateau at the end is
    :raises RuntimeError: where it ends by itself without a finding"""
    work = os.path.join(corpus, name)
    os.makedirs(work, exist_ok=True)
    seeds.write(name, work)
    edges = Plateau(program, program and f"{work}.plateau.json")
    start, inputs, findings, part, libraries = time.monotonic(), 0, {}, 0, 0
    with tempfile.TemporaryDirectory(dir=IN_MEMORY) as scratch:
        while (left := seconds - (time.monotonic() - start)) > 1 and edges.seconds() < plateau:
            prefix = os.path.join(scratch, f"found{part}-")
            status, said, tried = run(
                [*command, work, keptFindings.folder(name), f"-max_total_time={int(left)}", f"-seed={seed + part + 1}",
                 f"-max_len={LONGEST_INPUT}", "-print_final_stats=1", f"-artifact_prefix={prefix}"],
                edges, plateau, **options(scratch))
            edges.keep()
            inputs += tried
            part += 1
            found = [path for path in glob.glob(glob.escape(prefix) + "*") if "-slow-unit-" not in path]  # short of a hang
            if not found:
                if status:
                    raise RuntimeError(f"{name} ended with {status}: {said[-500:]}")
                break
            kind, reason = why(found[0], said)
            libraries += kind == "library"
            if kind == "library" or reason not in findings:
                say(f"{kind}: {reason}")
            if kind != "library" and reason not in findings:
                findings[reason] = (kind, reason, read(found[0], kind, scratch), said[-4000:])
        reached = lines(work, scratch)
    counts = {"fine": inputs - libraries, **({"library": libraries} if libraries else {})}
    for kind, *_ in findings.values():
        counts[kind] = counts.get(kind, 0) + 1
    return {"inputs": inputs, "seconds": time.monotonic() - start, "counts": counts, "findings": list(findings.values()),
            "lines": reached, "plateau": edges.seconds(), "edges": edges.edges}
