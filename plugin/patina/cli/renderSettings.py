# SPDX-License-Identifier: Apache-2.0
"""A UsdRenderSettings prim as `patina record --settings` takes it. It says what flags leave open: camera, resolution, purposes,
products with their AOVs (products.py), and render settings by the names `patina:NAME`. Flags that are given are stronger.
"""
import argparse
import math

from patina.cli import recordFlags, settingFlags
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError
from patina.cli.usd import Sdf, Usd, UsdRender

STAGE = "stage"  # --settings stage: the one that the stage's own metadata names
_BACKENDS = ("embree", "raster")


class SettingsPrim:
    """A UsdRenderSettings prim of a stage."""

    def __init__(self, stage, path, given=()):
        """:param path: of the prim, or STAGE
        :param given: names of arguments that were typed
        :raises CommandError: where there is none"""
        if path == STAGE:
            found = UsdRender.Settings.GetStageRenderSettings(stage)
            if not found:
                raise CommandError("--settings stage: the stage's metadata name no render settings (renderSettingsPrimPath)")
            self.prim = found.GetPrim()
        else:
            if not Sdf.Path.IsValidPathString(path) or not path.startswith("/"):
                raise CommandError(f"--settings: {path} is no prim path")
            self.prim = stage.GetPrimAtPath(path)
            if not self.prim or not self.prim.IsA(UsdRender.Settings):
                there = [str(p.GetPath()) for p in stage.Traverse() if p.IsA(UsdRender.Settings)]
                reason = "is no UsdRenderSettings prim" if self.prim else "is not there"
                raise CommandError(f"--settings: {path} {reason} (there are: {', '.join(there[:12]) or 'none'})")
        self.stage, self.path, self.given = stage, str(self.prim.GetPath()), frozenset(given)
        self.warnings = []  # (prim path, input, id of a message, its fields...)
        self.extra = {}  # render settings that have no flag

    def warn(self, prim, name, id_, *fields):
        item = (str(prim), name, id_, *map(str, fields))
        if item not in self.warnings:
            self.warnings.append(item)

    def value(self, product, name, time=None):
        """:param product: a prim that may override it, or None
        :returns: of an attribute of UsdRenderSettingsBase"""
        time = Usd.TimeCode.Default() if time is None else Usd.TimeCode(time)
        attribute = (self._authoring(product, name) or self.prim).GetAttribute(name)
        return attribute.Get(time) if attribute else None

    def authored(self, product, name):
        return self._authoring(product, name) is not None

    def _authoring(self, product, name):
        """:returns: the prim whose value of an attribute counts, or None"""
        for prim in filter(None, (product, self.prim)):
            if prim.GetAttribute(name) and prim.GetAttribute(name).HasAuthoredValue():
                return prim
        return None

    def where(self, product, name):
        """:returns: path of the prim whose value of an attribute counts"""
        return str((self._authoring(product, name) or self.prim).GetPath())

    def numbers(self, product, name, count):
        """:returns: list of numbers; None where there is no value, and after a warning where it is anything else"""
        value = self.value(product, name)
        if value is None:
            return None
        try:
            # A text may read as a number, and is a sequence of texts itself.
            found = [math.nan if isinstance(x, str) else float(x) for x in ([value] if count == 1 else value)]
        except (TypeError, ValueError):
            found = []
        if len(found) == count and all(map(math.isfinite, found)):
            return found
        if count == 1:
            self.warn(self.where(product, name), name, "settingNotFinite")
        else:
            self.warn(self.where(product, name), name, "settingNotNumbers", count)
        return None

    def purposes(self, name):
        """:returns: list of tokens; None where none are authored, and after a warning where the value is anything else"""
        attribute = self.prim.GetAttribute(name)
        value = attribute.Get() if attribute and attribute.HasAuthoredValue() else None
        if value is None:
            return None
        found = None if isinstance(value, str) or not hasattr(value, "__iter__") else list(value)
        if found is None or not all(isinstance(purpose, str) for purpose in found):
            self.warn(self.path, name, "noPurposeList")
            return None
        return found

    def target(self, product, name):
        """:returns: path of a relationship's first target, or None"""
        for prim in filter(None, (product, self.prim)):
            relationship = prim.GetRelationship(name)
            targets = relationship.GetForwardedTargets() if relationship else []
            if targets:
                return str(targets[0])
        return None


