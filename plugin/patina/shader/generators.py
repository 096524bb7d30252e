# SPDX-License-Identifier: Apache-2.0
"""Shader text by the generators of MaterialX (PyPI's `materialx`) from a document."""
import importlib
import importlib.util
import re
import xml.etree.ElementTree as tree

from patina import messages

LANGUAGES = {"osl": ("PyMaterialXGenOsl", "OslShaderGenerator"), "mdl": ("PyMaterialXGenMdl", "MdlShaderGenerator"),
             "msl": ("PyMaterialXGenMsl", "MslShaderGenerator")}
UNSAFE = re.compile(r"[\x00-\x1f\x7f\"\\]")  # ends a string literal of some language
COLOR_SPACE = re.compile(r"[A-Za-z0-9_ .:/()+-]*")  # names of colour spaces
NOT_OF_A_WORD = re.compile(r"[^\w:]")  # ends a name in code, which msl makes of a primvar's


class NotGenerated(RuntimeError):
    """The generators have nothing for this document; the message is theirs, in one line."""


def installed():
    """:returns: whether Python finds the package"""
    return importlib.util.find_spec("MaterialX") is not None


def version():
    """:returns: of MaterialX, "1.39.5" """
    return _core().getVersionString()


def problems(text):
    """
    :returns: what MaterialX's own library says against a document, one line for each
    :raises NotGenerated: for a document that it cannot read
    """
    loaded = _document(text)
    _, said = loaded.validate()
    lines = [line for line in said.split("\n") if line.strip()]
    return lines + [f"node {node.getName()}: MaterialX has no definition {node.getNodeDefString()}"
                    for node in loaded.getNodes() if node.getNodeDef() is None]


def generate(text, language):
    """
    :param text: a document with one material
    :param language: a key of LANGUAGES
    :returns: dict of stage name -> text; stages that a language has not are not there
    :raises NotGenerated: where the generator gives up
    """
    core = _core()
    shading = importlib.import_module("MaterialX.PyMaterialXGenShader")
    module, name = LANGUAGES[language]
    loaded = _document(text)
    try:
        generator = getattr(importlib.import_module("MaterialX." + module), name).create()
        context = shading.GenContext(generator)
        context.registerSourceCodeSearchPath(core.getDefaultDataSearchPath())
        _set_up(core, shading, generator, context, loaded)
        if language == "msl":
            context.pushUserData("resource binding", _msl_bindings())
        elements = shading.findRenderableElements(loaded)
        if not elements:
            raise NotGenerated("MaterialX finds nothing to render in the document")
        shader = generator.generate(elements[0].getName(), elements[0], context)
    except (core.Exception, LookupError) as error:
        raise NotGenerated(_line(error)) from error
    found = {}
    for stage in (shading.VERTEX_STAGE, shading.PIXEL_STAGE):
        try:
            source = shader.getSourceCode(stage)
        except (core.Exception, LookupError):
            continue
        if source:
            found[stage] = source
    return found


def harmless(text, warnings):
    """
    :returns: a document whose texts cannot end the string literal, or the word, that the generators make of them as they are
    """
    root = tree.fromstring(text)
    parents = {child: parent for parent in root.iter() for child in parent}
    for element in root.iter():
        for key, value in list(element.items()):
            safe, id_ = _harmless(element, key, value)
            if safe is None:
                del element.attrib[key]
            else:
                element.set(key, safe)
            if id_:
                node = parents.get(element, root)
                names = (UNSAFE.sub("_", named.get("name", "")) for named in (node, element))
                warnings.append(messages.warning(*names, id_))
    return '<?xml version="1.0"?>\n' + tree.tostring(root, encoding="unicode") + "\n"


def _harmless(element, key, value):
    """:returns: what an attribute is written as, None to leave it out, and the id of the message about it ('' for none)"""
    if key == "colorspace" and not COLOR_SPACE.fullmatch(value):
        return None, "spaceNameUnsafe"
    if key == "value" and element.get("name") == "geomprop" and NOT_OF_A_WORD.search(value):
        return NOT_OF_A_WORD.sub("_", value), "primvarNameUnsafe"
    if UNSAFE.search(value):
        return UNSAFE.sub("_", value), "textUnsafe"
    return value, ""


def _core():
    return importlib.import_module("MaterialX")


def _document(text):
    core = _core()
    library = core.createDocument()
    core.loadLibraries(core.getDefaultDataLibraryFolders(), core.getDefaultDataSearchPath(), library)
    loaded = core.createDocument()
    loaded.setDataLibrary(library)
    try:
        core.readFromXmlString(loaded, text)
    except core.Exception as error:
        raise NotGenerated(_line(error)) from error
    return loaded


def _set_up(core, shading, generator, context, loaded):
    """Colour spaces and units, which the generators know only when they are told."""
    colors = shading.DefaultColorManagementSystem.create(generator.getTarget())
    colors.loadLibrary(loaded)
    generator.setColorManagementSystem(colors)
    units = shading.UnitSystem.create(generator.getTarget())
    units.loadLibrary(loaded)
    registry = core.UnitConverterRegistry.create()
    for kind in ("distance", "angle"):
        registry.addUnitConverter(loaded.getUnitTypeDef(kind),
                                  core.LinearUnitConverter.create(loaded.getUnitTypeDef(kind)))
    units.setUnitConverterRegistry(registry)
    generator.setUnitSystem(units)
    options = context.getOptions()
    options.targetDistanceUnit = "meter"
    options.targetColorSpaceOverride = "lin_rec709"
    options.fileTextureVerticalFlip = False
    generator.registerTypeDefs(loaded)


def _msl_bindings():
    module = importlib.import_module("MaterialX.PyMaterialXGenMsl")
    return module.MslResourceBindingContext.create(0, 0)


def _line(error):
    return " ".join(str(error).split())
