# SPDX-License-Identifier: Apache-2.0
"""Images of a page: environments and textures, made small enough."""
import base64
import gzip

import numpy as np

from patina import inputs
from patina.chart.png import display_values
from patina.cli.compiled import _patina
from patina.view import blobs


def shrunk(image, largest):
    """Halves an image (height, width, channels) until no side is longer than `largest`."""
    while max(image.shape[:2]) > largest:
        h, w = max(1, image.shape[0] // 2), max(1, image.shape[1] // 2)
        rows = image[:2 * h].reshape(h, -1, *image.shape[1:]).mean(axis=1) if image.shape[0] > 1 else image
        image = rows[:, :2 * w].reshape(rows.shape[0], w, -1, image.shape[2]).mean(axis=2) if w > 0 else rows
    return image


def latlong(path, largest):
    """:returns: dict of width, height, format and data of an environment file"""
    inputs.note(path)
    image = np.asarray(_patina.read_image(path).pixels, dtype=np.float32)[..., :3]
    image = shrunk(np.maximum(np.nan_to_num(image), 0.0), largest)
    return half_rgb(image)


def half_rgb(image):
    return {"width": image.shape[1], "height": image.shape[0], "format": "rgb16", "wrap": ["repeat", "clamp"],
            "nearest": False, "data": blobs.pack(blobs.half(image))}


def texture(found):
    """A texture of a material: bytes where values are from 0 to 1, else half floats."""
    texels = np.flipud(found["texels"])  # OpenGL counts rows from below
    entry = {"width": texels.shape[1], "height": texels.shape[0], "wrap": list(found["wrap"]),
             "nearest": bool(found["nearest"])}
    if texels.size and float(texels.min()) >= 0.0 and float(texels.max()) <= 1.0:
        coded = texels.copy()
        coded[..., :3] = display_values(texels[..., :3])
        return {**entry, "format": "srgb8", "data": blobs.pack(np.round(coded * 255.0).astype(np.uint8))}
    return {**entry, "format": "rgba16", "data": blobs.pack(blobs.half(texels))}


def unpacked(entry):
    """The pixels that the page has of an environment, linear floats."""
    data = np.frombuffer(gzip.decompress(base64.b64decode(entry["data"])), "<f2").astype(np.float32)
    return data.reshape(entry["height"], entry["width"], 3)
