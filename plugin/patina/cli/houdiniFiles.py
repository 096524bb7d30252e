# SPDX-License-Identifier: Apache-2.0
"""Writes what Houdini reads beside the plugin, from the table of settings: `python -m patina.cli.houdiniFiles FOLDER`, as the
build of the plugin does.

UsdRenderers.json names the renderer in Solaris' menus; in soho/parameters RENDERER_Viewport.ds holds the settings of the
viewport and RENDERER_Global.ds those of the node Render Settings (HDK, "USD Hydra: Customizing for Houdini"). All are found on
HOUDINI_PATH.
"""
import json
import os
import sys

from patina.cli import hostSettings

_RENDERERS = {"HdPatinaRendererPlugin": ("Patina", 50), "HdPatinaRasterRendererPlugin": ("Patina GL", 49)}
_STATISTICS = {"percentDone": "percentDone", "totalClockTime": "totalClockTime",
               "renderProgressAnnotation": "renderProgressAnnotation"}
# Of Blender's add-on alone.
_LEFT_OUT = ("viewportBackend", "albedoPass")


def _renderers():
    return json.dumps({name: {"valid": True, "menulabel": label, "menupriority": priority, "aovsupport": True,
                              "drawmodesupport": True, "allowbackgroundupdate": True, "renderstats": _STATISTICS}
                       for name, (label, priority) in _RENDERERS.items()}, indent=4) + "\n"


def _quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def encoded(name):
    """:param name: of an attribute, with one colon
    :returns: it as names of parameters have it (hou.text.encode): Punycode (RFC 3492) in which all but letters, digits and _
        are the special characters, from code 1 on"""
    plain, digits, text = name.replace(":", ""), "abcdefghijklmnopqrstuvwxyz0123456789", ""
    number = (ord(":") - 1) * (len(plain) + 1) + name.index(":")
    for least in (1, 1, 26, 26, 26):  # thresholds of the first character's digits
        if number < least:
            break
        number, digit = divmod(number - least, 36 - least)
        text += digits[digit + least]
    return f"xn__{plain}_{text}{digits[number]}"


def _control(setting, name):
    """Whether the node writes the attribute; the next parameter has its value."""
    return ["    parm {", f"        name    {_quoted(name + '_control')}", f"        label   {_quoted(setting['label'])}",
            "        type    string", '        default { "none" }', "        menujoin {",
            '            "set" "Set or Create"', '            "setexisting" "Set if Exists"', '            "block" "Block"',
            '            "none" "Do Nothing"', "        }", "    }"]


def _parameter(setting, name, tags=()):
    kind = {"bool": "toggle", "int": "integer", "float": "float", "string": "string"}[setting["type"]]
    default = setting["default"]
    if kind in ("toggle", "string"):
        default = _quoted(default if kind == "string" else str(int(default)))
    lines = [f"name    {_quoted(name)}", f"label   {_quoted(setting['label'])}", f"type    {kind}",
             f"default {{ {default} }}"]
    low, high = setting["min"], setting["max"]
    if kind in ("integer", "float") and low is not None:
        # ! holds a value within the limit; a slider has another end to go to where there is none.
        limited = high is not None and high < 1e9
        lines.append(f"range   {{ {low}! {f'{high}!' if limited else max(low, default, 1) * 10} }}")
    if setting["choices"]:
        lines += ["menu {", *(f"    {_quoted(choice)} {_quoted(choice)}" for choice in setting["choices"]), "}"]
    if setting["help"]:
        lines.append(f"help    {_quoted(' '.join(setting['help'].split()))}")
    return ["    parm {", *(f"        {line}" for line in [*lines, *tags]), "    }"]


def _settings():
    return [s for s in hostSettings.shown() if s["key"] not in _LEFT_OUT]


def _script(name, label, lines):
    head = [f"    name    {_quoted(name)}", f"    label   {_quoted(label)}"]
    return "\n".join(["{", *head, *lines, "}"]) + "\n"


def _global():
    """Of attributes of a RenderSettings prim, which are called patina:NAME."""
    lines = []
    for setting in _settings():
        name = encoded("patina:" + setting["key"])
        lines += _control(setting, name)
        lines += _parameter(setting, name, [
            f'disablewhen "{{ {name}_control == block }} {{ {name}_control == none }}"',
            f'parmtag {{ "usdvaluetype" "{setting["type"]}" }}'])
    return lines


def texts():
    """:returns: dict from a file's name to its text"""
    found = {"UsdRenderers.json": _renderers()}
    for name, (label, _) in _RENDERERS.items():
        viewport = [line for setting in _settings() for line in _parameter(setting, setting["key"])]
        for kind, lines in (("Viewport", viewport), ("Global", _global())):
            found[os.path.join("soho", "parameters", f"{name}_{kind}.ds")] = _script(f"{name}_{kind}", label, lines)
    return found


def main(folder):
    for name, text in texts().items():
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


if __name__ == "__main__":
    main(sys.argv[1])
