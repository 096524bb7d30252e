# SPDX-License-Identifier: Apache-2.0
"""Builds the site into a folder: pages, MkDocs, Doxygen."""
import logging
import os
import re
import shutil
import subprocess
import sys
import tempfile

import headers
import pages
from patina.cli.errors import CommandError
from patina.view import bundle

HERE = os.path.dirname(os.path.abspath(__file__))
WEB = os.path.join(HERE, "web")
ASSETS = {"mermaid.min.js": "mermaid/dist/mermaid.min.js", "iframe-worker.js": "iframe-worker/shim/index.js"}
MARK = "patina-site"  # a file that says that a folder holds a site, which may be replaced


def main(out, strict=False):
    """:param out: absolute path of the site's folder
    :param strict: whether warnings and parts that are left out are failures
    :returns: the exit status
    :raises CommandError: where the folder holds something else, or the site cannot be made"""
    if os.path.isdir(out) and os.listdir(out) and not os.path.exists(os.path.join(out, MARK)):
        raise CommandError(f"{out} holds something that is no site of Patina; name a new folder")
    left_out = []
    with tempfile.TemporaryDirectory(prefix="patina-site-") as folder:
        source, made = os.path.join(folder, "pages"), os.path.join(folder, "site")
        pages.write(source)
        left_out += [_assets(source)]
        left_out += [_doxygen(folder, source)]
        warnings = _mkdocs(folder, source, made)
        with open(os.path.join(made, MARK), "w", encoding="utf-8") as file:
            file.write("made by `patina docs`, which replaces this folder\n")
        os.makedirs(os.path.dirname(out), exist_ok=True)
        shutil.rmtree(out, ignore_errors=True)
        shutil.move(made, out)
    left_out = [text for text in left_out if text]
    for text in warnings + left_out:
        print(f"patina: {text}", file=sys.stderr)
    count = sum(name.endswith(".html") for _, _, names in os.walk(out) for name in names)
    print(f"{os.path.join(out, 'index.html')} ({count} pages)")
    return 1 if strict and (warnings or left_out) else 0


def _assets(source):
    """:returns: what is left out, in words"""
    target = os.path.join(source, "assets")
    os.makedirs(target, exist_ok=True)
    for name in ("site.css", "site.js"):
        shutil.copy(os.path.join(HERE, name), target)
    try:
        modules = os.path.join(bundle.packages(WEB), "node_modules")
    except CommandError as error:
        for name in ASSETS:
            with open(os.path.join(target, name), "w", encoding="utf-8"):
                pass
        return f"left out: diagrams, and search in pages that are opened from a file ({error})"
    for name, path in ASSETS.items():
        shutil.copy(os.path.join(modules, *path.split("/")), os.path.join(target, name))
    return ""


def _doxygen(folder, source):
    """:returns: what is left out, in words"""
    target = os.path.join(source, "api", "cpp")
    program = shutil.which("doxygen")
    if not program:
        os.makedirs(target, exist_ok=True)
        with open(os.path.join(target, "index.html"), "w", encoding="utf-8") as file:
            file.write("<!doctype html><html lang=\"en\"><title>Patina: C++</title><p>Doxygen was not installed where this "
                       "site was built, so it has no pages of the C++ headers.</p></html>\n")
        return "left out: pages of the C++ headers (install Doxygen: apt install doxygen)"
    with open(os.path.join(HERE, "Doxyfile"), encoding="utf-8") as file:
        text = file.read()
    text += f"\nOUTPUT_DIRECTORY = \"{folder}\"\nHTML_OUTPUT = doxygen\nSTRIP_FROM_PATH = \"{pages.ROOT}\"\n"
    text += f"HTML_EXTRA_STYLESHEET = \"{os.path.join(HERE, 'headers.css')}\"\n"
    done = subprocess.run([program, "-"], input=text, cwd=pages.ROOT, capture_output=True, text=True, check=False)
    made = os.path.join(folder, "doxygen")
    if done.returncode != 0 or not os.path.isfile(os.path.join(made, "index.html")):
        raise CommandError("Doxygen failed: " + " ".join(done.stderr.split())[-400:])
    headers.improve(made)
    with open(os.path.join(HERE, "headers.css"), encoding="utf-8") as file:
        colors = file.read()
    with open(os.path.join(made, "search", "search.css"), "a", encoding="utf-8") as file:
        file.write(colors)  # the pages of results read this file alone
    os.makedirs(os.path.dirname(target), exist_ok=True)
    shutil.move(made, target)
    return ""


class _Warnings(logging.Handler):
    def __init__(self):
        super().__init__(logging.WARNING)
        self.texts = []

    def emit(self, record):
        self.texts.append(re.sub(r"\x1b\[[0-9;]*m", "", record.getMessage()))


def _mkdocs(folder, source, made):
    """:returns: warnings
    :raises CommandError: where MkDocs stops"""
    from mkdocs import config, exceptions
    from mkdocs.commands import build

    with open(os.path.join(HERE, "mkdocs.yml"), encoding="utf-8") as file:
        text = file.read()
    stubs = os.path.join(folder, "stubs")  # a stub without its module is looked for as a source
    os.makedirs(stubs)
    shutil.copy(os.path.join(pages.ROOT, "plugin", "python", "_patina.pyi"), os.path.join(stubs, "_patina.py"))
    text = text.replace("[PYTHON]", repr([stubs, os.path.join(pages.ROOT, "plugin")]))
    path = os.path.join(folder, "mkdocs.yml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    heard = _Warnings()
    log = logging.getLogger("mkdocs")
    log.addHandler(heard)
    log.propagate = False
    os.environ.setdefault("NO_MKDOCS_2_WARNING", "1")
    try:
        loaded = config.load_config(path, docs_dir=source, site_dir=made)
        loaded.plugins.run_event("startup", command="build", dirty=False)
        build.build(loaded)
        loaded.plugins.run_event("shutdown")
    except (exceptions.MkDocsException, exceptions.Abort) as error:
        raise CommandError("MkDocs stopped: " + "; ".join([*heard.texts[-3:], str(error)])) from None
    finally:
        log.removeHandler(heard)
    return heard.texts
