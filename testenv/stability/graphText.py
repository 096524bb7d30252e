# SPDX-License-Identifier: Apache-2.0
"""Random legal MaterialX graphs of physically based shading nodes, as text.

A seed gives the same text for ever. Parameters are ordinary values, the extremes of float (0, tiny, huge, negative),
what is no number (as the result of a pattern: MaterialX text has no word for it) and patterns in between.
"""
import random

EXTREMES = (0.0, 1e-8, 1e-4, 1e-3, 0.5, 1.0, 50.0, 1e9, 3e38, -1.0)
COLOR_EXTREMES = (0.0, 1e-8, 0.5, 1.0, 1.0, 1.0, 0.0)
HUGE_COLORS = (2.0, 65504.0, 1e30, -1.0)

# Category, inputs: name -> (type, lowest and highest of ordinary values). "unit": a share; "color": a tint.
BSDFS = {
    "oren_nayar_diffuse_bsdf": {"weight": "unit", "color": "color", "roughness": ("float", 0, 1), "normal": "normal",
                                "energy_compensation": "boolean"},
    "burley_diffuse_bsdf": {"weight": "unit", "color": "color", "roughness": ("float", 0, 1), "normal": "normal"},
    "translucent_bsdf": {"weight": "unit", "color": "color", "normal": "normal"},
    "dielectric_bsdf": {"weight": "unit", "tint": "color", "ior": ("float", 1, 3), "microfacet": "", "scatter_mode": "mode"},
    "conductor_bsdf": {"weight": "unit", "ior": ("color3", 0, 4), "extinction": ("color3", 0, 6), "microfacet": ""},
    "generalized_schlick_bsdf": {"weight": "unit", "color0": "color", "color82": "color", "color90": "color",
                                 "exponent": ("float", 1, 8), "microfacet": "", "scatter_mode": "mode"},
    "subsurface_bsdf": {"weight": "unit", "color": "color", "radius": ("color3", 0, 2), "anisotropy": ("float", -1, 1),
                        "normal": "normal"},
    "sheen_bsdf": {"weight": "unit", "color": "color", "roughness": ("float", 0, 1), "normal": "normal",
                   "mode": ("conty_kulla", "zeltner")},
    "chiang_hair_bsdf": {"tint_R": "color", "tint_TT": "color", "tint_TRT": "color", "ior": ("float", 1.1, 2),
                         "roughness_R": ("vector2", 0, 1), "roughness_TT": ("vector2", 0, 1),
                         "roughness_TRT": ("vector2", 0, 1), "cuticle_angle": ("float", 0, 1),
                         "absorption_coefficient": ("vector3", 0, 2), "normal": "normal", "curve_direction": "tangent"},
    "patina_lambert_bsdf": {"weight": "unit", "color": "color", "normal": "normal"},
    "patina_phong_bsdf": {"weight": "unit", "color": "color", "exponent": ("float", 1, 500), "normal": "normal"},
    "patina_blinn_phong_bsdf": {"weight": "unit", "color": "color", "exponent": ("float", 1, 500), "normal": "normal"},
    "patina_ward_bsdf": {"weight": "unit", "color": "color", "roughness": ("vector2", 0, 1), "normal": "normal",
                         "tangent": "tangent", "form": ("bounded", "exact")},
    "patina_cook_torrance_bsdf": {"weight": "unit", "color": "color", "ior": ("color3", 0, 4), "extinction": ("color3", 0, 6),
                                  "roughness": ("float", 0, 1), "normal": "normal", "fresnel": ("exact", "schlick")},
}
MICROFACET = {"roughness": ("vector2", 0, 1), "thinfilm_thickness": ("float", 0, 2000), "thinfilm_ior": ("float", 1, 3),
              "normal": "normal", "tangent": "tangent", "distribution": ("ggx", "ggx", "beckmann")}
EDFS = {
    "uniform_edf": {"color": "color"},
    "conical_edf": {"color": "color", "normal": "normal", "inner_angle": ("float", 0, 90), "outer_angle": ("float", 0, 90)},
    "generalized_schlick_edf": {"color0": "color", "color90": "color", "exponent": ("float", 1, 8)},
}
VDFS = {
    "absorption_vdf": {"absorption": ("vector3", 0, 3)},
    "anisotropic_vdf": {"absorption": ("vector3", 0, 3), "scattering": ("vector3", 0, 3), "anisotropy": ("float", -1, 1)},
}
BURLEY_GAIN = 1.56  # of a white lobe of roughness 1 at grazing angles: the model as it was published
# Parts of graphs beside the tables: nodes that take the place of others, or stand between.
MORE = ("dielectric_btdf", "thin_film_bsdf", "patina_dispersed_ior")
# Methods that cost a graph tens to thousands of times the usual.
SLOW = {("energyCompensation", "randomWalk"), ("layering", "positionFree"), ("directionalAlbedo", "quadrature"),
        ("directionalAlbedo", "monteCarlo16"), ("thinFilm", "spectral"), ("sheen", "quadrature")}
