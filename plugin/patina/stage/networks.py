# SPDX-License-Identifier: Apache-2.0
"""UsdShade networks -> `_patina.Network`."""
import _patina
import numpy as np
from pxr import Sdf, Tf, UsdShade

from patina import inputs

from . import assets, mtlxFiles

_TERMINALS = (("surface", "ComputeSurfaceSource"), ("displacement", "ComputeDisplacementSource"),
              ("volume", "ComputeVolumeSource"))
_CONTEXT = "mtlx"  # preferred to the universal terminals, which pxr falls back to by itself
_CLOCKS = ("ND_frame_float", "ND_time_float")
_TEXT = ("string", "token", "asset")


def network_of(context, material, path):
    """:param path: of the material in the scene
    :returns: its Network; without terminals when it has none that can be used"""
    document = mtlxFiles.network_of(material)
    if document is None:
        network = _Translation(context, material.GetPrim(), path).of_material(material)
    else:
        network = document
        inputs.note_network(document)
    _set_frame(network, context)
    return network


def network_of_light(context, light, path):
    """:param light: prim
    :returns: the Network of nodes that its inputs are connected to, each a terminal of the input's name"""
    network = _Translation(context, light, path).of_inputs()
    _set_frame(network, context)
    return network


def _set_frame(network, context):
    """MaterialX's nodes for the frame and the time have it from the host."""
    for node in network.nodes():
        if node["id"] in _CLOCKS and not context.time.IsDefault():
            network.set_input(node["path"], "frame", "float", context.time.GetValue())
            if node["id"] == "ND_time_float" and "fps" not in node["inputs"]:
                network.set_input(node["path"], "fps", "float", context.time_codes_per_second)


