# SPDX-License-Identifier: Apache-2.0
"""OpenUSD and the reader of stages, loaded when something of them is first asked for: --help and usage errors need neither."""
import importlib


# Types of MaterialX as USD calls them.
TYPES = {"boolean": "bool", "integer": "int", "float": "float", "vector2": "float2", "vector3": "float3", "vector4": "float4",
         "color3": "color3f", "color4": "color4f", "string": "string", "filename": "asset", "matrix33": "matrix3d",
         "matrix44": "matrix4d"}


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
