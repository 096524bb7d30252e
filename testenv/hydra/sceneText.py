"""Makes the texts of one scene from two hosts comparable.

Taken out, because Hydra does not keep it: the names of prototypes' groups and of prims in them.
"""


def parse(text):
    """:returns: dict of (kind, path) -> list of lines"""
    prims = {}
    current = prims.setdefault(("Scene", "/"), [])
    for line in text.splitlines():
        if line and not line.startswith(" "):
            kind, _, path = line.partition(" ")
            current = prims.setdefault((kind, path), [])
        elif line:
            current.append(line.strip())
    return prims


def difference(found, wanted):
    """:returns: what differs, as text for a person; empty when nothing does"""
    a, b = parse(found), parse(wanted)
    lines = [f"only in Hydra: {kind} {path}" for kind, path in a if (kind, path) not in b]
    lines += [f"missing in Hydra: {kind} {path}" for kind, path in b if (kind, path) not in a]
    for prim in a:
        if prim in b and a[prim] != b[prim]:
            lines.append(f"{prim[0]} {prim[1]}")
            lines += [f"  Hydra:  {line}" for line in a[prim] if line not in b[prim]]
            lines += [f"  reader: {line}" for line in b[prim] if line not in a[prim]]
    return "\n".join(lines[:40])
