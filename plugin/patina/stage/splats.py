# SPDX-License-Identifier: Apache-2.0
"""UsdVolParticleField: kernels with captured radiance."""
import numpy as np
from pxr import Vt

from .context import array, get, number

_QUATERNIONS = (Vt.QuatfArray, Vt.QuathArray, Vt.QuatdArray)
_SHAPES = {f"ParticleFieldKernel{name[0].upper()}{name[1:]}API": name
           for name in ("gaussianEllipsoid", "gaussianSurflet", "constantSurflet")}
_HARMONICS = "radiance:sphericalHarmonicsCoefficients"


def emit(context, found, common):
    prim = found.prim
    shape = next((_SHAPES[name] for name in prim.GetPrimTypeInfo().GetAppliedAPISchemas() + prim.GetAppliedSchemas()
                  if name in _SHAPES), None)
    if not shape:
        context.warn(prim.GetPath(), "", "typeNotDrawn", f"{prim.GetTypeName()} without a kernel")
        return
    degree = number(context, prim, "radiance:sphericalHarmonicsDegree", 3)
    radiance = prim.GetAttribute(_HARMONICS)
    space = context.color_spaces.space_of(radiance, is_color=True) if radiance else ""
    context.edit.set_splats(
        found.path, shape=shape, positions=_values(context, prim, "positions", 3),
        orientations=_values(context, prim, "orientations", 4), scales=_values(context, prim, "scales", 3),
        opacities=_values(context, prim, "opacities", 1), degree=int(np.clip(degree, -1, 1000)),
        harmonics=_values(context, prim, _HARMONICS, 3), color_space=space, **common)


def _values(context, prim, name, components):
    """:returns: of the attribute of floats, else of that of halves; quaternions begin with the real part"""
    for input_ in (name, name + "h"):
        value = get(prim, input_, context.time)
        if value is not None:
            values = array(context, prim, input_, value, components)
            return np.roll(values, 1, axis=1) if isinstance(value, _QUATERNIONS) and len(values) else values
    return None
