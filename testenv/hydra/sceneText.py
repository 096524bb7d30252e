# SPDX-License-Identifier: Apache-2.0
"""Makes the texts of one scene from two hosts comparable.

Values that Hydra does not keep are taken out of both:
- instancers and prototypes have names of UsdImaging's making. An instancer counts by what it places where:
  the contents of its groups, each with its transforms in any order (those that the text shows: 64);
- materials inside of prototypes have such names as well, and Hydra lists a network's nodes in an order of its
  own. A material counts by its contents, its nodes sorted;
- categories (light and shadow links) have names of the host's making. A category counts by the lights that use it;
- ids are Hydra's own, and it sorts primvars.
UsdImagingDelegate also turns spheres, cubes and the like into meshes of its own: such shapes then count by their
transform and material, and inside of prototypes, where they have no names, all shapes do.
"""
import difflib

IDENTITY = "1 0 0 0, 0 1 0 0, 0 0 1 0, 0 0 0 1"
GEOMETRY = ("Mesh", "Curves", "Points", "Implicit")
LEFT_OUT = ("ids", "idCounts", "id", "group")


class Scene:
    """A text, taken apart.

    :param shapes: None, or the paths of prims of which only transform and material count"""

    def __init__(self, text, shapes=None):
        self.shapes = shapes
        self.prims = {}  # (kind, path) -> list of lines
        current = self.prims.setdefault(("Scene", "/"), [])
        for line in text.splitlines():
            if line and not line.startswith(" "):
                current = self.prims.setdefault(line.partition(" ")[::2], [])
            elif line:
                current.append(line.strip())
        self.links = {}  # category -> names of the lights that use it
        for (kind, path), lines in self.prims.items():
            for line in lines if kind == "Light" else ():
                name, value = _field(line)
                if name in ("lightLink", "shadowLink"):
                    self.links.setdefault(value.strip('"'), set()).add(f"{name} of {path}")
        self.groups = {}  # group -> list of (kind, path)
        for prim, lines in self.prims.items():
            group = dict(map(_field, lines)).get("group")
            self.groups.setdefault((group or "").strip('"'), []).append(prim)

    def canonical(self):
        """:returns: dict of a prim's name to its text"""
        found, instancers = {}, []
        for prim in self.groups.get("", ()):
            kind, path = prim
            if kind == "Material":
                continue
            text = self._prim(prim, ())
            if kind == "Instancer":
                instancers.append(text)
            else:
                found[f"{self._kind(prim)} {path}"] = text
        for i, text in enumerate(sorted(instancers)):
            found[f"instancer {i}"] = text
        return found

    def _is_plain(self, prim):
        if self.shapes is None or prim[0] not in GEOMETRY:
            return False
        return prim[1] in self.shapes or any(_field(line)[0] == "group" for line in self.prims[prim])

    def _kind(self, prim):
        return "Shape" if self._is_plain(prim) else prim[0]

    def _prim(self, prim, outer):
        kind, path = prim
        lines = self.prims[prim]
        if kind == "Instancer":
            return self._instancer(lines, outer)
        if kind not in GEOMETRY:
            return "\n".join(line if _field(line)[0] not in ("lightLink", "shadowLink") else _field(line)[0]
                             for line in lines if _field(line)[0] not in LEFT_OUT)
        if self._is_plain(prim):
            lines = [line for line in lines if _field(line)[0] in ("transform", "material", "categories")]
        if kind in ("Curves", "Points"):  # nothing culls them
            lines = [line for line in lines if _field(line)[0] != "doubleSided"]
        lines = sorted(line for line in lines if line.startswith("primvar ")) + [
            line for line in lines if not line.startswith("primvar ")]
        return "\n".join(filter(None, map(self._geometry_line, lines)))

    def _geometry_line(self, line):
        name, value = _field(line)
        if name in LEFT_OUT:
            return ""
        if name == "material":
            return "material = " + self._material(value.strip('"'))
        if name.startswith("subset "):
            own, _, material = name[len("subset "):].partition(" material ")
            return f"subset {own.rsplit('/', 1)[-1]} of {self._material(material.strip(chr(34)))} = {value}"
        if name.startswith("categories"):
            used = self._links(value)
            return f"{name} = {used}" if used else ""
        return line

    def _links(self, categories):
        return ", ".join(sorted({user for name in categories.split() for user in self.links.get(name, ())}))

    def _material(self, path):
        lines = self.prims.get(("Material", path))
        if lines is None:
            return "a material that is not there"
        nodes, current = {"": []}, ""
        for line in lines:
            own = line.replace(path, "")
            if own.startswith("node "):
                current = own
            nodes.setdefault(current, []).append(own)
        return "{" + "; ".join(line for name in sorted(nodes) for line in [*nodes[name][:1], *sorted(nodes[name][1:])]) + "}"

    def _instancer(self, lines, outer):
        fields = dict(map(_field, lines))
        groups = fields.get("prototypes", "").split()
        count = int(fields.get("instances", "0"))
        indices = fields.get("prototypeIndices", "").partition(" ...")[0].split()
        placed = {group: [] for group in groups}
        if count <= 16:  # what the text shows of the indices
            for i, index in enumerate(indices):
                links = self._links(fields.get(f"categories {i}", ""))
                placed[groups[int(index)]].append(fields.get(f"transform {i}", IDENTITY) + (f" ({links})" if links else ""))
        parts = []
        for group in groups:
            if group in outer:
                parts.append("an instancer in itself")
                continue
            contents = sorted(self._kind(prim) + "\n" + self._prim(prim, (*outer, group))
                              for prim in self.groups.get(group, ()))
            if contents:
                parts.append("\n".join(["group", *contents, "places", *sorted(placed[group])]))
        rest = [line for line in lines if _field(line)[0].startswith("visibility")]
        return "\n".join([f"instances {count}" if count > 16 else "instances", *rest, *sorted(parts)])


def _field(line):
    name, _, value = line.partition(" = ")
    return name, value


def difference(found, wanted, native_shapes=True):
    """:param found, wanted: texts, of Hydra and of the stage reader
    :param native_shapes: False for UsdImagingDelegate
    :returns: what differs, as text for a person; empty when nothing does"""
    shapes = None if native_shapes else {path for kind, path in Scene(wanted).prims if kind == "Implicit"}
    a, b = Scene(found, shapes).canonical(), Scene(wanted, shapes).canonical()
    lines = [f"only in Hydra: {name}" for name in a if name not in b]
    lines += [f"not in Hydra: {name}" for name in b if name not in a]
    for name in a:
        if name in b and a[name] != b[name]:
            lines.append(f"{name} (- Hydra, + reader)")
            delta = difflib.unified_diff(a[name].splitlines(), b[name].splitlines(), lineterm="", n=0)
            lines += ["  " + line[:400] for line in delta if not line.startswith(("---", "+++", "@@"))]
    return "\n".join(lines[:60])
