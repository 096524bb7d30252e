# SPDX-License-Identifier: Apache-2.0
"""The checkout's documents as pages of the site: where each stands, and its links from there."""
import os
import posixpath
import re
import shutil

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
TOPS = {"README.md": "index.md", "ARCHITECTURE.md": "architecture.md", "CONTRIBUTING.md": "contributing.md",
        "CHANGELOG.md": "changelog.md", "SECURITY.md": "security.md"}
LEFT_OUT = ("docs/site",)
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
INDEX_TITLES = {"design": "Design", "generated": "Generated reference", "measurements": "Measurements",
                "history": "Earlier versions", "howto": "How to add one", "tutorials": "Tutorials"}


def place_of(path):
    """:param path: of a file, below the checkout's root
    :returns: its place below the site's root; None where it is no part of the site"""
    if path in TOPS:
        return TOPS[path]
    if path.startswith("docs/") and not path.startswith(LEFT_OUT):
        place = path[len("docs/"):]
        return posixpath.join(posixpath.dirname(place), "index.md") if posixpath.basename(place) == "README.md" else place
    return None


def _target(path, target):
    """:returns: where a link of a document leads in the site, or None"""
    name = posixpath.normpath(posixpath.join(posixpath.dirname(path), target))
    if os.path.isdir(os.path.join(ROOT, name)):
        name = posixpath.join(name, "README.md")  # an index is made where there is none
    return place_of(name)


def text_of(path):
    """:param path: of a document, below the checkout's root
    :returns: its text with the links of the site"""
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        text = file.read()
    here = posixpath.dirname(place_of(path))

    def linked(match):
        picture, label, target = match.groups()
        if re.match(r"\w+:|#", target):
            return match[0]
        file, _, fragment = target.partition("#")
        place = _target(path, file)
        if place is None:  # a source file: the site has none
            return label
        there = posixpath.relpath(place, here or ".") + ("#" + fragment if fragment else "")
        return f"{picture}[{LINK.sub(linked, label)}]({there})"

    parts = re.split(r"(^```.*?^```$)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(part if part.startswith("```") else _lists(LINK.sub(linked, part)) for part in parts)


def _lists(text):
    """Python's Markdown wants an empty line before a list, and four spaces below an item, where GitHub's needs neither."""
    lines, out = text.split("\n"), []
    for line in lines:
        item = re.match(r"( *)([-*]|\d+\.) ", line)
        before = out[-1] if out else ""
        if item and before.strip() and not re.match(r" *([-*]|\d+\.) | {2,}|\|", before):
            out.append("")
        indent = len(line) - len(line.lstrip(" "))
        nested = 0 < indent < 4 and line.strip() and any(re.match(r"([-*]|\d+\.) ", o) for o in out[-8:])
        out.append("    " + line.lstrip(" ") if nested else line)
    return "\n".join(out)


def title_of(text):
    found = re.search(r"^# (.*)$", text, re.MULTILINE)
    return found[1] if found else ""


def _first_sentence(text):
    for block in re.split(r"\n\s*\n", re.sub(r"<!--.*?-->", "", text)):
        words = " ".join(block.split())
        if words and not re.match(r"[#|!`<-]", words):
            return re.split(r"(?<=[.:])\s", words)[0]
    return ""


def _index(folder, names):
    """:returns: the index of a folder that has no README.md"""
    rows = []
    for name in names:
        text = text_of(f"docs/{folder}/{name}")
        rows.append(f"| [{title_of(text)}]({name}) | {re.sub(LINK, lambda m: m[2], _first_sentence(text))} |")
    return "\n".join([f"# {INDEX_TITLES.get(folder, folder.capitalize())}", "", "| page | |", "|---|---|", *rows]) + "\n"


def write(folder):
    """Writes all pages, pictures and data files of the documents below `folder`, which is made anew."""
    shutil.rmtree(folder, ignore_errors=True)
    for path in sorted([*TOPS, *_files()]):
        place = place_of(path)
        if place is None or not os.path.isfile(os.path.join(ROOT, path)):
            continue
        target = os.path.join(folder, place)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        if path.endswith(".md"):
            with open(target, "w", encoding="utf-8") as file:
                file.write(text_of(path))
        else:
            shutil.copy(os.path.join(ROOT, path), target)
    for name in sorted(os.listdir(folder)):
        pages = [p for p in sorted(os.listdir(os.path.join(folder, name))) if p.endswith(".md")] \
            if os.path.isdir(os.path.join(folder, name)) else []
        if pages and "index.md" not in pages:
            with open(os.path.join(folder, name, "index.md"), "w", encoding="utf-8") as file:
                file.write(_index(name, pages))


def _files():
    """:returns: files of docs/, below the checkout's root"""
    found = []
    for folder, _, names in os.walk(os.path.join(ROOT, "docs")):
        found += [os.path.relpath(os.path.join(folder, name), ROOT).replace(os.sep, "/") for name in names]
    return found
