# SPDX-License-Identifier: Apache-2.0
"""Takes into a wheel the libraries that it needs, so that pip alone installs Patina, on any Linux whose
glibc is not older than this machine's.

auditwheel leaves out libraries of the X Window System, which its policy takes for given; a machine without a desktop has none.
"""
import glob
import os
import platform
import shutil
import subprocess
import sys
import tempfile

from patina.cli import bundledLibraries
from patina.cli.errors import CommandError

_FOLDER = "hdPatina.libs"


def make(wheel, folder):
    """:param wheel: as `pip wheel` makes it
    :param folder: takes the new one, named for the glibc of this machine
    :returns: its path
    :raises CommandError: where a library or a tool is missing"""
    with tempfile.TemporaryDirectory() as place:
        _run("unpack", "--dest", place, wheel)
        (tree,) = glob.glob(os.path.join(place, "*"))
        files = [path for path in glob.glob(os.path.join(glob.escape(tree), "**", "*"), recursive=True) if _is_elf(path)]
        require_denoiser(tree)
        bundledLibraries.bundle(files, os.path.join(tree, _FOLDER), [tree])
        _run("pack", "--dest-dir", place, tree)
        (packed,) = glob.glob(os.path.join(place, "*.whl"))
        tag = f"manylinux_{platform.libc_ver()[1].replace('.', '_')}_{platform.machine()}"
        name = _run("tags", "--remove", f"--platform-tag={tag}", packed).split()[-1]
        os.makedirs(folder, exist_ok=True)
        target = os.path.join(folder, os.path.basename(name))
        shutil.move(os.path.join(place, os.path.basename(name)), target)
    return target


def require_denoiser(tree):
    """Asks pip for what pyproject.toml has as an extra, since `--denoise` cannot find a library of the system."""
    (path,) = glob.glob(os.path.join(tree, "*.dist-info", "METADATA"))
    with open(path, encoding="utf-8") as file:
        text = file.read()
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace("\nName:", "\nRequires-Dist: pyoidn\nName:", 1))


def _is_elf(path):
    if not os.path.isfile(path):
        return False
    with open(path, "rb") as file:
        return file.read(4) == b"\x7fELF"


def _run(*words):
    done = subprocess.run([sys.executable, "-m", "wheel", *words], capture_output=True, text=True, check=False)
    if done.returncode:
        raise CommandError(f"python -m wheel {words[0]}: {(done.stderr or done.stdout).strip()} (pip install wheel)")
    return done.stdout
