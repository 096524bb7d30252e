# SPDX-License-Identifier: Apache-2.0
"""The `patina` command of an installed package, as `python -m patina` is."""
import os
import sys

from patina.cli import interrupts


def run():
    os.environ["PYTHONSAFEPATH"] = "1"  # as by the launcher: a Python that is started here runs no module of the current folder
    interrupts.begin(sys.argv[1:2])
    import runpy

    runpy.run_module("patina", run_name="__main__", alter_sys=False)
