# SPDX-License-Identifier: Apache-2.0
"""Runs the Hydra tests in several OpenUSDs, and makes docs/generated/openUSD.md of what they gave.

    ./patina python testenv/hydra/versions.py HOST=BUILD_FOLDER ... [--results]

HOST is how the page calls the OpenUSD, BUILD_FOLDER one that `./patina hydra --usd` made. --results adds the rows to
testenv/hydra/versions.json; a row replaces that of the same OpenUSD and host."""
import argparse
import datetime
import json
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

HERE = os.path.dirname(os.path.abspath(__file__))
FILE = os.path.join(HERE, "versions.json")
# column -> the tests that tell of it
PROGRAMS = {"usdrecord": "test_usdrecord", "usdview": "test_usdview", "Blender": "test_blender"}


def run(build):
    """:returns: outcomes of all tests: list of (file, "passed" | "failed" | "skipped")"""
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.xml")
        command = [os.path.join(HERE, "..", "..", "patina"), "test", "--room", "hydra", "--tier", "all", "--",
                   "--junitxml", report]
        subprocess.run(command, env={**os.environ, "PATINA_BUILD_DIR": os.path.abspath(build)}, check=False)
        if not os.path.exists(report):
            sys.exit(f"{build}: the tests did not run; the reason is above")
        return outcomes(ElementTree.parse(report))


def outcomes(report):
    """:param report: an ElementTree of JUnit's form"""
    found = []
    for case in report.iter("testcase"):
        kinds = {child.tag for child in case}
        kind = "failed" if kinds & {"failure", "error"} else "skipped" if "skipped" in kinds else "passed"
        found.append((case.get("classname", "").split(".")[-1], kind))
    return found


def counted(found):
    """:returns: dict from "all" and each of PROGRAMS to dict from outcome to number, without those that are 0"""
    groups = {"all": found, **{name: [one for one in found if one[0] == file] for name, file in PROGRAMS.items()}}
    return {name: {kind: sum(one[1] == kind for one in group) for kind in ("passed", "failed", "skipped")
                   if any(one[1] == kind for one in group)} for name, group in groups.items()}


def page():
    """:returns: lines of docs/generated/openUSD.md"""
    lines = ["# Versions of OpenUSD", "",
             "The plugin was built for each of these, and `./patina test --room hydra --tier all` was run in it. The column",
             "*all* counts every test, those to its right the tests of one program. A test is skipped where its host lacks",
             "what it needs, as usdview's Python files.", "",
             "| OpenUSD | of | date | all | " + " | ".join(PROGRAMS) + " |", "|---|---|---|" + "---|" * (1 + len(PROGRAMS))]
    for row in _rows():
        cells = [", ".join(f"{number} {kind}" for kind, number in row["counts"].get(name, {}).items())
                 for name in ("all", *PROGRAMS)]
        version = f"{row['version'] // 100}.{row['version'] % 100:02d}"
        lines.append(f"| {version} | {row['host']} | {row['date']} | " + " | ".join(cells) + " |")
    return lines


def _rows():
    with open(FILE, encoding="utf-8") as file:
        return json.load(file)


def add(row):
    rows = [old for old in _rows() if (old["version"], old["host"]) != (row["version"], row["host"])]
    with open(FILE, "w", encoding="utf-8") as file:
        json.dump(sorted([*rows, row], key=lambda one: (one["version"], one["host"])), file, indent=1)
        file.write("\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("hosts", nargs="+", metavar="HOST=BUILD_FOLDER")
    parser.add_argument("--results", action="store_true", help="add the rows to the page")
    arguments = parser.parse_args()
    failed = False
    for named in arguments.hosts:
        host, _, build = named.rpartition("=")
        if not os.path.isdir(os.path.join(build, "usdPlugin")):
            parser.error(f"{build} has no Hydra plugin: ./patina hydra --usd FOLDER makes it")
        counts = counted(run(build))
        with open(os.path.join(build, "hydra.json"), encoding="utf-8") as file:  # the tests' build writes it
            version = int(json.load(file)["version"])
        row = {"version": version, "host": host, "date": datetime.date.today().isoformat(), "counts": counts}
        print(json.dumps(row))
        failed |= "failed" in row["counts"]["all"]
        if arguments.results:
            add(row)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