SIZES = {"float": 1, "vector2": 2, "vector3": 3, "color3": 3}


def number(value):
    return f"{value:.9g}"


def may_pass_straight(node):
    """:returns: whether light may go straight on through this: an interface that bends none, as clear glass of ior 1"""
    category, _, _, inputs = node
    transmits = category == "dielectric_btdf" or "T" in inputs.get("scatter_mode", ("", "", "R"))[2]
    _, source, value = inputs.get("ior", ("", "", "1.5"))
    return category in ("dielectric_bsdf", "dielectric_btdf") and transmits and (bool(source) or float(value) == 1.0)


def over(top, base):
    """:returns: bound of the albedo of a layer that takes the mean of the top's channels from each channel of the base. A
    channel of the top that reflects x leaves 1 - x / 3 of the base where the others reflect nothing"""
    return max(base, top + max(1.0 - top / 3.0, 0.0) * base)


class Graph:
    """The text of one material, and what its albedo may be at most.

    bound: largest colour that any lobe may reach, added up where closures are added; infinite where colours are huge.
    averages: the same of each closure, by the name of its node, where a layer takes the mean of its three channels from all
        of them (the method layerTransmittance=average).
    loses: normals are mapped, so that light may be lost below the horizon.
    thin: light may pass straight through; how much the lobes count then hangs on the direction.
    layered: a closure lies over another one.
    ward: the albedo of Ward's lobe is that of an isotropic one.
    """

    def __init__(self, seed, variant=0, prefix=""):
        """:param variant: other than 0: the same nodes with other numbers, so that the text of their shader stays the same
        where no number is folded away
        :param prefix: of the names of nodes, so that a document can hold several graphs
        """
        self.random = random.Random(seed)
        self.more = random.Random(f"more {seed}")  # of its own, so that what else a seed means stays
        self.others = random.Random(f"variant {variant} of {seed}") if variant else None
        self.seed, self.variant, self.prefix = seed, variant, prefix
        self.nodes = []  # category, type, name, and inputs: name -> (type, name of a node or '', value)
        self.kinds = []  # categories of closures in it
        self.count = 0
        self.loses = self.thin = self.layered = False
        self.averages = {}
        surface = {}
        bsdf, self.bound = self.bsdf(self.random.randint(1, 4))
        self.root = bsdf
        surface["bsdf"] = ("BSDF", bsdf, "")
        if self.random.random() < 0.25:
            surface["edf"] = ("EDF", self.edf(2), "")
        if self.random.random() < 0.2:
            surface["opacity"] = self.value("float", 0, 1)
        if self.random.random() < 0.2:
            surface["thin_walled"] = ("boolean", "", "true")
            self.thin = True
        self.thin |= any(map(may_pass_straight, self.nodes))
        name = self.node("surface", "surfaceshader", surface)
        self.node("surfacematerial", "material", {"surfaceshader": ("surfaceshader", name, "")})

    def text(self):
        return document(self.nodes)

    def node(self, category, kind, inputs):
        """:param inputs: name -> (type, name of a node or '', value)"""
        name = f"{self.prefix}n{self.count}" if kind != "material" else f"{self.prefix}graph{self.seed}"
        self.count += 1
        self.nodes.append((category, kind, name, inputs))
        return name

    @property
    def ward(self):
        return "patina_ward_bsdf" in self.kinds

    # Values ---------------------------------------------------------------------------------------------------------

    def literal(self, kind, low, high, extremes=EXTREMES):
        chance = self.random.random()
        same = self.random.random() < 0.5
        def one():
            return self.random.choice(extremes) if chance < 0.4 else self.random.uniform(low, high)
        values = [one()] * SIZES[kind] if same else [one() for _ in range(SIZES[kind])]
        return [self.other(value, low, high, extremes) for value in values] if self.others else values

    def other(self, value, low, high, extremes):
        """:returns: a number in place of `value`. What graphs fold away or branch on, 0 and 1, stays"""
        if value in (0.0, 1.0):
            return value
        if self.others.random() < 0.4:
            return self.others.choice([extreme for extreme in extremes if extreme not in (0.0, 1.0)])
        return self.others.uniform(low, high)

    def value(self, kind, low, high):
        """:returns: an input of a number: written, or connected to a pattern"""
        if self.random.random() < 0.85:
            return (kind, "", ", ".join(map(number, self.literal(kind, low, high))))
        return (kind, self.pattern(kind, low, high), "")

    def pattern(self, kind, low, high):
        written = lambda: (kind, "", ", ".join(map(number, self.literal(kind, low, high))))
        choice = self.random.randrange(5)
        if choice == 0:  # no number: infinity less itself, folded when compiling, or found while shading
            huge = (kind, "", ", ".join(["3e38"] * SIZES[kind]))
            if kind == "vector3" and self.random.random() < 0.7:
                huge = (kind, self.node("add", kind, {"in1": ("vector3", self.node("position", kind, {}), ""), "in2": huge}),
                        "")
            infinite = (kind, self.node("multiply", kind, {"in1": huge, "in2": huge}), "")
            if self.random.random() < 0.25:
                return infinite[1]
            return self.node("subtract", kind, {"in1": infinite, "in2": infinite})
        if choice == 1:
            return self.node("mix", kind, {"fg": written(), "bg": written(), "mix": ("float", "", "0.5")})
        if choice == 2:
            return self.node("multiply", kind, {"in1": written(), "in2": written()})
        if choice == 3 and kind in ("float", "vector3"):
            return self.node("noise3d", kind, {"amplitude": (kind, "", ", ".join(["1"] * SIZES[kind]))})
        return self.node("clamp", kind, {"in": written()})

    def color(self):
        """:returns: an input, and the largest channel that it may mean"""
        if self.random.random() < 0.08:
            return ("color3", self.pattern("color3", 0, 1), ""), float("inf")
        values = self.literal("color3", 0, 1, HUGE_COLORS if self.random.random() < 0.1 else COLOR_EXTREMES)
        return ("color3", "", ", ".join(map(number, values))), max(1.0, *values)

    def direction(self, along):
        """Normals and tangents: slanted, below the horizon, zero, parallel to the normal, no numbers."""
        chance = self.random.random()
        self.loses |= along == "normal"
        if chance < 0.12:
            return ("vector3", self.pattern("vector3", -1, 1), "")
        fixed = {"normal": ((0, 0, 1), (0, 0, 0), (0, 0, -1), (1, 0, 0), (0.9, 0, 0.1), (0.5, 0.5, -0.2), (1e-20, 0, 0)),
                 "tangent": ((1, 0, 0), (0, 0, 0), (0, 0, 1), (0, 0, -1), (1e-20, 0, 0), (0, 1, 1e-9), (1e30, 0, 0))}
        if chance < 0.6:
            return ("vector3", "", ", ".join(map(number, self.random.choice(fixed[along]))))
        slant = [self.random.gauss(0, 0.4) for _ in range(3)]
        slant[2 if along == "normal" else 0] += 1.0
        return ("vector3", "", ", ".join(map(number, slant)))

    def inputs(self, table):
        """:returns: inputs of a leaf (each is left out half of the time), and the largest colour among them"""
        found, bound = {}, 1.0
        flat = {k: v for name, spec in table.items() for k, v in (MICROFACET if name == "microfacet" else {name: spec}).items()}
        for name, spec in flat.items():
            if self.random.random() < 0.4:
                continue
            if spec == "unit":
                found[name] = self.value("float", 0, 1)
            elif spec == "color":
                found[name], largest = self.color()
                bound = max(bound, largest)
            elif spec in ("normal", "tangent"):
                if self.random.random() < 0.4:
                    found[name] = self.direction(spec)
            elif spec == "boolean":
                found[name] = ("boolean", "", self.random.choice(("true", "false")))
            elif spec == "mode":
                found[name] = ("string", "", self.random.choice(("R", "T", "RT")))
            elif isinstance(spec[1], str):
                found[name] = ("string", "", self.random.choice(spec))
            else:
                found[name] = self.value(*spec)
            if name == "ior" and spec[0] == "float" and self.more.random() < 0.3:
                found[name] = ("float", self.dispersed(found[name]), "")
        return found, bound

    def dispersed(self, ior):
        self.kinds.append("patina_dispersed_ior")
        given = {"abbe_number": (20.0, 55.0, *EXTREMES), "scale": (0.5, *EXTREMES)}
        return self.node("patina_dispersed_ior", "float", {"ior": ior, **{
            name: ("float", "", number(self.more.choice(values))) for name, values in given.items()}})

    # Closures -------------------------------------------------------------------------------------------------------

    def leaf(self, table, kind):
        category = self.random.choice(list(table))
        inputs, bound = self.inputs(table[category])
        if category == "dielectric_bsdf" and self.more.random() < 0.2:
            category = "dielectric_btdf"
        self.kinds.append(category)
        if inputs.get("form", ("", "", ""))[2] == "exact":
            bound = float("inf")  # Ward's exact form, as it was printed
        if category == "burley_diffuse_bsdf":
            bound *= BURLEY_GAIN
        name = self.node(category, kind, inputs)
        self.averages[name] = bound
        return name, bound

    def expect(self, methods):
        """Sets the bound that the albedo has with these methods."""
        if methods.get("layerTransmittance") == "average":
            self.bound = max(self.bound, self.averages[self.root])

    def closure(self, category, inputs, bound, average):
        """:returns: name of the node, and the bound of its albedo"""
        name = self.node(category, "BSDF", inputs)
        self.averages[name] = average
        return name, bound

    def bsdf(self, depth):
        """:returns: name of the node, and the bound of its albedo"""
        chance = self.random.random()
        if depth <= 1 or chance < 0.15:
            return self.leaf(BSDFS, "BSDF")
        a, bound = self.bsdf(depth - 1)
        first = ("BSDF", a, "")
        if chance < 0.3:
            if self.random.random() < 0.5:
                by = self.value("float", 0, 1)
            else:
                by, _ = self.color()
            values = [float(x) for x in by[2].split(",")] if by[2] else [float("inf")]
            gain = max(1.0, *values)
            return self.closure("multiply", {"in1": first, "in2": by}, bound * gain, self.averages[a] * gain)
        if chance < 0.38:
            self.layered = True
            return self.closure("layer", {"top": first, "base": ("VDF", self.vdf(2), "")}, bound, self.averages[a])
        b, other = self.bsdf(depth - 1)
        second = ("BSDF", b, "")
        top, base = self.averages[a], self.averages[b]
        if chance < 0.68:
            self.layered = True
            if self.more.random() < 0.1:
                first, top = ("BSDF", self.filmed(first), ""), over(1.0, top)
            return self.closure("layer", {"top": first, "base": second}, max(bound, other), over(top, base))
        if chance < 0.85:
            return self.closure("mix", {"fg": first, "bg": second, "mix": self.value("float", 0, 1)}, max(bound, other),
                                max(top, base))
        return self.closure("add", {"in1": first, "in2": second}, bound + other, top + base)

    def filmed(self, base):
        """:returns: a thin film over a closure, as the older layered node has it"""
        self.kinds.append("thin_film_bsdf")
        film = self.node("thin_film_bsdf", "BSDF", {
            name: ("float", "", number(self.more.choice(values)))
            for name, values in (("thickness", (300.0, 550.0, *EXTREMES)), ("ior", (1.3, 2.0, *EXTREMES)))})
        return self.node("layer", "BSDF", {"top": ("BSDF", film, ""), "base": base})

    def edf(self, depth):
        if depth <= 1 or self.random.random() < 0.5:
            return self.leaf(EDFS, "EDF")[0]
        first, second = ("EDF", self.edf(depth - 1), ""), ("EDF", self.edf(depth - 1), "")
        if self.random.random() < 0.5:
            return self.node("add", "EDF", {"in1": first, "in2": second})
        return self.node("mix", "EDF", {"fg": first, "bg": second, "mix": self.value("float", 0, 1)})

    def vdf(self, depth):
        if depth <= 1 or self.random.random() < 0.6:
            return self.leaf(VDFS, "VDF")[0]
        first, second = ("VDF", self.vdf(depth - 1), ""), ("VDF", self.vdf(depth - 1), "")
        return self.node("mix", "VDF", {"fg": first, "bg": second, "mix": self.value("float", 0, 1)})


def document(nodes):
    """:param nodes: of one graph or of several, as Graph has them
    :returns: the text
    """
    lines = ['<?xml version="1.0"?>', '<materialx version="1.39">']
    for category, kind, name, inputs in nodes:
        lines.append(f'  <{category} name="{name}" type="{kind}">')
        for key, (type_, source, value) in inputs.items():
            given = f'nodename="{source}"' if source else f'value="{value}"'
            lines.append(f'    <input name="{key}" type="{type_}" {given}/>')
        lines.append(f"  </{category}>")
    return "\n".join([*lines, "</materialx>", ""])


def methods(seed, points, slow=1.0):
    """Methods forced for one graph in three: about a quarter of the choice points, at random.

    :param points: choice points as _patina.choice_points() gives them
    :param slow: the share of methods in SLOW that are kept; the others give way to the default
    """
    generator = random.Random(seed * 7919 + 1)
    if generator.random() > 0.33:
        return {}
    chosen = {point: generator.choice(names)[0] for point, names in points if generator.random() < 0.25}
    return {point: name for point, name in chosen.items() if (point, name) not in SLOW or generator.random() < slow}
