# SPDX-License-Identifier: Apache-2.0
"""The machine and the build that times were measured on, in words."""
import os
import platform
import subprocess
import sys

from patina import __version__
from patina.cli.compiled import _patina


def describe():
    """:returns: dict of texts: version, commit, processor, cores, system, python, usd, opengl, compiler"""
    known = _patina.machine()
    opengl = ", ".join(filter(None, (known["openglRenderer"], known["openglVersion"])))
    return {"version": __version__, "commit": commit(), "processor": processor(), "cores": str(cores()),
            "system": f"{platform.system()} {platform.machine()}",
            "python": ".".join(map(str, sys.version_info[:3])), "usd": _usd(),
            "opengl": opengl or f"none ({known['openglError']})", "compiler": known["compiler"]}


def sentence(machine):
    """One line for a README or the foot of a chart."""
    return (f"{machine['processor']}, {machine['cores']} cores, OpenGL {machine['opengl']}, Patina {machine['version']} "
            f"({machine['commit']})")


def cores():
    """Cores that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # not on this system
        return os.cpu_count() or 1


def processor():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                if line.startswith("model name"):
                    return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def commit():
    """The checkout's commit, with `+` where files differ from it; `unknown` outside a checkout."""
    root = os.path.dirname(os.path.abspath(__file__))

    def git(*arguments):
        return subprocess.run(["git", "-C", root, *arguments], capture_output=True, text=True, timeout=20)

    try:
        found = git("rev-parse", "--short=12", "HEAD")
        if found.returncode != 0:
            return "unknown"
        changed = git("status", "--porcelain", "--untracked-files=no").stdout.strip()
        return found.stdout.strip() + ("+" if changed else "")
    except (OSError, subprocess.TimeoutExpired):
        return "unknown"


def _usd():
    try:
        from pxr import Usd
    except ImportError:
        return "none"
    return ".".join(map(str, Usd.GetVersion()))
