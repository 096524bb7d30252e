# SPDX-License-Identifier: Apache-2.0
"""The `patina` command of an installed package, as `python -m patina` is."""
import runpy


def run():
    runpy.run_module("patina", run_name="__main__", alter_sys=False)
