# SPDX-License-Identifier: Apache-2.0
"""OpenUSDs to build the Hydra plugin for: installed ones, and those inside of programs, which have libraries but no headers."""
import glob
import mmap
import os
import re
import subprocess
import sys
from typing import NamedTuple

from patina.cli.errors import CommandError

LEVEL = "x86-64-v2"  # the least that programs of today ask for
_NAMESPACE = re.compile(rb"\d(pxr\w*?__pxrReserved__)")
_CONFIG = """# Made by `patina hydra --usd`: the OpenUSD inside of {host}.
set(PXR_VERSION {version})
# set(Python3_EXECUTABLE [[{python}]])
add_library(usd_ms SHARED IMPORTED)
set_target_properties(usd_ms PROPERTIES
    IMPORTED_LOCATION "{prefix}/lib/{library}"
    INTERFACE_INCLUDE_DIRECTORIES "{prefix}/include;{headers};{pythonInclude}"
    INTERFACE_LINK_OPTIONS "-Wl,--allow-shlib-undefined"
    # The host's Python is in its executable; our own programs bring one.
    INTERFACE_LINK_LIBRARIES "{tbb};$<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:{pythonLibrary}>")
"""


def prefix_of(host, headers, folder):
    """:param host: an OpenUSD's prefix, or a folder of a program that has a monolithic one inside, such as Blender's `bpy`
    :param headers: folder of OpenUSD's source of the same version; needed for programs
    :param folder: where what a program lacks is made, in a folder of its own
    :returns: (name, folder that holds pxrConfig.cmake)
    :raises CommandError: where the two do not fit, or something is missing"""
    host = os.path.abspath(host)
    installed = _installed(host)
    if installed:
        return os.path.basename(host), installed
    library = _library(host)
    if not headers:
        raise CommandError(f"{host} has no pxrConfig.cmake; --headers FOLDER names OpenUSD's source of its version")
    headers = os.path.abspath(headers)
    version, namespace = _version(headers), _namespace(library)
    _check(host, namespace, version, headers)
    name = namespace.replace("__pxrReserved__", "")
    prefix = os.path.join(folder, name, "openUSD")
    _write_headers(headers, os.path.join(prefix, "include"), version, namespace)
    _link(_libraries(host, library), os.path.join(prefix, "lib"))
    usdrecord = os.path.join(headers, "pxr", "usdImaging", "bin", "usdrecord", "usdrecord.py")
    _link({"usdrecord": usdrecord} if os.path.exists(usdrecord) else {}, os.path.join(prefix, "bin"))
    tbb = sorted(glob.glob(os.path.join(prefix, "lib", "libtbb.so*")))
    python = _python(host)
    include, own = _python_paths(python)
    _write(os.path.join(prefix, "pxrConfig.cmake"), _CONFIG.format(
        host=host, version=_number(version), python=python, prefix=prefix, library=os.path.basename(library),
        headers=headers, pythonInclude=include, tbb=tbb[0] if tbb else "tbb", pythonLibrary=own))
    return name, prefix


def _installed(host):
    """:returns: the folder of an OpenUSD that holds pxrConfig.cmake, or None"""
    places = (os.path.join(host, place) for place in ("", "lib/cmake/pxr", "cmake"))
    return next((place for place in places if os.path.exists(os.path.join(place, "pxrConfig.cmake"))), None)


def _library(host):
    found = sorted(glob.glob(os.path.join(glob.escape(host), "**", "libusd_ms.so"), recursive=True))
    if not found:
        raise CommandError(f"{host} is no OpenUSD: it has neither pxrConfig.cmake nor a library libusd_ms.so")
    return found[0]


def _version(headers):
    """:returns: (major, minor, patch)"""
    try:
        with open(os.path.join(headers, "cmake", "defaults", "Version.cmake"), encoding="utf-8") as file:
            text = file.read()
        return tuple(int(re.search(rf'PXR_{part}_VERSION "(\d+)"', text).group(1)) for part in ("MAJOR", "MINOR", "PATCH"))
    except (OSError, AttributeError):
        raise CommandError(f"{headers} is not OpenUSD's source: it has no cmake/defaults/Version.cmake") from None


def _number(version):
    return version[0] * 10000 + version[1] * 100 + version[2]


