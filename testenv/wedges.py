# SPDX-License-Identifier: Apache-2.0
"""Renders the wedge pictures of docs/gallery.md: rows of balls along which one parameter goes.

    ./patina python testenv/wedges.py [roughness|anisotropy|film|sheen|classic ...] [--out docs/pictures] [--samples 256]
"""
import argparse
import os
import subprocess
import sys
import tempfile

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import checkout

    checkout.enter()

import usda  # noqa: E402
from usda import lobe  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
SKY = os.path.join(HERE, "scenes", "textures", "sky.exr")
TILE = 84  # pixels of a ball's cell

HEAD = usda.stage(
    usda.camera(flat=("%(width)g", "%(height)g"), clippingRange=(0.01, 100), at=(0, 0, 10)),
    usda.prim("DomeLight", "sky", "asset inputs:texture:file = @%(sky)s@", intensity=0.8),
    usda.prim("DistantLight", "key", intensity=45, angle=12, turn=(-40, -35, 0)),
    usda.card("wall", 40, z=-1, bind="wallMaterial", st=[(-20, -20), (20, -20), (20, 20), (-20, 20)]))


def over(name, category, base, **inputs):
    """A lobe over a diffuse base of that colour."""
    return usda.material(name, {
        "top": (f"ND_{category}", inputs), "base": ("ND_oren_nayar_diffuse_bsdf", {"color": base}),
        "bsdf": ("ND_layer_bsdf", {"top": "<top>", "base": "<base>"}), "surface": ("ND_surface", {"bsdf": "<bsdf>"})})


def made(values, by, category, *more, **inputs):
    """:param values: dicts of the inputs that a row goes through
    :returns: a row of functions from a name to the text of a material"""
    return [lambda name, own=own: by(name, category, *more, **inputs, **own) for own in values]


GOLD = {"ior": (0.183, 0.421, 1.373), "extinction": (3.424, 2.346, 1.77)}
SCHLICK = {"color0": (0.95, 0.45, 0.3)}
TAN, RED, BLUE = (0.6, 0.5, 0.35), (0.5, 0.05, 0.04), (0.03, 0.05, 0.16)


def roughness():
    steps = [0, 0.05, 0.15, 0.3, 0.5, 0.75, 1]
    rough, plain = [{"roughness": (a, a)} for a in steps], [{"roughness": a} for a in steps]
    return [made(rough, lobe, "conductor_bsdf", **GOLD), made(rough, lobe, "generalized_schlick_bsdf", **SCHLICK),
            made(rough, over, "dielectric_bsdf", RED), made(rough, lobe, "dielectric_bsdf", scatter_mode="RT"),
            made(plain, lobe, "oren_nayar_diffuse_bsdf", color=TAN), made(plain, lobe, "burley_diffuse_bsdf", color=TAN)]


def anisotropy():
    # The product of both roughnesses stays the same.
    pairs = [{"roughness": (f"{0.25 * k:g}", f"{0.25 / k:g}")} for k in (0.25, 0.4, 0.63, 1, 1.6, 2.5, 4)]
    return [made(pairs, lobe, "conductor_bsdf", **GOLD), made(pairs, lobe, "generalized_schlick_bsdf", **SCHLICK),
            made(pairs, over, "dielectric_bsdf", RED), made(pairs, lobe, "dielectric_bsdf", scatter_mode="RT"),
            made(pairs, lobe, "patina_ward_bsdf", color=(0.7, 0.7, 0.72))]


def film():
    steps = [{"thinfilm_thickness": thickness} for thickness in (100, 200, 300, 400, 550, 700, 1000)]
    smooth = {"roughness": (0.05, 0.05)}
    steel = {"ior": (2.911, 2.95, 2.59), "extinction": (3.089, 2.93, 2.77)}
    return ([made(steps, lobe, "conductor_bsdf", **steel, thinfilm_ior=ior, **smooth) for ior in (1.3, 1.6, 2.2)]
            + [made(steps, over, "dielectric_bsdf", (0.01, 0.01, 0.01), thinfilm_ior=ior, **smooth) for ior in (1.3, 2.2)])


