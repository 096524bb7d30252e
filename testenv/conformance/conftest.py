# SPDX-License-Identifier: Apache-2.0
"""Makes the Hydra tests' helpers importable."""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "hydra")]
