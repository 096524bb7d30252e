# SPDX-License-Identifier: Apache-2.0
"""Fuzzers that make an input from a seed, and run it in a process that may die (hand.py)."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

import damaged
import outcomes
import shrink

SHRINK_SECONDS = 60
COUNTED = re.compile(r"^counted: (.+)$", re.MULTILINE)  # what an input has more of than itself, such as kills


class Hand:
    """hand.py as a process, started again where it ends."""

    def __init__(self):
        self.process = None

    def ask(self, module, file, folder, action="execute"):
        """:returns: its answer, see hand.py"""
        if self.process is None or self.process.poll() is not None:
            self.process = subprocess.Popen([sys.executable, os.path.join(os.path.dirname(os.path.abspath(__file__)),
                                                                          "hand.py")],
                                            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.process.stdin.write(json.dumps({"module": module, "file": file, "folder": folder, "action": action}) + "\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError("the process that runs inputs has ended itself")
        return json.loads(line)

    def end(self):
        if self.process:
            self.process.stdin.close()
            self.process.wait()
            self.process.stdout.close()


def outcome(hand, module, data, extension, seed=0):
    """Runs one input in a new folder.

    :returns: (one of outcomes' kinds, a signature, the answer)"""
    folder = tempfile.mkdtemp(prefix="patinaFuzz")
    try:
        damaged.fill(folder, seed)
        file = os.path.join(folder, "input" + extension)
        with open(file, "wb") as stream:
            stream.write(data)
        answer = hand.ask(module.__name__, file, folder)
        kind = outcomes.kind_of(answer)
        if kind in ("crash", "hang", "memory") and hasattr(module, "without"):
            alone = hand.ask(module.__name__, file, folder, "without")
            if alone["signal"] or alone["timedOut"]:
                kind = "library"
        owned = os.path.join(folder, "owned")
        if os.path.exists(owned):
            kind, answer["error"] = "promise", "promise broken: a text of the input ran as a command"
        return kind, outcomes.signature(kind, answer), answer
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def run(module, seconds, seed, say, inputs=None):
    """Runs a fuzzer for a time, or a number of inputs.

    :param say: called with a line for each finding
    :param inputs: their number; None: as many as the time allows
    :returns: dict of inputs, seconds, counts by kind, what an input holds several of (sums by name), and findings: (kind,
        signature, data, error)"""
    hand, start, counts, findings, last = Hand(), time.monotonic(), {}, {}, seed
    sums = {}
    try:
        while time.monotonic() - start < seconds and (inputs is None or last - seed < inputs):
            data = module.make(last)
            kind, signature, answer = outcome(hand, module, data, module.EXTENSION, last)
            counts[kind] = counts.get(kind, 0) + 1
            for name in COUNTED.findall(answer["error"]):
                sums[name] = sums.get(name, 0) + 1
            if kind not in outcomes.GOOD and signature not in findings:
                say(f"seed {last}: {signature}")
                smaller = shrink.lines(data,
                                       lambda d, s=signature, n=last: outcome(hand, module, d, module.EXTENSION, n)[1] == s,
                                       SHRINK_SECONDS) if module.LINES else data
                findings[signature] = (kind, signature, smaller, answer["error"])
            last += 1
        taken = time.monotonic() - start
    finally:
        hand.end()
    return {"inputs": last - seed, "seconds": taken, "counts": counts, "sums": sums, "findings": list(findings.values()),
            "lines": None}