def sheen():
    steps = [{"roughness": a} for a in (0.05, 0.15, 0.3, 0.45, 0.6, 0.8, 1)]
    return [made(steps, over, "sheen_bsdf", BLUE, mode=mode) for mode in ("conty_kulla", "zeltner")]


def classic():
    def row(color, ior, extinction, alpha, phong):
        tint, rough, metal = {"color": color}, {"roughness": (alpha, alpha)}, {"ior": ior, "extinction": extinction}
        return [lambda name, category=category, inputs=inputs: lobe(name, f"patina_{category}_bsdf", **inputs)
                for category, inputs in (
                    ("lambert", tint), ("phong", {**tint, "exponent": phong}), ("blinn_phong", {**tint, "exponent": 4 * phong}),
                    ("ward", {**tint, **rough, "form": "exact"}), ("ward", {**tint, **rough, "form": "bounded"}),
                    ("cook_torrance", {**tint, "roughness": alpha, "fresnel": "schlick"}),
                    ("cook_torrance", {**metal, "roughness": alpha, "fresnel": "exact"}))]
    # The presets of scenes/classic.
    return [row((0.2593, 0.2975, 0.313), (3.074, 3.318, 3.181), (0.057, 0.498, 1.02), 0.2, 12),
            row((0.5312, 0.5121, 0.4961), (2.911, 2.95, 2.59), (3.089, 2.93, 2.77), 0.1, 49.5)]


WEDGES = {"roughness": roughness, "anisotropy": anisotropy, "film": film, "sheen": sheen, "classic": classic}


def stage(rows):
    """:param rows: of functions from a name to the text of a material of that name"""
    columns = len(rows[0])
    # An aperture is in tenths of a scene unit.
    text = HEAD % {"width": 10 * columns, "height": 10 * len(rows), "sky": SKY}
    text += usda.material("wallMaterial", {
        "pattern": ("ND_checkerboard_color3", {"color1": (0.33, 0.33, 0.33), "color2": (0.22, 0.22, 0.22), "uvtiling": (8, 8)}),
        "surface": ("ND_surface_unlit", {"color3f emission_color": "<pattern>"})})
    for j, row in enumerate(rows):
        for i, make in enumerate(row):
            name = f"m{j}_{i}"
            text += make(name)
            text += usda.prim("Sphere", f"ball{j}_{i}", bind=name, radius=0.44,
                              at=(i - 0.5 * (columns - 1), 0.5 * (len(rows) - 1) - j, 0), turn=(-90, 0, 0))
    return text


def render(name, image, width, samples):
    """:raises: CalledProcessError when a stage fails or warns"""
    rows = WEDGES[name]()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, name + ".usda")
        with open(path, "w", encoding="utf-8") as file:
            file.write(stage(rows))
        subprocess.run([sys.executable, "-m", "patina", "record", path, image, "--camera", "/camera", "--imageWidth",
                        str(width), "--imageHeight", str(width * len(rows) // len(rows[0])), "--samples", str(samples),
                        "--quiet", "--strict", "--disableCameraLight"], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", default=[], metavar="NAME", help=", ".join(WEDGES) + " (default: all)")
    parser.add_argument("--out", default=os.path.join(HERE, "..", "docs", "pictures"))
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--tile", type=int, default=TILE, help="pixels of a ball's cell")
    arguments = parser.parse_args()
    for name in arguments.names:
        if name not in WEDGES:
            parser.error(f"there are no wedges {name} (there are: {', '.join(WEDGES)})")
    for name in arguments.names or WEDGES:
        image = os.path.join(arguments.out, f"wedges{name[0].upper()}{name[1:]}.png")
        render(name, image, arguments.tile * 7, arguments.samples)
        print(image, os.path.getsize(image) // 1024, "KiB", flush=True)


if __name__ == "__main__":
    main()
