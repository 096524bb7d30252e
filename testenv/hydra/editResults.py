#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Adds a run of hydraEdits under a sanitizer to the table of which docs/trust.md is made. sanitize.sh calls it.

Usage: editResults.py SANITIZER BACKEND SEED EDITS SECONDS STATUS LOG [TABLE]"""
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "fuzz"))
import results  # noqa: E402

INPUTS = 2  # the delegate, and scene indices
_REPORT = re.compile(r"^SUMMARY: \w+Sanitizer: (.*)$|^\S+: runtime error: (.*)$", re.MULTILINE)
_FAILURE = re.compile(r"^(edited and fresh host differ after|\S+: Failure)", re.MULTILINE)


def row(sanitizer, backend, seed, edits, seconds, status, log):
    """:param log: what the program has said
    :returns: a row of the table"""
    reports = [re.sub(r"0x[0-9a-f]+|/\S*/", "", "".join(words)) for words in _REPORT.findall(log)]
    findings = [("report", reason) for reason in dict.fromkeys(reports)]
    counts = {"report": len(reports)} if reports else {}
    if status and not reports:
        kind = "promise" if status == 1 and _FAILURE.search(log) else "crash"
        counts, findings = {kind: 1}, [(kind, f"seed {seed} ends with {status}")]
    inputs = INPUTS * edits if not status or status == 1 else len(reports) + 1  # how far it came is not known
    counts["fine"] = max(inputs - sum(counts.values()), 0)
    drawn = "" if backend == "embree" else backend.capitalize()
    return results.row("hydraEdits" + drawn + sanitizer.capitalize(), seed,
                       {"inputs": inputs, "seconds": seconds, "counts": counts, "findings": findings})


def main():
    sanitizer, backend, seed, edits, seconds, status, log = sys.argv[1:8]
    with open(log, encoding="utf-8", errors="replace") as file:
        added = row(sanitizer, backend, int(seed), int(edits), float(seconds), int(status), file.read())
    results.append([added], sys.argv[8] if len(sys.argv) > 8 else results.FILE)


if __name__ == "__main__":
    main()
