# SPDX-License-Identifier: Apache-2.0
"""Differences between versions of OpenUSD, 23.11 and later. Nothing else looks at versions."""
import io
import zipfile

from pxr import Ar, Tf, Usd, UsdShade, UsdUtils

from .errors import one_line


def exposure_scale(camera, time):
    """:returns: linear factor of the image"""
    if hasattr(camera, "ComputeLinearExposureScale"):
        return float(camera.ComputeLinearExposureScale(time))
    exposure = camera.GetExposureAttr().Get(time) if hasattr(camera, "GetExposureAttr") else None
    return 2.0 ** exposure if isinstance(exposure, float) else 1.0


def composition_errors(stage):
    """:returns: list of (prim path, text)"""
    if hasattr(stage, "GetCompositionErrors"):
        return [(str(error.rootSite.path), str(error)) for error in stage.GetCompositionErrors()]
    root = stage.GetPseudoRoot()
    found = [("/", str(error)) for error in root.GetPrimIndex().rootNode.layerStack.localErrors]
    for prim in Usd.PrimRange.AllPrims(root):
        found.extend((str(prim.GetPath()), str(error)) for error in prim.GetPrimIndex().localErrors)
    return found


def resolve_tiles(stage, path, layer):
    """:param path: with <UDIM>, as a layer says it
    :returns: the same as an absolute path of tiles that are there, in a package or beside it; empty where there are none"""
    utils = getattr(UsdShade, "UdimUtils", None)
    if not utils or not layer:
        return ""
    with Ar.ResolverContextBinder(stage.GetPathResolverContext()):
        return str(utils.ResolveUdimPath(path, layer))


def read_asset(path):
    """:param path: of a file, or of one in a package: "a.usdz[b.png]", "a.usdz[b.usdz[c.png]]"
    :returns: its bytes, None when it cannot be read"""
    resolver = Ar.GetResolver()
    if hasattr(resolver, "OpenAsset"):
        try:
            asset = resolver.OpenAsset(Ar.ResolvedPath(path))
        except Tf.ErrorException:  # of a package that is damaged, or packs its files
            return None
        if not asset:
            return None
        with asset:
            data = asset.GetBuffer()
            return None if data is None else bytes(data)  # none of an empty file
    package, inner = Ar.SplitPackageRelativePathOuter(path)
    try:
        with open(package, "rb") as file:
            data = file.read() if not inner else _from_zip(file, inner)
        while inner and Ar.IsPackageRelativePath(inner):
            inner = Ar.SplitPackageRelativePathOuter(inner)[1]
            data = _from_zip(io.BytesIO(data), inner)
        return data
    except (OSError, KeyError, EOFError, ValueError, RuntimeError, zipfile.BadZipFile):  # all that damage makes zipfile raise
        return None


def _from_zip(file, inner):
    """:returns: bytes of the outermost file that a path inside of a package names"""
    with zipfile.ZipFile(file) as package:
        found = package.getinfo(Ar.SplitPackageRelativePathOuter(inner)[0] if Ar.IsPackageRelativePath(inner) else inner)
        if found.compress_type != zipfile.ZIP_STORED:
            raise KeyError(inner)  # no usdz, and it may hold a thousand times its bytes
        return package.read(found)


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


def attempt(call, *arguments):
    """:returns: (what a call of pxr gives, None where it fails; what it says of that, empty for nothing)"""
    with QuietDiagnostics() as quiet:
        try:
            found, problem = call(*arguments), ""
        except Tf.ErrorException as error:
            found, problem = None, one_line(error)
    return found, quiet.texts[0] if quiet.texts else problem
