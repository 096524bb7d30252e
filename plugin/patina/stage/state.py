# SPDX-License-Identifier: Apache-2.0
"""State that prims inherit on the way down, and the findings of the walk."""
from dataclasses import dataclass, field, replace
from typing import NamedTuple


class Bound(NamedTuple):
    """What is bound to a prim, by itself or by prims above it."""
    material: str = ""  # path in the scene
    rules: bool = False  # it is stronger than what prims below bind ...
    purposed: bool = False  # ... and for the purpose that is asked for, which stands above bindings for all purposes


@dataclass(frozen=True)
class Group:
    """Where prims are placed: the world, or a prototype."""
    name: str = ""  # as the scene calls it
    anchor: object = None  # prim that transforms are relative to; None: the world
    source: str = ""  # path of the prototype's root on the stage ...
    shown: str = ""  # ... and the path that stands for it in the scene
    bound: Bound = Bound()  # to the instance
    divided: bool = False  # collections bind parts of it, so bindings are asked for where its first instance stands
    native: tuple = ("", "")  # native prototype that holds it and where its first instance stands: paths of the stage
    instancer: tuple = field(default=(None, None), compare=False)  # point instancer around it: Found, path of the prototype
    place: object = field(default=None, compare=False)  # of a point instancer's prototype: matrix of its nearest instance
    chain: tuple = ()  # prototypes of point instancers that this one is drawn inside of
    above: object = field(default=None, compare=False)  # state at the root of the native prototype that holds it
    outer: object = field(default=None, compare=False)  # group that it was first found in; None: it is the world
    arcs: tuple = field(default=(), compare=False)  # of a native instance: paths of the stage that it is made of

    def path(self, prim):
        """:returns: the path of a prim in the scene"""
        path = str(prim.GetPath())
        return self.shown + path[len(self.source):] if self.source else path

    def on_stage(self, prim):
        """:returns: the path of a prim on the stage, in the first instance of its native prototype"""
        return self.native[1] + str(prim.GetPath())[len(self.native[0]):]


@dataclass(frozen=True)
class State:
    """What a prim and those below it have: its own or inherited."""
    group: Group = Group()
    purpose: str = "default"
    primvars: tuple = ()  # inheritable ones
    skinning: object = None  # inside a SkelRoot: prim path -> its skinning
    draw_mode: str = "default"
    hidden: bool = False
    level: object = None  # path of a level of detail that is drawn, whatever its own visibility says
    spaces: tuple = ()  # coordinate systems that are bound: (name, path of a prim)
    marks: dict = field(default_factory=dict, compare=False)  # see marks.py
    asset: str = ""  # path of the model that prims belong to, within the group

    def with_(self, **changes):
        return replace(self, **changes)


@dataclass
class Found:
    """A prim that the walk found worth drawing."""
    prim: object
    state: State
    path: str  # in the scene
    names: tuple = ()  # of authored properties: asking for each one's value takes far longer

    def authored(self, name, time):
        """:returns: an attribute's value where one is authored, else None"""
        return self.prim.GetAttribute(name).Get(time) if name in self.names else None

    def has_primvars(self):
        return bool(self.state.primvars) or any(name.startswith("primvars:") for name in self.names)


@dataclass
class Walked:
    """Everything that the walk found, in the stage's order."""
    values: object  # InstanceValues, of native instances
    gprims: list = field(default_factory=list)
    lights: list = field(default_factory=list)
    mesh_lights: list = field(default_factory=list)  # those of gprims that are lights as well
    cameras: list = field(default_factory=list)
    inner_cameras: set = field(default_factory=set)  # names of those inside of prototypes
    instancers: list = field(default_factory=list)  # (Found, group names of the prototypes)
    instances: dict = field(default_factory=dict)  # (group, prototype group, signature of values) -> list of Found
    dark: bool = False  # whether there are lights that are invisible, or that a render pass has not
    boxes: list = field(default_factory=list)  # what stands for its subtree by its state's draw mode
