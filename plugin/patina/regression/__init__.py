# SPDX-License-Identifier: Apache-2.0
"""Regression tests of a folder of stages, for pytest: `pytest --patina-scenes FOLDER` (plugin.py)."""