def _namespace(library):
    """:returns: in which its symbols are"""
    with open(library, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        found = next((match.group(1).decode() for match in _NAMESPACE.finditer(data)), None)
    if not found:
        raise CommandError(f"{library} has no symbols of OpenUSD")
    return found


def _check(host, namespace, version, headers):
    digits = [int(n) for n in re.findall(r"\d+", namespace)]
    if digits[-2:] != list(version[1:]):
        raise CommandError(f"{host} has an OpenUSD whose symbols are in {namespace}, but {headers} is version "
                           f"{version[1]}.{version[2]:02d}: a plugin needs the headers of its host's version")


def _write_headers(source, folder, version, namespace):
    """What a build of OpenUSD makes from its *.h.in, as programs build it: with Python, checks and its own task library."""
    values = {"PXR_MAJOR_VERSION": version[0], "PXR_MINOR_VERSION": version[1], "PXR_PATCH_VERSION": version[2],
              "PXR_VERSION": _number(version), "PXR_USE_NAMESPACES": 1, "PXR_EXTERNAL_NAMESPACE": "pxr",
              "PXR_INTERNAL_NAMESPACE": namespace.replace("__pxrReserved__", ""), "PXR_PYTHON_SUPPORT_ENABLED": 1,
              "PXR_PREFER_SAFETY_OVER_SPEED": 1, "PXR_USE_INTERNAL_BOOST_PYTHON": 1,
              "PXR_WORK_IMPL_HEADER": '"pxr/base/work/workTBB/impl.h"'}
    for file in sorted(glob.glob(os.path.join(glob.escape(source), "pxr", "**", "*.h.in"), recursive=True)):
        with open(file, encoding="utf-8") as opened:
            text = re.sub(r"@(\w+)@", lambda word: str(values.get(word.group(1), 0)), opened.read())
        _write(os.path.join(folder, os.path.relpath(file, source)[:-3]), text)


def _write(path, text):
    """Keeps the file where it has this text, so that nothing is compiled again."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    try:
        with open(path, encoding="utf-8") as file:
            if file.read() == text:
                return
    except OSError:
        pass
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def _libraries(host, library):
    """:returns: dict from name to file or folder: libraries, resources and Python modules, as in an installed OpenUSD"""
    beside = os.path.dirname(library)
    found = {name: os.path.join(beside, name) for name in os.listdir(beside) if ".so" in name}
    found.update({name: os.path.join(beside, name) for name in ("usd", "materialx")})
    module = glob.glob(os.path.join(glob.escape(host), "**", "site-packages", "pxr", "__init__.py"), recursive=True)
    found.update({os.path.join("python", "pxr"): os.path.dirname(path) for path in module[:1]})
    return found


def _link(targets, folder):
    for name, target in targets.items():
        link = os.path.join(folder, name)
        os.makedirs(os.path.dirname(link), exist_ok=True)
        if os.path.islink(link):
            os.remove(link)
        os.symlink(target, link)


def _python(host):
    """:returns: the Python that a program's modules run in: that of its environment, or its own"""
    folder = host
    while folder != os.path.dirname(folder):
        if os.path.exists(os.path.join(folder, "pyvenv.cfg")):
            return os.path.join(folder, "bin", "python")
        folder = os.path.dirname(folder)
    own = sorted(glob.glob(os.path.join(glob.escape(host), "**", "python", "bin", "python3*"), recursive=True))
    return own[0] if own else ""


def _python_paths(python):
    """:returns: (folder of the headers of a host's Python, its library); this Python's where the host's has no headers"""
    code = ("import sysconfig as s; v = s.get_config_var; "
            "print(s.get_path('include'), (v('LIBDIR') or '') + '/' + (v('LDLIBRARY') or ''), sep='\\n')")
    for executable in filter(None, (python, sys.executable)):
        try:
            asked = subprocess.run([executable, "-I", "-c", code], capture_output=True, text=True, check=False)
        except OSError:
            continue
        found = asked.stdout.splitlines()
        if found and os.path.exists(os.path.join(found[0], "Python.h")):
            return found
    raise CommandError("Python's headers are missing: OpenUSD's include them (package python3-dev)")


class Built(NamedTuple):
    plugin: str  # the folder for PXR_PLUGINPATH_NAME
    programs: str  # the folder of those that it starts
    libraries: str  # the folder of its OpenUSD's
    version: tuple  # of its OpenUSD: minor and patch
    name: str  # of its OpenUSD: of an installed one its folder, of a program its namespace


def build_all(hosts, headers, build, command, portable=False):
    """Builds a plugin for each OpenUSD in a folder of its own.

    :param hosts: paths; see prefix_of()
    :param headers: of those that need them, in this order
    :param build: the build folder of the checkout
    :param command: the path of `patina`
    :param portable: for all processors that have LEVEL, not for this machine's alone
    :returns: list of Built
    :raises CommandError: where one cannot be built"""
    left, made = list(headers), []
    for host in hosts:
        name, prefix = prefix_of(host, None if _installed(host) or not left else left.pop(0), os.path.join(build, "hosts"))
        own = f"{build}-{name}" + ("-portable" if portable else "")  # beside it, where ccache finds what both compile
        environment = {**os.environ, "PATINA_BUILD_DIR": own, "PXR_USD_LOCATION": prefix,
                       **({"PATINA_LEVEL": LEVEL} if portable else {})}
        for variable in ("PYTHONPATH", "PYTHONSAFEPATH", "pxr_DIR"):
            environment.pop(variable, None)
        print(f"\n{host}:", flush=True)
        if subprocess.run([command, "hydra"], env=environment, check=False).returncode:
            raise CommandError(f"no plugin for {host}; the reason is above")
        with open(os.path.join(prefix, "pxrConfig.cmake"), encoding="utf-8") as file:
            number = int(re.search(r'set\(PXR_VERSION "?(\d+)', file.read()).group(1))
        made.append(Built(os.path.join(own, "usdPlugin"), os.path.join(own, "python"), os.path.join(prefix, "lib"),
                          divmod(number, 100), name))
    return made
