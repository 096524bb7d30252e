# SPDX-License-Identifier: Apache-2.0
"""Lets scripts of testenv be started by any Python: what `python3 testenv/wedges.py` lacks, `./patina python testenv/wedges.py`
has, so that is what it goes on as."""
import importlib.util
import os
import sys

LAUNCHER = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "patina"))
NEEDED = ("_patina", "patina", "pxr", "numpy")


def enter():
    """Returns where a script can import all that it needs. Else the process becomes the launcher, which sets up the checkout
    where that was not done yet, and starts the script again with the same arguments."""
    missing = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if not missing:
        return
    if os.environ.get("PATINA_ENTERED"):
        sys.exit(f"{sys.argv[0]}: {', '.join(missing)} cannot be imported in the environment of {LAUNCHER} either")
    os.environ["PATINA_ENTERED"] = "1"
    os.execv(LAUNCHER, [LAUNCHER, "python", *sys.argv])
