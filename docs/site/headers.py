# SPDX-License-Identifier: Apache-2.0
"""Doxygen's pages made fit for screen readers: a language, a title, and a name for all that can be operated."""
import html
import os
import re


def improve(folder):
    """:param folder: of Doxygen's pages, which are changed where they lie"""
    for here, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(here, name)
            if name.endswith((".html", ".js")):
                with open(path, encoding="utf-8") as file:
                    text = file.read()
                found = improved(text, name) if name.endswith(".html") else named_field(text)
                if found != text:
                    with open(path, "w", encoding="utf-8") as file:
                        file.write(found)


def named_field(text):
    field = '<input type="text" id="MSearchField"'
    return re.sub(field + "(?! aria)", field + ' aria-label="Search"', text)


def improved(text, name):
    """:param name: of the page's file, its title where it has none
    :returns: the page's text"""
    text = re.sub(r"<html\b(?![^>]*\blang=)", '<html lang="en"', text, count=1)
    if not re.search(r"<title>[^<]", text):
        title = html.escape("Search: " + os.path.splitext(name)[0].replace("_", " "))
        text = re.sub(r"<head>(<title></title>)?", f"<head><title>{title}</title>", text, count=1)
    # The icon of a file in lists leads to its source.
    text = re.sub(r'<a href="([^"]+)">(<span class="icondoc"></span>)</a>',
                  r'<a href="\1" aria-label="source">\2</a>', text)
    return named_field(text)
