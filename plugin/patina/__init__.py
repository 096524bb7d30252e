# SPDX-License-Identifier: Apache-2.0
"""Patina: renders USD stages with physically based shading networks.

`_patina` is the compiled module, `patina.stage` reads stages with pxr, `patina.cli` is the command
line. Nothing is imported before it is asked for, so that help and usage errors need no build.
"""

__version__ = "0.1.0"


def __getattr__(name):
    if name == "_patina":
        import _patina

        return _patina
    raise AttributeError(f"module 'patina' has no attribute '{name}'")
