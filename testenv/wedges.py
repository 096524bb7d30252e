# SPDX-License-Identifier: Apache-2.0
"""Renders the wedge pictures of docs/gallery.md: rows of balls along which one parameter goes.

    ./patina python testenv/wedges.py [roughness|anisotropy|film|sheen|classic ...] [--out docs/pictures] [--samples 256]
"""
import argparse
import os
import subprocess
import sys
import tempfile

import usda

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import checkout

    checkout.enter()

HERE = os.path.dirname(os.path.abspath(__file__))
SKY = os.path.join(HERE, "scenes", "textures", "sky.exr")
TILE = 84  # pixels of a ball's cell

HEAD = usda.stage(
    usda.camera(flat=("%(width)g", "%(height)g"), clippingRange=(0.01, 100), at=(0, 0, 10)),
    usda.prim("DomeLight", "sky", "asset inputs:texture:file = @%(sky)s@", intensity=0.8),
    usda.prim("DistantLight", "key", intensity=45, angle=12, turn=(-40, -35, 0)),
    usda.card("wall", 40, z=-1, bind="wallMaterial", st=[(-20, -20), (20, -20), (20, 20), (-20, 20)]))


def material(name, nodes):
    """:param nodes: name -> (id, lines of inputs); @node@ stands for the connection to a node"""
    body = ""
    for node, (identifier, inputs) in nodes.items():
        lines = "".join(f"        {line}\n" for line in inputs)
        body += (f'    def Shader "{node}"\n    {{\n'
                 f'        uniform token info:id = "{identifier}"\n'
                 f'{lines}        token outputs:out\n    }}\n')
    for node in nodes:
        body = body.replace(f"@{node}@", f"</{name}/{node}.outputs:out>")
    return f'def Material "{name}"\n{{\n    token outputs:mtlx:surface.connect = </{name}/surface.outputs:out>\n{body}}}\n'


def bsdf(name, identifier, *inputs):
    return material(name, {"bsdf": (identifier, inputs), "surface": ("ND_surface", ["token inputs:bsdf.connect = @bsdf@"])})


def over(name, identifier, inputs, base):
    """A lobe over a diffuse base of that colour."""
    return material(name, {
        "top": (identifier, inputs), "base": ("ND_oren_nayar_diffuse_bsdf", [f"color3f inputs:color = {base}"]),
        "bsdf": ("ND_layer_bsdf", ["token inputs:top.connect = @top@", "token inputs:base.connect = @base@"]),
        "surface": ("ND_surface", ["token inputs:bsdf.connect = @bsdf@"])})


def rough(alpha, across=None):
    return f"float2 inputs:roughness = ({alpha:g}, {alpha if across is None else across:g})"


GOLD = ["color3f inputs:ior = (0.183, 0.421, 1.373)", "color3f inputs:extinction = (3.424, 2.346, 1.77)"]
SCHLICK = "color3f inputs:color0 = (0.95, 0.45, 0.3)"
RED, BLUE = "(0.5, 0.05, 0.04)", "(0.03, 0.05, 0.16)"


def roughness():
    steps = [0, 0.05, 0.15, 0.3, 0.5, 0.75, 1]
    return [
        [lambda n, a=a: bsdf(n, "ND_conductor_bsdf", *GOLD, rough(a)) for a in steps],
        [lambda n, a=a: bsdf(n, "ND_generalized_schlick_bsdf", SCHLICK, rough(a)) for a in steps],
        [lambda n, a=a: over(n, "ND_dielectric_bsdf", [rough(a)], RED) for a in steps],
        [lambda n, a=a: bsdf(n, "ND_dielectric_bsdf", 'string inputs:scatter_mode = "RT"', rough(a)) for a in steps],
        [lambda n, a=a: bsdf(n, "ND_oren_nayar_diffuse_bsdf", "color3f inputs:color = (0.6, 0.5, 0.35)",
                             f"float inputs:roughness = {a:g}") for a in steps],
        [lambda n, a=a: bsdf(n, "ND_burley_diffuse_bsdf", "color3f inputs:color = (0.6, 0.5, 0.35)",
                             f"float inputs:roughness = {a:g}") for a in steps]]


