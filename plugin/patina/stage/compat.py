"""Differences between versions of OpenUSD, 23.11 and later. Nothing else looks at versions."""
from pxr import Usd, UsdGeom, UsdShade, UsdUtils

# Schemas that not every version has.
CAPSULE_1 = getattr(UsdGeom, "Capsule_1", None)
CYLINDER_1 = getattr(UsdGeom, "Cylinder_1", None)
PLANE = getattr(UsdGeom, "Plane", None)


def exposure_scale(camera, time):
    """:returns: linear factor of the image"""
    if hasattr(camera, "ComputeLinearExposureScale"):
        return float(camera.ComputeLinearExposureScale(time))
    exposure = camera.GetExposureAttr().Get(time) if hasattr(camera, "GetExposureAttr") else None
    return 2.0 ** float(exposure or 0.0)


def composition_errors(stage):
    """:returns: list of (prim path, text)"""
    if hasattr(stage, "GetCompositionErrors"):
        errors = stage.GetCompositionErrors()
    else:
        errors = [e for prim in Usd.PrimRange.AllPrims(stage.GetPseudoRoot())
                  for e in prim.GetPrimIndex().localErrors]
    found = []
    for error in errors:
        site = getattr(error, "rootSite", None)
        found.append((str(getattr(site, "path", "") or "/"), str(error)))
    return found


def bound_materials(prims):
    """:returns: list of (Material, strength) for the purpose `full`, then the general one"""
    result = UsdShade.MaterialBindingAPI.ComputeBoundMaterials(prims, UsdShade.Tokens.full)
    materials, relationships = result
    return list(zip(materials, relationships))


class QuietDiagnostics:
    """Takes what pxr would print while the block runs; `texts` has it afterwards."""

    def __enter__(self):
        self.texts = []
        self._delegate = UsdUtils.CoalescingDiagnosticDelegate()
        return self

    def __exit__(self, *exception):
        for item in self._delegate.TakeUncoalescedDiagnostics():
            text = " ".join(str(item.commentary).split())
            if text and text not in self.texts:
                self.texts.append(text)
        self._delegate = None
