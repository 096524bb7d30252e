# SPDX-License-Identifier: Apache-2.0
"""What benchmarks share: a command line, processes that tell their figures, and medians over the runs."""
import argparse
import json
import statistics
import subprocess
import sys

from patina.cli import outputs


class Parser(argparse.ArgumentParser):
    """Of `patina bench NAME`. :param counts: flags of whole numbers: default, and what it is a number of"""

    def __init__(self, name, description, size=None, **counts):
        super().__init__(prog=f"patina bench {name}", description=description,
                         formatter_class=argparse.RawDescriptionHelpFormatter)
        self.add_argument("--json", metavar="FILE", help="also write the figures as JSON")
        if size:
            self.add_argument("--size", default=size, help=f"of the images (default: {size})")
        for flag, (default, what) in counts.items():
            self.add_argument("--" + flag, type=int, default=default, help=f"{what} (default: {default or 'all'})")

    def parse(self, arguments):
        """:returns: the options, with `size` as typed and as whole numbers in `pixels`"""
        options = self.parse_args(arguments)
        outputs.check_all([options.json])
        if "size" in options:
            options.pixels = tuple(map(int, options.size.split("x")))
        return options

    def known(self, asked, known, fits, needs):
        """:param fits: whether the other options do, and what they need
        :returns: the names that are asked for, all where none is"""
        unknown = [name for name in asked if name not in known]
        if unknown or not fits:
            self.error(f"there is no {unknown[0]}" if unknown else needs)
        return asked or known


def reason(process):
    """:returns: the last that a finished process said"""
    return (process.stderr.strip().splitlines() or ["no message"])[-1]


def told(process, who):
    """:returns: the report of a host; None where it does not run here, which is said"""
    if process.returncode != 0:
        print(f"{who} does not run here: {reason(process)}", file=sys.stderr)
        return None
    return json.loads(process.stdout[process.stdout.index("{"):])


def figures(who, command, **options):
    """:returns: what the last line of a worker tells
    :raises SystemExit: with its reason"""
    process = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, check=False, **options)
    if process.returncode != 0:
        raise SystemExit(f"{who}: {reason(process)}")
    return json.loads(process.stdout.strip().splitlines()[-1])


def spread(ratios):
    """:returns: dict of their median, least and most"""
    return {"ratio": statistics.median(ratios), "least": min(ratios), "most": max(ratios)}


def medians(runs, names, of=lambda run, name: run[name]):
    """:returns: name -> median over the runs"""
    return {name: statistics.median(of(run, name) for run in runs) for name in names}