def anisotropy():
    # The product of both roughnesses stays the same.
    pairs = [(0.25 * k, 0.25 / k) for k in (0.25, 0.4, 0.63, 1, 1.6, 2.5, 4)]
    return [
        [lambda n, p=p: bsdf(n, "ND_conductor_bsdf", *GOLD, rough(*p)) for p in pairs],
        [lambda n, p=p: bsdf(n, "ND_generalized_schlick_bsdf", SCHLICK, rough(*p)) for p in pairs],
        [lambda n, p=p: over(n, "ND_dielectric_bsdf", [rough(*p)], RED) for p in pairs],
        [lambda n, p=p: bsdf(n, "ND_dielectric_bsdf", 'string inputs:scatter_mode = "RT"', rough(*p)) for p in pairs],
        [lambda n, p=p: bsdf(n, "ND_patina_ward_bsdf", "color3f inputs:color = (0.7, 0.7, 0.72)", rough(*p)) for p in pairs]]


def film():
    thicknesses = [100, 200, 300, 400, 550, 700, 1000]

    def inputs(thickness, ior):
        return [f"float inputs:thinfilm_thickness = {thickness}", f"float inputs:thinfilm_ior = {ior}", rough(0.05)]
    rows = [[lambda n, t=t, i=i: bsdf(n, "ND_conductor_bsdf", "color3f inputs:ior = (2.911, 2.95, 2.59)",
                                      "color3f inputs:extinction = (3.089, 2.93, 2.77)", *inputs(t, i))
             for t in thicknesses] for i in (1.3, 1.6, 2.2)]
    return rows + [[lambda n, t=t, i=i: over(n, "ND_dielectric_bsdf", inputs(t, i), "(0.01, 0.01, 0.01)")
                    for t in thicknesses] for i in (1.3, 2.2)]


def sheen():
    steps = [0.05, 0.15, 0.3, 0.45, 0.6, 0.8, 1]
    return [[lambda n, a=a, m=m: over(n, "ND_sheen_bsdf", [f'string inputs:mode = "{m}"', f"float inputs:roughness = {a:g}"],
                                            BLUE)
             for a in steps] for m in ("conty_kulla", "zeltner")]


def classic():
    def row(color, ior, extinction, alpha, phong):
        tint = f"color3f inputs:color = {color}"
        metal = [f"color3f inputs:ior = {ior}", f"color3f inputs:extinction = {extinction}",
                 f"float inputs:roughness = {alpha}"]
        return [lambda n: bsdf(n, "ND_patina_lambert_bsdf", tint),
                lambda n: bsdf(n, "ND_patina_phong_bsdf", tint, f"float inputs:exponent = {phong}"),
                lambda n: bsdf(n, "ND_patina_blinn_phong_bsdf", tint, f"float inputs:exponent = {4 * phong}"),
                lambda n: bsdf(n, "ND_patina_ward_bsdf", tint, rough(alpha), 'string inputs:form = "exact"'),
                lambda n: bsdf(n, "ND_patina_ward_bsdf", tint, rough(alpha), 'string inputs:form = "bounded"'),
                lambda n: bsdf(n, "ND_patina_cook_torrance_bsdf", tint, metal[2], 'string inputs:fresnel = "schlick"'),
                lambda n: bsdf(n, "ND_patina_cook_torrance_bsdf", *metal, 'string inputs:fresnel = "exact"')]
    # The presets of scenes/classic.
    return [row("(0.2593, 0.2975, 0.313)", "(3.074, 3.318, 3.181)", "(0.057, 0.498, 1.02)", 0.2, 12),
            row("(0.5312, 0.5121, 0.4961)", "(2.911, 2.95, 2.59)", "(3.089, 2.93, 2.77)", 0.1, 49.5)]


WEDGES = {"roughness": roughness, "anisotropy": anisotropy, "film": film, "sheen": sheen, "classic": classic}


def stage(rows):
    """:param rows: of functions from a name to the text of a material of that name"""
    columns = len(rows[0])
    # An aperture is in tenths of a scene unit.
    text = HEAD % {"width": 10 * columns, "height": 10 * len(rows), "sky": SKY}
    text += material("wallMaterial", {
        "pattern": ("ND_checkerboard_color3", ["color3f inputs:color1 = (0.33, 0.33, 0.33)",
                                               "color3f inputs:color2 = (0.22, 0.22, 0.22)",
                                               "float2 inputs:uvtiling = (8, 8)"]),
        "surface": ("ND_surface_unlit", ["color3f inputs:emission_color.connect = @pattern@"])})
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
