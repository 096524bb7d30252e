# SPDX-License-Identifier: Apache-2.0
"""Pages of one file, and their Content-Security-Policy: they run the script that they were made with, load nothing and send
nothing, whatever the names of a stage hold."""
import base64
import hashlib
import os
import re


def meta(script=""):
    """:param script: the text of the one script element that may run; none: no script may
    :returns: the element that stands first in a page's head (W3C, Content Security Policy Level 3)"""
    rules = ["default-src 'none'", "style-src 'unsafe-inline'", "img-src data: blob:", "font-src data:", "base-uri 'none'",
             "form-action 'none'"]
    if script:
        digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
        rules.insert(1, f"script-src 'sha256-{digest}'")
    return f'<meta http-equiv="Content-Security-Policy" content="{"; ".join(rules)}">'


def text(*path):
    """:returns: what a file holds"""
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def filled(page, script, **parts):
    """:param page: text in which PATINA_NAME stands for a part; SCRIPT and POLICY are among them
    :returns: the page"""
    parts.update(SCRIPT=script, POLICY=meta(script))
    # In one go: what is put in may hold the names of these places.
    return re.sub(f"PATINA_({'|'.join(parts)})", lambda mark: parts[mark.group(1)], page)
