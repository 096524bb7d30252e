# SPDX-License-Identifier: Apache-2.0
"""Puts the line that names the licence at the head of every source file that has none.

    ./patina python testenv/licenceHeaders.py [--check]

With --check nothing is written, and files without the line are named. Files of data (JSON, lock files, stages, images, CSV) and
documents have none.
"""
import argparse
import os
import subprocess
import sys

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import checkout

    checkout.enter()

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
LINE = "SPDX-License-Identifier: Apache-2.0"
# ending or name -> what begins and ends a comment of one line
COMMENTS = {".h": "// ", ".cpp": "// ", ".inc": "// ", ".def": "// ", ".glsl": "// ", ".js": "// ", ".py": "# ", ".pyi": "# ",
            ".cmake": "# ", ".sh": "# ", "CMakeLists.txt": "# ", "patina": "# ", "patina.in": "# ", ".css": "/* ",
            ".mtlx": "<!-- ", "mkdocs.yml": "# ", "Doxyfile": "# ", "run": "# ", "cpp.dox": "// "}
ENDS = {"/* ": " */", "<!-- ": " -->"}
LEFT_OUT = ("testenv/stability/corpus/",  # documents as they failed
            "materialNetwork/glsl/tests/expected/")  # generated text, compared by the letter


def comment_of(path):
    """:returns: what begins the comment, or None for a file that has no such line"""
    name = os.path.basename(path)
    if path.startswith(LEFT_OUT):
        return None
    return COMMENTS.get(name) or COMMENTS.get(os.path.splitext(name)[1])


def files():
    """:returns: source files of the checkout, below its root; those that git does not ignore"""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            capture_output=True, text=True, check=True).stdout.split("\0")
    return sorted(path for path in listed if path and comment_of(path) and os.path.isfile(os.path.join(ROOT, path)))


def with_line(path, text):
    """:returns: the text with the line, behind what has to stand first"""
    comment = comment_of(path)
    line = comment + LINE + ENDS.get(comment, "") + "\n"
    first = text.partition("\n")[0]
    if first.startswith("#!") or first.startswith("<?xml"):
        return first + "\n" + line + text[len(first) + 1:]
    return line + text


def missing():
    """:returns: files without the line among their first three"""
    found = []
    for path in files():
        with open(os.path.join(ROOT, path), encoding="utf-8") as file:
            if LINE not in "".join(file.readline() for _ in range(3)):
                found.append(path)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing, fail where a file has no such line")
    a = parser.parse_args()
    found = missing()
    if a.check:
        sys.exit(f"without '{LINE}': {', '.join(found)}" if found else 0)
    for path in found:
        full = os.path.join(ROOT, path)
        with open(full, encoding="utf-8", newline="") as file:
            text = file.read()
        with open(full, "w", encoding="utf-8", newline="") as file:
            file.write(with_line(path, text))
    print(f"{len(found)} files")


if __name__ == "__main__":
    main()
