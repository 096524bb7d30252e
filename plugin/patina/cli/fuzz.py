# SPDX-License-Identifier: Apache-2.0
"""Runs the fuzzers of a checkout for a time. They try bytes, and legal inputs with extreme values. Patina may refuse an input
with a message. It must not crash, hang, take memory without end, lose an image or make values that are no numbers.

  patina fuzz --seconds 600
  patina fuzz texture parts --seconds 14400 --plateau 3600
  patina fuzz randomStages edits --seconds 3600 --seed 1000 --json=figures.json
  patina fuzz --keep patinaFindings/ies-crash-heap-1234abcd hugeTable

The native ones are libFuzzer's programs under AddressSanitizer and UBSan; ./patina fuzz installs clang where it may and builds
them in a folder of their own. The others make a legal input from a seed and run it in a process that may die. Each finding is
made smaller and saved; --keep turns one into a test that runs it again.

Exit status: 0 nothing was found, 1 there are findings, 2 wrong usage.
"""
import functools
import os
import sys

from patina.cli import checkout, outputs
from patina.cli.errors import CommandError, UsageError


def add_arguments(parser):
    parser.add_argument("names", nargs="*", metavar="NAME", help="fuzzers (default: all); with --keep, the name of the test")
    parser.add_argument("--list", action="store_true", help="print the fuzzers and end")
    parser.add_argument("--seconds", type=float, default=60.0, metavar="S", help="time of all fuzzers together (default: 60)")
    parser.add_argument("--plateau", type=float, metavar="S",
                        help="a fuzzer that follows coverage ends after so many seconds of processors with at most a "
                             "thousandth of its edges new, and leaves its time to the others (default: a third of its share, "
                             "at most 3600)")
    parser.add_argument("--seed", type=int, default=1, metavar="N",
                        help="seed of the first input; the others count up (default: 1)")
    parser.add_argument("--corpus", metavar="FOLDER", help="inputs of the native fuzzers, kept small, that the next run goes "
                                                           "on from (default: none are kept)")
    parser.add_argument("--findings", metavar="FOLDER", default="patinaFindings",
                        help="where findings are saved (default: patinaFindings)")
    parser.add_argument("--build", metavar="FOLDER", help="the instrumented build (default: build-fuzz in the checkout)")
    parser.add_argument("--json", metavar="FILE", help="write the figures of the run as JSON: --json to standard output, "
                                                       "--json=FILE to a file")
    parser.add_argument("--results", nargs="?", const="", metavar="FILE",
                        help="add the figures to this table (default: testenv/fuzz/results.json, of which "
                             "docs/trust.md is made)")
    parser.add_argument("--keep", metavar="FINDING", help="make a saved finding a test called NAME")


def run(arguments):
    checkout.require("testenv/fuzz/fuzzRun.py", "fuzz", "the fuzzers are")
    if arguments.seed < 0 or not all(0.0 < s < 1e9 for s in (arguments.seconds, arguments.plateau or 1.0)):
        raise UsageError("patina fuzz: --seed is 0 or more, and --seconds and --plateau above 0")
    fuzzRun = checkout.module("testenv/fuzz", "fuzzRun")
    if arguments.list:
        print("\n".join(fuzzRun.listing()))
        return 0
    if arguments.keep:
        if len(arguments.names) != 1:
            raise UsageError("patina fuzz: --keep FINDING takes one NAME")
        try:
            print(checkout.module("testenv/fuzz", "keptFindings").keep(arguments.keep, arguments.names[0]))
        except (OSError, ValueError) as error:
            raise CommandError(f"--keep: {error}") from None
        return 0
    wrong = fuzzRun.unknown(arguments.names)
    if wrong:
        raise UsageError(f"patina fuzz: there is no fuzzer '{wrong[0]}' (there are: {', '.join(fuzzRun.FUZZERS)})")
    table = checkout.module("testenv/fuzz", "results")
    file = None if arguments.results is None else arguments.results or table.FILE
    # Before the run, which takes hours.
    outputs.check_all([arguments.json, file])
    if file:
        _of_table(table.read, file)
    say = functools.partial(print, file=sys.stderr) if arguments.json == "-" else print
    build = os.path.abspath(arguments.build or os.path.join(checkout.ROOT, "build-fuzz"))
    results = fuzzRun.run(arguments.names, arguments.seconds, arguments.plateau, arguments.seed, arguments.corpus,
                          arguments.findings, build, say)
    try:
        outputs.write_json(arguments.json, {"seed": arguments.seed, "fuzzers": fuzzRun.figures(results)})
    finally:  # one that can no longer be written does not lose the other
        if file:
            _of_table(table.append, [table.row(name, arguments.seed, found) for name, found in results.items()], file)
    return 1 if any(found["findings"] for found in results.values()) else 0


def _of_table(function, *arguments):
    try:
        return function(*arguments)
    except (OSError, ValueError) as error:
        raise CommandError(f"--results: {error}") from error
