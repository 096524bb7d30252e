# SPDX-License-Identifier: Apache-2.0
"""The products of a UsdRenderSettings prim as shots: those that are rendered alike share one.

Names of products may hold places for the frame. They lead out of the folder of products only where a flag allows it: the stage
may be somebody else's.
"""
import math
import os
from collections import OrderedDict

import numpy as np

from patina.cli import frames, recordFlags, rows, settingFlags, shot
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError
from patina.cli.usd import Usd, UsdRender

_AOV_NAMES = {"Ci": "color", "beauty": "color", "C.*": "color", "a": "alpha", "z": "depth", "N": "normal", "P": "position"}
_SIZE = (2048, 1080)  # UsdRender's own
_FAR = 1000.0  # frames that a window may reach beyond the frame
_HALF = ("half", "half3", "half4", "color3h", "color4h")


def shots_at(prim, arguments, time, decimals):
    """:param arguments: those of applied()
    :returns: list of Shots of a frame: products that are rendered alike share one"""
    products = _products(prim)
    if arguments.image:
        if len(products) > 1:
            first = products[0].GetPath()
            prim.warn(prim.path, "products", "productsTooMany", len(products), first)
        products = products[:1] or [None]
    elif not products:
        raise CommandError(f"{prim.path} has no products: name an IMAGE")
    grouped = OrderedDict()
    for product in products:
        made = _shot(prim, product, arguments, time, decimals)
        if made is not None:
            key = (made.camera, made.size, repr(sorted(made.settings.items())))
            if key in grouped:
                grouped[key].outputs += made.outputs
            else:
                grouped[key] = made
    return list(grouped.values())


def _products(prim):
    found = []
    relationship = prim.prim.GetRelationship("products")
    for target in relationship.GetForwardedTargets() if relationship else []:
        product = prim.stage.GetPrimAtPath(target)
        if not product or not product.IsA(UsdRender.Product):
            prim.warn(prim.path, "products", "noProduct", target)
            continue
        kind = product.GetAttribute("productType").Get()
        if kind not in (None, "raster", "deepRaster"):
            prim.warn(target, "productType", "productTypeUnknown", kind)
            continue
        found.append(product)
    return found


def _shot(prim, product, arguments, time, decimals):
    """:returns: a Shot with one output; None, after a warning, where it has no name"""
    image = arguments.image
    if not image:
        name = product.GetAttribute("productName")
        image = str(prim_value(name, time) or "")
        if not image:
            prim.warn(product.GetPath(), "productName", "productNameEmpty")
            return None
    if time is None and frames.has_place(image):
        raise CommandError(f"{image} has a place for frames, but the default time is rendered")
    image = frames.named(image, time, decimals)
    if not arguments.image:
        image = _placed(product.GetPath(), image, arguments)
    deep = bool(product) and str(prim_value(product.GetAttribute("productType"), None)) == "deepRaster"
    aovs, half = _aovs(prim, product)
    if deep:
        _check_deep(prim, product, image, aovs)
        aovs = ()
    extra = [name for name in recordFlags.aovs_of(arguments) if name not in aovs]
    output = shot.Output(image, () if deep else tuple([*aovs, *extra]), arguments.half or half, deep)
    size = _size(prim, product, arguments)
    camera = arguments.camera or prim.target(product, "camera")
    return shot.Shot(time, [output], camera, size, _render_settings(prim, product, arguments, size),
                     prim=str(product.GetPath() if product else prim.path))


def _check_deep(prim, product, image, aovs):
    for aov in aovs:
        if aov not in ("color", "alpha", "depth"):
            prim.warn(product.GetPath(), "orderedVars", "deepVarLeftOut", aov)
    if not image.lower().endswith(".exr"):
        raise CommandError(f"{product.GetPath()}: deep images are OpenEXR (.exr), not {image}")


def _placed(product, name, arguments):
    """:param product: path of the prim
    :param name: of its file, as the stage has it
    :returns: the file, by a name that is meant from the folder of products
    :raises CommandError: where it is outside of that"""
    file = os.path.join(arguments.outputFolder or "", name)
    folder = os.path.realpath(arguments.outputFolder or os.curdir)
    if not arguments.allowOutside and os.path.commonpath([folder, os.path.realpath(file)]) != folder:
        raise CommandError(f"{product} names the file '{name}', which is outside of the folder {folder}: --outputFolder FOLDER "
                           "names another folder for products, --allowOutside lets the stage name any")
    return file


def _size(prim, product, arguments):
    """:returns: width and height: what one flag leaves open follows from the other and the prim's shape"""
    width, height = (int(n) for n in prim.numbers(product, "resolution", 2) or _SIZE)
    if width < 1 or height < 1:
        prim.warn(prim.where(product, "resolution"), "resolution",
                  "resolutionUnusable", width, height, f"{_SIZE[0]} x {_SIZE[1]}")
        width, height = _SIZE
    if arguments.imageWidth and arguments.imageHeight:
        return arguments.imageWidth, arguments.imageHeight
    if arguments.imageWidth:
        return arguments.imageWidth, max(1, round(arguments.imageWidth * height / width))
    if arguments.imageHeight:
        return max(1, round(arguments.imageHeight * width / height)), arguments.imageHeight
    return width, height


