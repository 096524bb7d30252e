# SPDX-License-Identifier: Apache-2.0
"""The walk over a stage: finds what is to be drawn, each prototype once.

Native instances stay instances. Prims of a prototype are walked once for each set of things that they inherit from outside
and that change what is drawn (material, purpose, draw mode, marks). Primvars are values of the instances.
"""
from dataclasses import replace

from pxr import Sdf, Usd, UsdGeom, UsdLux

from patina import limits

from . import coordSystems, drawModes, marks, portals, skeletons
from .context import Guard, get, targets
from .instanceValues import InstanceValues
from .kinds import GPRIM_KINDS, Kinds
from .levels import Levels, is_root
from .renderPass import RenderPass
from .skinning import is_bound, skinning_of
from .state import Found, Group, State, Walked

_ANY = Usd.PrimIsActive & Usd.PrimIsLoaded  # prototypes of point instancers may be overs and classes
_PURPOSES = ("default", "render", "proxy", "guide")
MAX_NESTED = 8  # point instancers in each other, as many as renderers follow
_COUNTED = {"prims": "prims of a kind", "instances": "instances"}  # by limits
_PROXIES = Usd.TraverseInstanceProxies()


class Walk:
    def __init__(self, context, bindings, linking):
        self.context, self.bindings, self.linking = context, bindings, linking
        self.walked = Walked(InstanceValues(context))
        self._kinds = Kinds()
        self._levels = Levels(context)
        self._pass = RenderPass(context.stage, context.options.render_pass) if context.options.render_pass else None
        self._pending = []  # native instances whose prototype is not chosen yet
        self._instancers = []  # the items of walked.instancers whose prototypes are not chosen yet
        self._todo = []  # (prims, their states, predicate)
        self._native = {}  # what prims of a prototype inherit -> group
        self._pointed = {}  # (prototype of a point instancer, group that it stands in) -> name of its group
        self._above = {}  # states of prims above such prototypes
        self._shown = {}  # path below an instancer -> how many prototypes that lie outside of it have that name
        self._outsides = {}  # path of a native prototype -> see _outside()
        self._held = {}  # path of a native prototype -> see _holds()
        self._layers = set(context.stage.GetLayerStack())
        self._nested = 0  # of these, those inside of others
        self._told = False  # that there are too many
        self._most = {name: limits.value(name) for name in ("prims", "instances")}
        self._full = set()  # names of those that are reached
        self._instances = 0  # native ones that were found

    def run(self):
        """:returns: Walked"""
        root = self.context.stage.GetPseudoRoot()
        children = root.GetChildren()
        self._walk(children, [State()] * len(children), Usd.PrimDefaultPredicate)
        self.linking.foresee([found.prim for found in self._pending], self._roots())
        self._place_prototypes()
        while self._todo or self._pending:
            while self._todo:
                self._walk(*self._todo.pop())
                self._place_prototypes()
            self._place_instances()
        self._drop_empty()
        return self.walked

    def _roots(self):
        """:returns: list of the prototypes of the point instancers that wait for theirs"""
        paths = dict.fromkeys(path for found, _ in self._instancers for path in targets(found.prim, "prototypes"))
        return [root for root in map(self.context.stage.GetPrimAtPath, paths) if root]

    def _walk(self, prims, states, predicate):
        stack = list(zip(reversed(prims), reversed(states)))
        while stack:
            prim, state = stack.pop()
            if self._full and state.group.name:
                return  # the stage itself is walked to its end, prototypes are as many as there are ways to inherit
            with Guard(self.context, prim):
                state = self._visit(prim, state)
            if state is not None:
                children = prim.GetFilteredChildren(_PROXIES if prim.IsInstance() or prim.IsInstanceProxy() else predicate)
                if children:
                    stack.extend(zip(reversed(children), reversed(self._states(prim, state.group, children, state))))

    def _states(self, prim, group, children, state):
        """:param group: that the prim is in; its children are in that of the state
        :returns: list of the states that children begin with: of levels of detail only those that are chosen are seen"""
        if state.hidden or not is_root(prim):
            return [state] * len(children)
        shown = self._levels.shown(prim, group)
        return [state.with_(level=child.GetPath()) if child.GetName() in shown else state.with_(hidden=True)
                for child in children]

    def _visit(self, prim, state):
        """:returns: the state of the prim's children, None when they are not walked"""
        kind, imageable = self._kinds.of(prim)
        if state.hidden:
            if kind == "camera":
                self._camera(prim, state)
            self.walked.dark = self.walked.dark or self._holds_lights(prim, kind)
            return state
        names = prim.GetAuthoredPropertyNames() if imageable else ()
        if ("visibility" in names and prim.GetPath() != state.level
                and get(prim, "visibility", self.context.time) == "invisible"):
            return self._visit(prim, state.with_(hidden=True))
        state, stands_for_all = self._inherit(prim, state, names)
        if stands_for_all:
            if self._drawn(state):
                self._add(prim, state, names, self.walked.boxes)
            return None
        if kind == "instancer":
            path = state.group.path(prim)
            state = self._pass.state_of(path, state) if self._pass else state
            if state and self._has_room(prim, state, self.walked.instancers):
                self._instancers.append((Found(prim, state, path, names), []))
                self.walked.instancers.append(self._instancers[-1])
            return None
        if kind == "skelRoot":
            state = state.with_(skinning=skinning_of(self.context, prim))
        elif kind == "camera":
            self._camera(prim, state)
        elif kind == "light":
            found = self._add(prim, state, names, self.walked.lights)
            if found:
                self.linking.add(found)
        elif kind == "unsupported" and not portals.is_used(self.context, prim):
            self.context.warn(state.group.path(prim), "", "typeNotDrawn", prim.GetTypeName())
        elif kind in GPRIM_KINDS:
            shown = state.with_(purpose=skeletons.purpose_of(prim, state.purpose)) if kind == "skeleton" else state
            found = self._add(prim, shown, names, self.walked.gprims) if self._drawn(shown) else None
            if found and prim.HasAPI(UsdLux.LightAPI):
                self._light_by_api(found, kind)
            if prim.IsInstance():
                return None
        elif kind is None and imageable and prim.HasAPI(UsdLux.LightAPI):
            self._light_by_api(Found(prim, state, state.group.path(prim)), kind)
        # What is skinned, or stands in the world, differs from instance to instance.
        if prim.IsInstance() and state.skinning is None and not self._stands_apart(prim):
            if self._has_room(prim, state, range(self._instances), "instances"):
                self._instances += 1
                self._pending.append(Found(prim, state, state.group.path(prim), names))
            return None
        return state

    def _inherit(self, prim, state, names):
        """:param names: of the prim's authored properties where it is imageable
        :returns: (state of the prim and of what is below it, whether it stands for all of that by its draw mode)"""
        if "purpose" in names:
            purpose = get(prim, "purpose", self.context.time) or state.purpose
            if purpose not in _PURPOSES and purpose not in self.context.purposes:
                self.context.warn(prim.GetPath(), "purpose", "purposeUnknown", purpose)
            state = state.with_(purpose=purpose)
        if any(name.startswith("primvars:") for name in names):
            api = UsdGeom.PrimvarsAPI(prim)
            inherited = api.FindIncrementallyInheritablePrimvars(state.primvars)
            # pxr returns an empty list for "as above" and for "none is left"
            if inherited or any(api.GetPrimvar(above.GetPrimvarName()).HasAuthoredValue() for above in state.primvars):
                state = state.with_(primvars=tuple(inherited))
            found_marks = marks.authored(self.context, prim, names, state.marks)
            if found_marks is not state.marks:
                state = state.with_(marks=found_marks)
        if any(name.startswith("coordSys:") for name in names):
            state = state.with_(spaces=coordSystems.authored(prim, names, state.spaces))
        if not prim.IsModel():
            return state, False
        asset = marks.asset(prim, state.group.path(prim), state.asset)
        mode, applied = drawModes.of(prim, state.draw_mode)
        if (asset, mode) != (state.asset, state.draw_mode):
            state = state.with_(asset=asset, draw_mode=mode)
        return state, applied

    def _drawn(self, state):
        return state.purpose in self.context.purposes

    def _add(self, prim, state, names, found):
        """Adds a prim to what was found of a kind, if there is room, and the pass has it.

        :returns: Found, or None"""
        path = state.group.path(prim)
        state = self._pass.state_of(path, state) if self._pass else state
        if state and self._has_room(prim, state, found):
            found.append(Found(prim, state, path, names))
            return found[-1]
        self.walked.dark |= state is None and found is self.walked.lights
        return None

    def _holds_lights(self, prim, kind):
        if prim.IsInstance():
            return bool(self.linking.lights_below(prim.GetPrototype()))
        return kind == "light" or kind == "mesh" and prim.HasAPI(UsdLux.MeshLightAPI)

    def _light_by_api(self, found, kind):
        """:param found: prim that is no light by its type and has the LightAPI"""
        if kind == "mesh" and found.prim.HasAPI(UsdLux.MeshLightAPI):
            self.walked.mesh_lights.append(found)
            self.linking.add(found)
        elif kind != "volume" or not found.prim.HasAPI(UsdLux.VolumeLightAPI):
            type_ = found.prim.GetTypeName()
            self.context.warn(found.path, "apiSchemas", "inputIgnored", f"LightAPI on a prim of type {type_}")

    def _has_room(self, prim, state, found, limit="prims"):
        """:param found: what there is of a kind
        :returns: whether there may be one more; tells of the first that there may not"""
        most = self._most[limit]
        if len(found) < most:
            return True
        if limit not in self._full:
            self.context.warn(state.group.path(prim), "", "primsTooMany", _COUNTED[limit], f"{most} (--limit {limit})")
        self._full.add(limit)
        return False

    def _camera(self, prim, state):
        if state.group.name:
            self.walked.inner_cameras.add(prim.GetName())
        elif self._has_room(prim, state, self.walked.cameras):
            self.walked.cameras.append(Found(prim, state, str(prim.GetPath())))

    def _place_instances(self):
        """Chooses the group of each native instance; new groups are walked next."""
        pending, self._pending = self._pending, []
        all_bound = self.bindings.compute([found.prim for found in pending], [found.state.group for found in pending])
        for found, bound in zip(pending, all_bound):
            state, outer = found.state, found.state.group
            prototype = found.prim.GetPrototype()
            binding, parts = self.bindings.keys_of(found, bound)
            apart = self._apart(prototype, outer)
            split, links = self.walked.values.split(state.primvars), self.linking.signature(found, [at for at, _ in apart])
            found.names = ()  # there may be a million instances
            key = (str(prototype.GetPath()), binding, parts, state.purpose, state.draw_mode,
                   tuple(sorted(state.marks.items())), state.spaces, split.key,
                   outer.name if any(inside for _, inside in apart) else "",
                   self._levels.signature(found.prim, outer),
                   self._pass.signature(found.path, bool(apart)) if self._pass else "", links)
            group = self._native.get(key)
            if group is None:
                if not self._has_room(found.prim, state, self._native):
                    continue
                above = state.with_(primvars=split.copied, asset="")
                group = Group(name=found.path, anchor=prototype, source=str(prototype.GetPath()),
                              shown=found.path, bound=bound, divided=parts is not None,
                              native=(str(prototype.GetPath()), outer.on_stage(found.prim)), instancer=outer.instancer,
                              place=self._levels.place_inside(found.prim, outer),
                              chain=outer.chain, above=above, outer=outer, arcs=self._arcs(found.prim))
                self._native[key] = group
                if links:
                    self.linking.split.add(group.name)
                children = prototype.GetChildren()
                states = self._states(found.prim, outer, children, above.with_(group=group))
                self._todo.append((children, states, Usd.PrimDefaultPredicate))
            self.walked.instances.setdefault((outer.name, group.name, split.signature), []).append(found)

    def _arcs(self, instance):
        """:returns: paths of the stage that a native instance is made of"""
        return tuple(spec.path for spec in instance.GetPrimStack() if spec.layer in self._layers)

    def _place_prototypes(self):
        """Chooses the groups of the prototypes of point instancers; new ones are walked next."""
        pending, self._instancers = self._instancers, []
        for found, names in pending:
            with Guard(self.context, found.prim):
                for index, target in enumerate(targets(found.prim, "prototypes")):
                    names.append(self._prototype(found, target, f"{found.path}[{index}]"))

    def _prototype(self, found, target, name):
        """:param found: point instancer
        :returns: the name of the group of one of its prototypes"""
        instancer, outer = found.prim, found.state.group
        root = self.context.stage.GetPrimAtPath(target)
        if not root or not root.IsActive():
            self.context.warn(instancer.GetPath(), "prototypes", "prototypeNotFound", target)
            return name
        root, home = not root.IsInPrototype() and self._around(root, outer.outer) or (root, outer)
        target = root.GetPath()
        if instancer.GetPath().HasPrefix(target) or str(target) in outer.chain:
            self.context.warn(instancer.GetPath(), "prototypes", "prototypeHoldsItself", target)
            return name
        home = home if root.IsInPrototype() else Group()
        place = Sdf.Path(home.on_stage(root))
        roots = place, *(at for at, _ in (self._apart(root, outer) if self.linking.has_links() else ()))
        key = (str(target), outer.name, self.linking.signature_of_root(found, roots))
        if key in self._pointed:
            return self._pointed[key]
        if len(outer.chain) >= MAX_NESTED or outer.chain and self._nested >= limits.value("groups"):
            if not self._told:
                self.context.warn(instancer.GetPath(), "prototypes", "prototypesTooDeep", MAX_NESTED, limits.value("groups"))
            self._told = True
            return name
        self._nested += bool(outer.chain)
        self._pointed[key] = name
        self.linking.roots[name] = roots
        inside = root.GetPath().HasPrefix(instancer.GetPath())
        shown = outer.path(root) if inside else self._shown_below(instancer, root, outer)
        group = Group(name=name, anchor=root.GetParent(), source=str(target), shown=shown, chain=outer.chain + (str(target),),
                      outer=outer, place=self._levels.nearest_place(instancer, outer, root), instancer=(found, place))
        if root.IsInPrototype():  # of a native instance that the instancer is in
            group = replace(group, bound=home.bound, divided=home.divided, native=home.native, above=home.above)
        concrete = root.IsDefined() and not root.IsAbstract()
        self._todo.append(([root], [self._state_above(root, group.above).with_(group=group, asset="")],
                           Usd.PrimDefaultPredicate if concrete else _ANY))
        return name

    def _shown_below(self, instancer, root, outer):
        """:returns: a path that stands for a prototype elsewhere; prims of several may have the same names"""
        path = f"{outer.path(instancer)}/{root.GetName()}"
        number = self._shown.get(path, 1 if instancer.GetChild(root.GetName()) else 0)
        self._shown[path] = number + 1
        return f"{path}[{number}]" if number else path

    def _apart(self, prototype, outer):
        """:param outer: group that an instance of the prototype stands in
        :returns: for each prim of _outside() (its path on the stage, whether it lies in an instance around)"""
        found = [(root, self._around(root, outer)) for root in self._outside(prototype)]
        return [(Sdf.Path(around[1].on_stage(around[0])) if around else root.GetPath(), bool(around)) for root, around in found]

    def _outside(self, prototype):
        """:param prototype: native, or one of a point instancer
        :returns: prims in no native prototype that point instancers below draw, and those below what these draw"""
        path = prototype.GetPath()
        if path not in self._outsides:
            roots, todo, seen = {}, [prototype], set()
            while todo:
                found = todo.pop()
                found = found.GetPrimInPrototype() if found.IsInstanceProxy() else found
                if found.GetPath() in seen:
                    continue
                seen.add(found.GetPath())
                for prim in Usd.PrimRange(found, Usd.PrimDefaultPredicate if found.IsPrototype() else _ANY):
                    if prim.IsInstance():
                        todo.append(prim.GetPrototype())
                    elif self._kinds.of(prim)[0] == "instancer":
                        drawn = {at: self.context.stage.GetPrimAtPath(at) for at in targets(prim, "prototypes")}
                        roots.update(drawn)
                        todo += filter(None, drawn.values())
            self._outsides[path] = [root for root in roots.values() if root and not root.IsInPrototype()]
        return self._outsides[path]

    def _stands_apart(self, instance):
        """:returns: whether a native instance cannot be drawn as others of its prototype"""
        fixed, skinned = self._holds(instance.GetPrototype())
        return fixed or skinned and is_bound(instance)

    def _holds(self, prototype):
        """:returns: (whether there is a prim below a native prototype that no transform above moves, whether a SkelRoot)"""
        path = prototype.GetPath()
        if path not in self._held:
            fixed = skinned = False
            for prim in Usd.PrimRange(prototype):
                inner = self._holds(prim.GetPrototype()) if prim.IsInstance() else (False, False)
                placed = UsdGeom.Xformable(prim)
                fixed |= inner[0] or bool(placed and placed.GetResetXformStack())
                skinned |= inner[1] or self._kinds.of(prim)[0] == "skelRoot"
            self._held[path] = fixed, skinned
        return self._held[path]

    def _around(self, root, home):
        """OpenUSD names a target in an instance around the instancer's own by one of the places that share the prototype, by
        chance: one of the instances, or what these are made of.

        :param root: prim of a target; home: group to begin at
        :returns: (the prim that stands for it in all of these instances, the group of the one around), or None"""
        shared = root.GetPrimInPrototype() if root.IsInstanceProxy() else None
        while home is not None and home.name:
            if shared and shared.GetPath().HasPrefix(home.source):
                return shared, home
            for made_of in home.arcs if not shared else ():
                if root.GetPath().HasPrefix(made_of):
                    inside = self.context.stage.GetPrimAtPath(root.GetPath().ReplacePrefix(made_of, home.source))
                    if inside:
                        return inside, home
            home = home.outer
        return None

    def _state_above(self, prim, root_state):
        """What a prototype of a point instancer inherits by namespace, wherever its instancer stands. Prims above may be
        invisible, as in Hydra: that is how many hide prototypes.

        :param root_state: of the native prototype that holds it, None for the world"""
        chain, state, prim = [], root_state or State(), prim.GetParent()
        while not prim.IsPseudoRoot() and not prim.IsPrototype():
            known = self._above.get((prim.GetPath(), id(root_state)))
            if known is not None:
                state = known
                break
            chain.append(prim)
            prim = prim.GetParent()
        for prim in reversed(chain):
            kind, imageable = self._kinds.of(prim)
            state, _ = self._inherit(prim, state, prim.GetAuthoredPropertyNames() if imageable else ())
            if kind == "skelRoot":
                state = state.with_(skinning=skinning_of(self.context, prim))
            self._above[prim.GetPath(), id(root_state)] = state
        return state

    def _drop_empty(self):
        """Leaves out instancers of which nothing is drawn: prototypes have purposes of their own."""
        holders = {}  # group -> those that hold instances of it
        for found, names in self.walked.instancers:
            for name in names:
                holders.setdefault(name, set()).add(found.state.group.name)
        for outer, name, _ in self.walked.instances:
            holders.setdefault(name, set()).add(outer)
        filled = {f.state.group.name for f in (*self.walked.gprims, *self.walked.lights, *self.walked.boxes)}
        waiting = list(filled)
        while waiting:
            more = holders.get(waiting.pop(), set()) - filled
            filled |= more
            waiting += more
        self.walked.instancers = [item for item in self.walked.instancers if filled.intersection(item[1])]