class _Translation:
    def __init__(self, context, prim, path):
        """:param prim: Material or light"""
        self.context, self.prim = context, prim
        self.source, self.shown = str(prim.GetPath()), path
        self.network = _patina.Network(path)
        self._names = {}  # path on the stage -> path in the network
        self._todo = []

    def of_inputs(self):
        for input_ in UsdShade.ConnectableAPI(self.prim).GetInputs(onlyAuthored=True):
            source = self._source(input_)[0]
            self._terminal(input_.GetBaseName(), *(source or (None, None)))
        return self._followed()

    def of_material(self, material):
        for terminal, compute in _TERMINALS:
            shader, output, _ = getattr(material, compute)(_CONTEXT)
            self._terminal(terminal, shader, shader and self._known_output(shader, terminal, output))
        self._light_shader(material)
        self._followed()
        if self.network.empty:
            others = sorted(o.GetFullName() for o in material.GetOutputs() if o.HasConnectedSource())
            told = ("materialHasOthers", ", ".join(others)) if others else ("materialNotShown",)
            self._warn(self.prim, "", *told)
        return self.network

    def _light_shader(self, material):
        """A MaterialX light that is attached to geometry makes it shine."""
        for name in ("mtlx:light", "light"):
            output = material.GetOutput(name)
            sources = UsdShade.Utils.GetValueProducingAttributes(output, True) if output else []
            if sources and "surface" not in self.network.terminals():
                self._terminal("surface", UsdShade.Shader(sources[0].GetPrim()), "out")
            elif sources:
                self._warn(self.prim, output.GetFullName(), "materialLightIgnored")

    def _terminal(self, name, shader, output):
        node = self._node(shader) if shader else None
        if node:
            self.network.set_terminal(name, node, output)

    def _followed(self):
        """:returns: the network with all that its terminals are connected to"""
        while self._todo:
            self._inputs(*self._todo.pop())
        if not self.network.empty and _is_before_139(self.prim):
            self.context.repeat(self.network.upgrade())
        return self.network

    def _known_output(self, shader, terminal, output):
        """:returns: the output of a terminal's node; of one with another name the node's output for the terminal, or its first:
            Hydra does not tell renderers which output it is"""
        definition = _patina.node_definition(shader.GetShaderId() or "")
        names = [name for name, _ in definition["outputs"]] if definition else []
        return output if output in names or not names else terminal if terminal in names else names[0]

    def _warn(self, prim, input_, id_, *fields):
        self.context.warn(prim.GetPath(), input_, id_, *fields)

    def _node(self, shader):
        """:returns: path of the shader's node in the network, None when it has no id"""
        prim = shader.GetPrim()
        path = str(prim.GetPath())
        if path in self._names:
            return self._names[path]
        name = path
        if path.startswith(self.source + "/"):
            name = self.shown + path[len(self.source):]
        self._names[path] = name
        identifier = shader.GetShaderId() or ""
        if not identifier:
            source = shader.GetImplementationSource()
            if source == UsdShade.Tokens.id:
                self._warn(prim, "info:id", "shaderWithoutId")
            else:
                self._warn(prim, "info:implementationSource", "shaderSourceUnusable", source)
            self._names[path] = None
            return None
        self.network.add_node(name, identifier)
        self._todo.append((shader, name))
        return name

    def _inputs(self, shader, node):
        for input_ in shader.GetInputs():
            name = input_.GetBaseName()
            connected, attribute = self._source(input_)
            if connected:
                source = self._node(connected[0])
                if source:
                    self.network.connect(node, name, source, connected[1])
                    continue
            if attribute:
                self._value(node, name, attribute, shader.GetPrim())

    def _source(self, input_):
        """:returns: ((shader, output), attribute): the one that gives the value, or the other, or none"""
        own = input_.GetAttr()
        if own.HasAuthoredConnections():
            self._check(input_)
        sources = UsdShade.Utils.GetValueProducingAttributes(input_)
        if not sources:
            return None, own if own.HasValue() else None
        name, kind = UsdShade.Utils.GetBaseNameAndType(sources[0].GetName())
        if kind == UsdShade.AttributeType.Output and not UsdShade.ConnectableAPI(sources[0].GetPrim()).IsContainer():
            return (UsdShade.Shader(sources[0].GetPrim()), name), own
        return None, sources[0]

    def _check(self, input_):
        """Tells of connections that lead nowhere: pxr passes over them without a word."""
        def tell(id_, *fields):
            self._warn(input_.GetPrim(), input_.GetBaseName(), id_, *fields)

        port, met = input_, set()
        while port:
            path = port.GetAttr().GetPath()
            if path in met:
                self.context.reported.add("Found cycle with attribute")  # pxr says it without the input
                tell("inputCycle", path)
                return
            met.add(path)
            sources, broken = port.GetConnectedSources()
            if len(sources) > 1:
                tell("inputConnections")
            if not sources:
                if broken:
                    tell("inputSourceMissing", broken[0])
                return
            api, is_output = sources[0].source, sources[0].sourceType == UsdShade.AttributeType.Output
            if is_output and not api.IsContainer():
                return
            name = sources[0].sourceName
            port = api.GetOutput(name) if is_output else api.GetInput(name)
            if not port:
                tell("inputSourceMissing", f"{api.GetPath()}.{name}")

    def _value(self, node, name, attribute, prim):
        type_ = attribute.GetTypeName()
        space = self.context.color_spaces.space_of(attribute, _reads_colors(prim))
        value = attribute.Get(self.context.time)
        if value is None:
            return
        if type_.isArray or isinstance(value, Sdf.UnregisteredValue):  # of a type that USD does not know
            self._warn(prim, name, "valueTypeUnusable", attribute.GetMetadata("typeName"))
            return
        if type_ == Sdf.ValueTypeNames.Asset:
            value = assets.resolve(self.context, attribute)
        elif str(type_) not in _TEXT:
            value = self._in_scene_units(_numbers(value), name, attribute, prim)
        try:
            self.network.set_input(node, name, str(type_), value, space)
        except (ValueError, TypeError) as error:
            self._warn(prim, name, "defaultUsed", error)

    def _in_scene_units(self, value, name, attribute, prim):
        """:returns: the value of an input of a MaterialX node, whose unit importers keep as metadata"""
        identifier = UsdShade.Shader(prim).GetShaderId() or ""
        unit = _unit_of(attribute) if identifier.startswith("ND_") and not isinstance(value, (bool, int)) else ""
        if not unit:
            return value
        factor = _patina.unit_factor(unit, identifier, name, self.context.meters_per_unit)
        if factor is None:
            self._warn(prim, name, "unitUnknown", unit)
        return value if factor is None else value * factor


def _unit_of(attribute):
    """:returns: name of the unit that an attribute's numbers are in; empty when none is authored"""
    unit = attribute.GetCustomDataByKey("unit")
    if isinstance(unit, str):
        return unit
    shown = attribute.GetMetadata("displayUnit") if attribute.HasAuthoredMetadata("displayUnit") else None
    return Sdf.GetNameForUnit(shown) if isinstance(shown, Tf.Enum) else ""


def _is_before_139(prim):
    """:returns: whether a network is of MaterialX 1.38, as those are that do not say otherwise"""
    version = prim.GetAttribute("config:mtlx:version").Get() or "1.38"
    major, _, minor = str(version).partition(".")
    return major == "1" and minor.split(".")[0].isdigit() and int(minor.split(".")[0]) < 39


def _reads_colors(prim):
    """Whether a node of MaterialX gives colours, which images have their colour space for. The values that UsdUVTexture reads
    follows its sourceColorSpace."""
    shader = UsdShade.Shader(prim)
    return (shader.GetShaderId() or "").startswith("ND_") and any(
        str(output.GetTypeName()).startswith("color") for output in shader.GetOutputs())


def _numbers(value):
    if isinstance(value, (bool, int, float)):
        return value
    return np.array(value, dtype=np.float32).reshape(-1)
