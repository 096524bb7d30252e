# SPDX-License-Identifier: Apache-2.0
"""Writes what Houdini reads beside the plugin, from the table of settings: `./patina python -m patina.cli.houdiniFiles`.

UsdRenderers.json names the renderer in Solaris' menus; soho/parameters/RENDERER_Viewport.ds holds the settings of the viewport
(HDK, "USD Hydra: Customizing for Houdini"). Both are found on HOUDINI_PATH.
"""
import json
import os

from patina.cli import hostSettings, rows

FOLDER = os.path.join(rows.ROOT, "plugin", "houdini")
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


def _parameter(setting):
    kind = {"bool": "toggle", "int": "integer", "float": "float", "string": "string"}[setting["type"]]
    default = setting["default"]
    if kind in ("toggle", "string"):
        default = _quoted(default if kind == "string" else str(int(default)))
    lines = [f"name    {_quoted(setting['key'])}", f"label   {_quoted(setting['label'])}", f"type    {kind}",
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
    return ["    parm {", *(f"        {line}" for line in lines), "    }"]


def _viewport(renderer, label):
    settings = [s for s in hostSettings.shown() if s["key"] not in _LEFT_OUT]
    lines = [line for setting in settings for line in _parameter(setting)]
    head = [f"    name    {_quoted(renderer + '_Viewport')}", f"    label   {_quoted(label)}"]
    return "\n".join(["{", *head, *lines, "}"]) + "\n"


def texts():
    """:returns: dict from a file's name below FOLDER to its text"""
    found = {"UsdRenderers.json": _renderers()}
    for name, (label, _) in _RENDERERS.items():
        found[os.path.join("soho", "parameters", f"{name}_Viewport.ds")] = _viewport(name, label)
    return found


def main():
    for name, text in texts().items():
        path = os.path.join(FOLDER, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


if __name__ == "__main__":
    main()
