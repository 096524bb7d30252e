# SPDX-License-Identifier: Apache-2.0
"""Makes the helpers beside the tests importable, and leaves the tests out where there is no Hydra:
test_found.py says so in one line."""
import os
import sys

HERE = os.path.dirname(__file__)
sys.path.insert(0, HERE)
sys.path += [os.path.join(HERE, "..", folder) for folder in ("render", "raster")]

import hydraBuild  # noqa: E402

if hydraBuild.missing():
    collect_ignore_glob = ["test_[!f]*.py", "usdview/*"]
