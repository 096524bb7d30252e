# SPDX-License-Identifier: Apache-2.0
"""OpenUSD and the reader of stages, loaded when something of them is first asked for: --help and usage errors need neither."""
import importlib


class _Later:
    """A module that is not imported yet."""

    def __init__(self, name):
        self._name = name

    def __getattr__(self, attribute):
        return getattr(importlib.import_module(self._name), attribute)


Ar, Gf, Sdf, Tf = (_Later("pxr." + name) for name in ("Ar", "Gf", "Sdf", "Tf"))
Usd, UsdLux, UsdRender, UsdShade, UsdUtils = (
    _Later("pxr." + name) for name in ("Usd", "UsdLux", "UsdRender", "UsdShade", "UsdUtils"))
reader = _Later("patina.stage")