def with_pass(arguments, stage):
    """:returns: the arguments with the settings that --renderPassPrimPath names by its renderSource
    :raises CommandError: where there is no such pass"""
    path = arguments.renderPassPrimPath
    if not path:
        return arguments
    prim = stage.GetPrimAtPath(path) if Sdf.Path.IsValidPathString(path) and path.startswith("/") else None
    if not prim or not prim.IsA(UsdRender.Pass):
        there = [str(p.GetPath()) for p in stage.Traverse() if p.IsA(UsdRender.Pass)]
        reason = "is no UsdRenderPass prim" if prim else "is not there"
        raise CommandError(f"--renderPassPrimPath: {path} {reason} (there are: {', '.join(there[:12]) or 'none'})")
    sources = prim.GetRelationship("renderSource").GetForwardedTargets() if prim.HasRelationship("renderSource") else []
    if len(sources) > 1:
        raise CommandError(f"--renderPassPrimPath: {path} has {len(sources)} prims as its renderSource, where one can be used")
    if arguments.settings or not sources:
        return arguments
    return argparse.Namespace(**dict(vars(arguments), settings=str(sources[0])))


def applied(arguments, prim):
    """:returns: the arguments with what the prim says where they were not given; prim.extra has the settings without a flag"""
    merged = argparse.Namespace(**vars(arguments))
    _purposes(merged, prim)
    merged.materialPurpose = _material_purpose(prim)
    space = prim.prim.GetAttribute("renderingColorSpace")
    if space and space.HasAuthoredValue() and "renderingColorSpace" not in prim.given:
        _rendering_space(merged, prim, "renderingColorSpace", space.Get())
    merged.method = list(arguments.method)
    forced = {text.partition("=")[0] for text in arguments.method}
    for attribute in prim.prim.GetAuthoredAttributes():
        name = attribute.GetName()
        if not name.startswith("patina:"):
            continue
        key = name[len("patina:"):]
        key = key[len("global:"):] if key.startswith("global:") else key
        value = attribute.Get()
        if key.startswith("method:"):
            if key[len("method:"):] not in forced:
                _method(merged, prim, name, key[len("method:"):], value)
        elif value is not None and key not in prim.given:
            _setting(merged, prim, name, key, value)
    return merged


def _rendering_space(merged, prim, name, value):
    if _patina.rendering_space(str(value)) is None:
        prim.warn(prim.path, name, "renderingSpaceUnknown", value)
    else:
        merged.renderingColorSpace = str(value)


def _method(merged, prim, name, point, value):
    """A `patina:method:` attribute."""
    problem = _patina.check_methods({point: str(value)})
    if problem:
        prim.warn(prim.path, name, "methodKept", problem)
    else:
        merged.method.append(f"{point}={value}")


def _purposes(merged, prim):
    included = None if "purposes" in prim.given else prim.purposes("includedPurposes")
    if included is None:
        return
    known = [purpose for purpose in included if purpose in ("default", "render", "proxy", "guide")]
    for purpose in included:
        if purpose not in known:
            prim.warn(prim.path, "includedPurposes", "includedPurposeUnknown", purpose)
    if not known:
        prim.warn(prim.path, "includedPurposes", "noPurposeIncluded")
    merged.purposes, merged.defaultPurpose = ",".join(known) or "none", not known or "default" in known


def _material_purpose(prim):
    authored = prim.purposes("materialBindingPurposes")
    # "allPurpose" is how the schema's own default spells the purpose "".
    wanted = ["full"] if authored is None else [purpose for purpose in authored if purpose not in ("", "allPurpose")]
    if len(wanted) > 1:
        prim.warn(prim.path, "materialBindingPurposes", "onePurposeUsed", wanted[0])
    return wanted[0] if wanted else ""


def _setting(merged, prim, name, key, value):
    """A `patina:` attribute."""
    if key == "backend":
        if value not in (*_BACKENDS, "auto", "interactive"):
            prim.warn(prim.path, name, "backendUnknown", value)
        merged.backend = value if value in _BACKENDS else merged.backend
        return
    if key in ("denoise", "denoiseAovs"):
        setattr(merged, key, bool(value))
        return
    if key == "outliers":
        if value not in recordFlags.OUTLIERS:
            prim.warn(prim.path, name, "settingNotAllowed", value)
        else:
            merged.outliers = value
        return
    row = settingFlags.table().get(key)
    if row is None or "label" not in row.words:
        prim.warn(prim.path, name, "settingMissing")
        return
    try:
        checked = settingFlags.value_of(row, value)
    except (TypeError, ValueError):
        prim.warn(prim.path, name, "settingNotAllowed", value)
        return
    if key in settingFlags.names():
        setattr(merged, key, checked)
    else:
        prim.extra[key] = checked