def _render_settings(prim, product, arguments, size):
    """:returns: dict of render settings that the product decides"""
    settings = dict(prim.extra)
    if "pixelAspectRatio" not in prim.given:
        _set_pixel_aspect_ratio(prim, product, settings)
    if prim.authored(product, "aspectRatioConformPolicy"):
        settings["aspectRatioConformPolicy"] = str(prim.value(product, "aspectRatioConformPolicy"))
    if prim.value(product, "disableMotionBlur") or prim.value(product, "instantaneousShutter"):
        settings["enableMotionBlur"] = False
    if prim.value(product, "disableDepthOfField"):
        settings["enableDepthOfField"] = False
    window = prim.numbers(product, "dataWindowNDC", 4) if arguments.dataWindow is None else None
    if window is not None and window != [0.0, 0.0, 1.0, 1.0]:
        width, height = size
        left, bottom, right, top = (_first_pixel(n, pixels) for n, pixels in zip(window, size * 2))
        settings["dataWindow"] = [left, height - top, right - 1, height - 1 - bottom]
        if settings["dataWindow"][2] < settings["dataWindow"][0] or settings["dataWindow"][3] < settings["dataWindow"][1]:
            where = product.GetPath() if product else prim.path
            prim.warn(where, "dataWindowNDC", "windowEmpty")
            del settings["dataWindow"]
    return settings


def _first_pixel(edge, pixels):
    """:param edge: of a window, 0 to 1 for the frame, from the left or the bottom
    :returns: number of the first pixel whose centre lies at it or behind it, in single precision as the edge is stored"""
    return math.ceil(np.float32(min(_FAR, max(-_FAR, edge))) * np.float32(pixels) - np.float32(0.5))


def _set_pixel_aspect_ratio(prim, product, settings):
    least, most = settingFlags.table()["pixelAspectRatio"].words["flagRange"]
    found = prim.numbers(product, "pixelAspectRatio", 1)
    if found and least <= found[0] <= most:
        settings["pixelAspectRatio"] = found[0]
    elif found:
        prim.warn(prim.where(product, "pixelAspectRatio"), "pixelAspectRatio",
                  "pixelAspectNotAllowed", f"{found[0]:g}", f"{least:g}", f"{most:g}")


def _aovs(prim, product):
    """:returns: AOVs of a product in their order, and whether its colour has 16 bits"""
    names, half = [], bool(product) and bool(prim_value(product.GetAttribute("patina:half"), None))
    relationship = product.GetRelationship("orderedVars") if product else None
    for target in relationship.GetForwardedTargets() if relationship else []:
        var = prim.stage.GetPrimAtPath(target)
        if not var:
            prim.warn(product.GetPath(), "orderedVars", "varNotFound", target)
            continue
        source = str(prim_value(var.GetAttribute("sourceName"), None) or "")
        aov = film_aov(source, prim_value(var.GetAttribute("sourceType"), None), _name_of(var))
        if not aov:
            prim.warn(target, "sourceName", "aovUnknown", source)
            continue
        problem = _problem_of(aov)
        if problem:
            prim.warn(target, "sourceName", "aovLeftOut", problem)
            continue
        half = half or (aov == "color" and str(prim_value(var.GetAttribute("dataType"), None)) in _HALF)
        if aov not in names:
            names.append(aov)
    return names or ["color", "alpha"], half


def prim_value(attribute, time):
    """:returns: of an attribute, or None where it is not there"""
    return attribute.Get(Usd.TimeCode.Default() if time is None else Usd.TimeCode(time)) if attribute else None


def _name_of(var):
    """:returns: what names the channels of a UsdRenderVar of light paths: as its host's driver has it, else the prim's name"""
    for attribute in ("driver:parameters:aov:name", "ri:driver:parameters:aov:name"):
        name = prim_value(var.GetAttribute(attribute), None)
        if name:
            return str(name)
    return var.GetName()


def _problem_of(aov):
    """:returns: what is wrong with an AOV of light paths, '' for none"""
    if "lpe:" not in aov:
        return ""
    try:
        _patina.channels_of_aov(aov)
    except ValueError as error:
        return str(error)
    return ""


def film_aov(name, kind=None, var_name=""):
    """:param kind: sourceType of a UsdRenderVar
    :param var_name: what names the channels where it is a light path expression
    :returns: the film's AOV that a source means, as in Hydra; '' for none"""
    if kind == "primvar":
        return f"primvars:{name}" if name else ""
    if name in _AOV_NAMES:
        return _AOV_NAMES[name]
    if kind == "lpe" or name.startswith("lpe:"):
        expression = name[len("lpe:"):] if name.startswith("lpe:") else name
        own = var_name and not _is_known(var_name)
        if expression in _AOV_NAMES:
            return _AOV_NAMES[expression]
        return (f"{var_name}=lpe:" if own else "lpe:") + expression if expression else ""
    table = rows.read("hdDelegate/film/aovs.def", "AOV")
    for row in table:
        if name in row.words.get("hydra", []) or name in row.words.get("also", [""])[0].split():
            return row.values[0]
    return name if name.startswith("primvars:") or _is_known(name) else ""


def _is_known(name):
    return any(row.values[0] == name and name != "lpe" for row in rows.read("hdDelegate/film/aovs.def", "AOV"))
