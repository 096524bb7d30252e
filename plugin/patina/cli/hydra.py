# SPDX-License-Identifier: Apache-2.0
"""Shows where the Hydra plugin is and whether a host can use it; builds it for several OpenUSDs.

  patina hydra
  patina hydra --usd /opt/usd-24.11 --usd blender-5.0/ --headers OpenUSD/
  patina hydra --usd /opt/usd-26.08 --output hdPatina-26.08.tar.gz
  patina hydra --blender blender-5.0/ --headers OpenUSD/ --output patina.zip
  eval "$(patina hydra --environment)"; usdview stage.usda --renderer Patina

The plugin is built for the OpenUSD that CMake found (PXR_USD_LOCATION, pxr_DIR or /usr/local/USD). The check loads it as a host
does, and says why a host would refuse it. `cmake --install` puts it into PREFIX/plugin/usd; set PXR_PLUGINPATH_NAME to that
folder then.

--usd builds plugins side by side, from a checkout. --output packs one with the libraries that it needs, for machines that have
none of them. --blender packs one as an extension, which Blender's preferences install ("Install from Disk").
"""
import os
import shlex
import subprocess

from patina.cli import blenderAddOn, hydraHosts, pluginPackage
from patina.cli.errors import CommandError, UsageError


def add_arguments(parser):
    parser.add_argument("--environment", action="store_true",
                        help="print the shell line that lets hosts find the plugin, and nothing else")
    parser.add_argument("--usd", action="append", default=[], metavar="FOLDER",
                        help="build the plugin for this OpenUSD, each in a folder of its own (repeatable): an installed one, "
                             "or a program with an OpenUSD inside, such as Blender's")
    parser.add_argument("--blender", metavar="FOLDER",
                        help="build the plugin for this Blender, or module bpy, and pack it as an extension")
    parser.add_argument("--output", metavar="FILE",
                        help="of --blender: the zip (default: patina-blender-VERSION.zip); of one --usd: a .tar.gz with the "
                             "plugin and its libraries")
    parser.add_argument("--headers", action="append", default=[], metavar="FOLDER",
                        help="of a program: OpenUSD's source of the very version, which programs do not bring (repeatable, in "
                             "the order of --usd)")


def run(arguments):
    if arguments.blender and arguments.usd:
        raise UsageError("patina hydra: --blender and --usd are two commands")
    if arguments.output and not arguments.blender and len(arguments.usd) != 1:
        raise UsageError("patina hydra: --output belongs to --blender, or to one --usd")
    if arguments.usd or arguments.blender:
        return _build(arguments)
    if arguments.headers:
        raise UsageError("patina hydra: --headers belongs to --usd or --blender")
    folder, program = _places()
    if arguments.environment:
        print(f"export PXR_PLUGINPATH_NAME={shlex.quote(folder)}${{PXR_PLUGINPATH_NAME:+:$PXR_PLUGINPATH_NAME}}")
        return 0
    print(f"PXR_PLUGINPATH_NAME has to name {folder}", flush=True)
    environment = dict(os.environ)
    known = [path for path in (environment.get("PXR_PLUGINPATH_NAME"),) if path]
    environment["PXR_PLUGINPATH_NAME"] = os.pathsep.join([folder] + known)
    for name in ("PYTHONPATH", "PYTHONSAFEPATH"):  # they are for patina's own Python
        environment.pop(name, None)
    if subprocess.run([program], env=environment, check=False).returncode:
        raise CommandError("a host would refuse the plugin; the reason is above")
    return 0


def _build(arguments):
    command, build = os.environ.get("PATINA_COMMAND"), os.environ.get("PATINA_BUILD_DIR")
    if not command or not build:
        raise CommandError("--usd needs a checkout: ./patina hydra --usd FOLDER")
    hosts = arguments.usd or [arguments.blender]
    if arguments.blender:
        file = arguments.output or f"patina-blender-{blenderAddOn.blender_version(arguments.blender)}.zip"
    packed = bool(arguments.blender or arguments.output)
    made = hydraHosts.build_all(hosts, arguments.headers, build, command, portable=packed)
    if arguments.blender:
        with pluginPackage.whole(made[0]) as folder:
            blenderAddOn.pack(arguments.blender, folder, made[0].version, file)
        print(f"\n{file}: for Blender {blenderAddOn.blender_version(arguments.blender)}")
        return 0
    if arguments.output:
        pluginPackage.pack(made[0], arguments.output)
        print(f"\n{arguments.output}: PXR_PLUGINPATH_NAME has to name the folder that it unpacks to")
        return 0
    print("\nPXR_PLUGINPATH_NAME for each of them:")
    for host, one in zip(hosts, made):
        print(f"  {host}  {one.plugin}")
    return 0


def _places():
    """:returns: (folder for PXR_PLUGINPATH_NAME, path of patinaHydraInfo)
    :raises CommandError: when there is no plugin"""
    build = os.path.abspath(os.environ["PATINA_BUILD_DIR"]) if os.environ.get("PATINA_BUILD_DIR") else ""  # hosts run elsewhere
    # PREFIX/lib/patina/python/patina/cli/hydra.py of what `cmake --install` made
    prefix = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), *[".."] * 5))
    places = [(os.path.join(prefix, "plugin", "usd"), os.path.join(prefix, "bin", "patinaHydraInfo"))]
    if build:
        places.insert(0, (os.path.join(build, "usdPlugin"), os.path.join(build, "plugin", "hydra", "patinaHydraInfo")))
    folder, program = next((pair for pair in places if all(map(os.path.exists, pair))), (None, None))
    if not program:
        raise CommandError("the Hydra plugin is not built: CMake found no OpenUSD with Hydra (set PXR_USD_LOCATION "
                           "to where it is installed)")
    return folder, program
