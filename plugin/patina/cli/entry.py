# SPDX-License-Identifier: Apache-2.0
"""The `patina` command of an installed package, as `python -m patina` is."""
import os
import sys

_ENTRIES = os.environ.get("PYTHONPATH", "").split(os.pathsep)
# An empty one, as of `export PYTHONPATH=$PYTHONPATH:/x`, or a relative one means the current folder.
_MEANT = [entry for entry in _ENTRIES if os.path.isabs(entry)]
if _MEANT != _ENTRIES:
    os.environ["PYTHONPATH"] = os.pathsep.join(_MEANT)
    sys.path[:] = [entry for entry in sys.path
                   if entry in _MEANT or entry not in [os.path.abspath(other) for other in _ENTRIES]]

from patina.cli import interrupts  # noqa: E402


def run():
    os.environ["PYTHONSAFEPATH"] = "1"  # as by the launcher: a Python that is started here runs no module of the current folder
    interrupts.begin(sys.argv[1:2])
    import runpy

    runpy.run_module("patina", run_name="__main__", alter_sys=False)
