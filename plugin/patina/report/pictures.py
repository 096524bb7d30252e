# SPDX-License-Identifier: Apache-2.0
"""Each AOV of a film as a picture that the eye can read, and as numbers for the pixel under the pointer."""
import os
import tempfile

import numpy as np

from patina.chart import png
from patina.cli.compiled import _patina
from patina.view import blobs

LARGEST = 1920  # pixels on the longer side of a page's pictures
MISS = 1e9  # depths beyond are those of pixels that see nothing
# viridis (van der Walt and Smith 2015), linear between these sRGB values
_MAP = np.array([(68, 1, 84), (71, 44, 122), (59, 81, 139), (44, 113, 142), (33, 144, 141), (39, 173, 129), (92, 200, 99),
                 (170, 220, 50), (253, 231, 37)], np.float64) / 255.0


def step_of(width, height):
    """:returns: every how many-th pixel a page shows"""
    return max(1, -(-max(width, height) // LARGEST))


def shown(film, options):
    """:param options: of the image's file
    :returns: data URI of the colour as a display shows it"""
    plain = {name: options[name] for name in ("display", "view", "raw", "rendering_color_space") if name in options}
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "color.png")
        _patina.write_images(film, path, dict(plain, aovs=["color", "alpha"], bits=8))
        step = step_of(film.width, film.height)
        if step > 1:
            image = _patina.read_image(path)
            pixels = np.array(image.pixels)[::step, ::step, :3]
            _patina.write_image(path, np.ascontiguousarray(pixels), options={"raw": True, "bits": 8})
        with open(path, "rb") as file:
            return "data:image/png;base64," + blobs.base64.b64encode(file.read()).decode()


def layer(name, values):
    """:param values: of an AOV: height x width (x components)
    :returns: dict of name, uri and what a legend needs: low, high, unit, scale (linear or log), or None"""
    step = step_of(values.shape[1], values.shape[0])
    values = values[::step, ::step]
    if values.dtype.kind == "i":
        return _picture(name, _numbered(values))
    values = np.nan_to_num(values.astype(np.float64))
    if name in ("normal", "Neye", "denoisingNormal"):
        hit = np.abs(values).sum(axis=2, keepdims=True) > 0.0
        return _picture(name, _linear(np.where(hit, 0.5 + 0.5 * values, 0.0)))
    if values.ndim == 3 and values.shape[2] == 3 and name != "position":
        return _picture(name, values)
    if values.ndim == 3:
        low, high = values.min(axis=(0, 1)), values.max(axis=(0, 1))
        flat = (values - low) / np.maximum(high - low, 1e-30)
        return _picture(name, _linear(np.concatenate([flat, np.zeros_like(flat)], axis=2)[..., :3]))
    return heat(name, values, unit="scene units" if "epth" in name else "")


def heat(name, values, unit="", log=False, missing=None):
    """A picture of one number per pixel.

    :param log: colours are of the logarithm
    :param missing: mask of pixels without one, which are black, as are those whose number is not finite"""
    gone = ((values >= MISS) if missing is None else missing) | ~np.isfinite(values)
    kept = values[~gone]
    low, high = (float(kept.min()), float(kept.max())) if kept.size else (0.0, 0.0)
    if log:
        positive = kept[kept > 0.0]
        low, high = (float(np.quantile(positive, 0.01)), float(positive.max())) if positive.size else (1.0, 1.0)
        share = np.log(np.maximum(values, low) / low) / max(np.log(high / low), 1e-12)
    else:
        share = (values - low) / max(high - low, 1e-30)
    colors = _colored(np.where(gone, 0.0, share))
    colors[gone] = 0.0
    return dict(_picture(name, _linear(colors)),
                legend={"low": low, "high": high, "unit": unit, "scale": "log" if log else "linear"})


def relative_error(film):
    """:returns: standard error of each pixel's luminance over the luminance + 0.01, by the variance of its samples"""
    color = np.array(film.resolve("color.noisy" if "color.noisy" in film.aovs else "color"), np.float64)
    luminance = color @ (0.2126, 0.7152, 0.0722)
    return np.sqrt(np.maximum(np.array(film.resolve("variance"), np.float64), 0.0)) / (luminance + 0.01)


def probe(film, error):
    """:returns: dict of what the pixel under the pointer tells: arrays of half floats and whole numbers, packed"""
    step = step_of(film.width, film.height)
    color = np.array(film.resolve("color"))[::step, ::step]
    return {"width": color.shape[1], "height": color.shape[0], "step": step, "color": blobs.pack(blobs.half(color)),
            "samples": blobs.pack(np.minimum(np.array(film.resolve("sampleCount"))[::step, ::step], 65535).astype("<u2")),
            "error": blobs.pack(blobs.half(error[::step, ::step])),
            "depth": blobs.pack(np.array(film.resolve("depth"))[::step, ::step].astype("<f4")),
            "prim": blobs.pack(np.array(film.resolve("primId"))[::step, ::step].astype("<i4"))}


def _picture(name, linear):
    return {"name": name, "uri": png.data_uri(linear), "legend": None}


def _linear(srgb):
    srgb = np.clip(srgb, 0.0, 1.0)
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def _colored(share):
    at = np.clip(share, 0.0, 1.0) * (len(_MAP) - 1)
    index = np.minimum(at.astype(int), len(_MAP) - 2)
    rest = (at - index)[..., None]
    return _MAP[index] * (1.0 - rest) + _MAP[index + 1] * rest


def colormap():
    """:returns: the colours of heat() as CSS, from low to high"""
    return ", ".join("rgb({}, {}, {})".format(*(int(round(255 * c)) for c in color)) for color in _MAP)


def _numbered(ids):
    """:returns: a colour for each number; black for none"""
    numbers = ids.astype(np.uint32) * np.uint32(2654435761)
    hue = (numbers >> 8).astype(np.float64) / float(1 << 24)
    colors = np.stack([0.55 + 0.4 * np.cos(2.0 * np.pi * (hue + shift)) for shift in (0.0, 1.0 / 3.0, 2.0 / 3.0)], axis=2)
    return _linear(np.where(ids[..., None] < 0, 0.0, colors))
