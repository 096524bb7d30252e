# SPDX-License-Identifier: Apache-2.0
"""The page's script: fetched from npm and bundled on first use, then kept.

Versions are pinned by web/package.json and web/package-lock.json. Fetched packages and bundles lie in
PATINA_VIEW_CACHE, or patina/view in the user's cache folder, under a name made of both files.
"""
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile

from patina.cli.errors import CommandError

WEB = os.path.join(os.path.dirname(os.path.abspath(__file__)), "web")


def _digest(*files):
    digest = hashlib.sha256()
    for file in files:
        with open(file, "rb") as stream:
            digest.update(stream.read())
    return digest.hexdigest()[:16]


def cache_folder(web=WEB):
    """:param web: a folder with package.json and package-lock.json"""
    chosen = os.environ.get("PATINA_VIEW_CACHE")
    base = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    lock = _digest(os.path.join(web, "package.json"), os.path.join(web, "package-lock.json"))
    return os.path.join(chosen or os.path.join(base, "patina", "view"), lock)


def node():
    """:returns: the path of Node"""
    found = shutil.which("node")
    if not found:
        raise CommandError("patina view needs Node 18 or later to build its page, once: install node and npm "
                           "(Debian: apt install nodejs npm); nothing else of Patina needs them")
    return found


def packages(web=WEB):
    """Fetches npm packages unless they are there.

    :param web: a folder whose package.json and package-lock.json name them
    :returns: the folder that holds node_modules
    :raises CommandError: where Node or npm is missing, or npm fails
    """
    folder = cache_folder(web)
    if os.path.isdir(os.path.join(folder, "node_modules")):
        return folder
    node()
    npm = shutil.which("npm")
    if not npm:
        raise CommandError("patina view needs npm to fetch what its page is made of, once (Debian: apt install npm)")
    os.makedirs(os.path.dirname(folder), exist_ok=True)
    made = tempfile.mkdtemp(prefix="npm-", dir=os.path.dirname(folder))
    try:
        for name in ("package.json", "package-lock.json"):
            shutil.copy(os.path.join(web, name), made)
        done = subprocess.run([npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"],
                              cwd=made, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            lines = [line for line in done.stderr.split("\n") if line.strip()] or ["no reason was given"]
            raise CommandError("npm could not fetch the packages of the page: " + lines[0])
        _take(made, folder)
    finally:
        shutil.rmtree(made, ignore_errors=True)
    return folder


def _take(made, folder):
    try:
        os.rename(made, folder)
    except OSError:  # another process was faster
        if not os.path.isdir(folder):
            raise


def _sources():
    src = os.path.join(WEB, "src")
    return sorted(os.path.join(src, name) for name in os.listdir(src) if name.endswith(".js"))


def _bundle(folder, out):
    """Writes the script, whole or not at all.

    :param folder: what packages() returned"""
    made = tempfile.mkdtemp(prefix="page-", dir=folder)
    try:
        text = os.path.join(made, "page.js")
        esbuild = os.path.join(folder, "node_modules", "esbuild", "bin", "esbuild")
        done = subprocess.run([node(), esbuild, os.path.join(WEB, "src", "main.js"), "--bundle", "--minify", "--format=iife",
                               "--target=es2022", "--legal-comments=inline", "--log-level=error", f"--outfile={text}"],
                              env={**os.environ, "NODE_PATH": os.path.join(folder, "node_modules")},
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise CommandError("esbuild could not make the page's script: " + " ".join(done.stderr.split())[:400])
        os.replace(text, out)
    finally:
        shutil.rmtree(made, ignore_errors=True)


def script():
    """:returns: the text of the page's script"""
    out = os.path.join(WEB, "page.js")  # of an installed package
    if not os.path.exists(out):
        folder = packages()
        out = os.path.join(folder, f"page-{_digest(*_sources())}.js")
        if not os.path.exists(out):
            _bundle(folder, out)
    with open(out, encoding="utf-8") as file:
        return file.read()


def package(out):
    """What the build of a package does, before there is a compiled module: `python -m patina.view.bundle OUT.js`.

    Where Node, npm or their registry are out of reach, the package goes without: `patina view` makes the script on first use.

    :param out: file that takes the script
    :raises CommandError: where the script cannot be made of its packages"""
    try:
        packages()
    except (CommandError, OSError) as error:
        print(f"the package has no script of the material page, which patina view makes on first use: {error}", file=sys.stderr)
        return
    text = script()
    with open(out, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    package(sys.argv[1])
