# SPDX-License-Identifier: Apache-2.0
"""Writes plugin/python/_patina.pyi, the typed interface of the compiled module, from the module; with --check tells whether it
is stale.

    ./patina python testenv/generateStubs.py [--check]

Signatures and docstrings come from the bindings by pybind11-stubgen. Facts that the bindings cannot say are added here: what
arrays are, and the keywords of SceneEdit.set_...(), which the sources list.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import checkout

    checkout.enter()

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
BINDINGS = os.path.join(ROOT, "plugin", "python")
STUB = os.path.join(BINDINGS, "_patina.pyi")
NOTE = "# SPDX-License-Identifier: Apache-2.0\n# Made by `./patina python testenv/generateStubs.py`; edits are lost.\n"
ARRAY = r"numpy\.ndarray\[numpy\.(float32|int32)\]"


def missing():
    """:returns: why no stub can be made here, or an empty text"""
    try:
        import _patina
        import pybind11_stubgen  # noqa: F401
    except ImportError as error:
        return str(error)
    if not hasattr(_patina, "RasterProbe"):
        return "this build has no rasterizer, so the module is not whole"
    return ""


def _source(name):
    with open(os.path.join(BINDINGS, name), encoding="utf-8") as file:
        return file.read()


def _keywords():
    """:returns: {method: keywords of a setter of SceneEdit, as the bindings read them}"""
    found, common = {}, []
    tables = {}
    for table in ("lightTypes.inc", "cameraTypes.inc"):
        with open(os.path.join(ROOT, "hdDelegate", "scene", table), encoding="utf-8") as file:
            tables[table] = re.findall(r'^PATINA_\w+_INPUT\([\w:, ]*?\s*"(\w+)"', file.read(), re.MULTILINE)
    for name in ("bindSceneGeometry.cpp", "bindScene.cpp"):
        source = _source(name)
        start = re.search(r"Fields& readCommon.*?\n}", source, re.DOTALL)
        common = re.findall(r'\.read\("(\w+)"', start[0]) if start else common
        for body in re.findall(r"^void set\w+\(PythonEdit.*?^}", source, re.MULTILINE | re.DOTALL):
            method = re.search(r'Fields(?: fields)?\("(\w+)"', body)
            if method:
                own = re.findall(r'\.read\(\s*"(\w+)"', body)
                rows = [key for table, keys in tables.items() if table in body for key in keys]
                found[method[1]] = (common if "readCommon(" in body else []) + own + rows
    return found


def _with_keywords(text):
    for method, names in _keywords().items():
        listed = ", ".join(names)
        text, count = re.subn(rf'(def {method}\(self, path: str, \*\*kwargs)(\) -> None:\n(\s+)"""\n)(.*?)(\n\s+""")',
                              lambda m: f"{m[1]}: typing.Any{m[2]}{m[4]}\n{m[3]}Keywords: {listed}.{m[5]}", text,
                              flags=re.DOTALL)
        if count != 1:
            raise ValueError(f"SceneEdit.{method} is not in the stub as expected")
    return text


def text():
    """:returns: what the stub has to hold"""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, "-m", "pybind11_stubgen", "_patina", "-o", folder, "--exit-code"],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise ValueError(f"pybind11-stubgen: {done.stderr.strip()[-1000:]}")
        with open(os.path.join(folder, "_patina.pyi"), encoding="utf-8") as file:
            made = file.read()
    made = re.sub(r'^"""\n.*?^"""\n', '"""The compiled part of Patina; docs/api/module.md says what values look like."""\n',
                  made, count=1, flags=re.MULTILINE | re.DOTALL)
    made = re.sub(r"^__all__.*\n", "", made, flags=re.MULTILINE)  # the module has none
    made = re.sub(r"list\[(float|int)\[\d+\]\]", r"typing.Sequence[\1]", made)
    made = re.sub("-> " + ARRAY, r"-> numpy.typing.NDArray[numpy.\1]", made)
    made = re.sub(r"-> numpy\.ndarray:", "-> numpy.typing.NDArray[typing.Any]:", made)
    made = re.sub(ARRAY, "numpy.typing.ArrayLike", made).replace("import numpy\n", "import numpy\nimport numpy.typing\n", 1)
    made = made.replace("def __exit__(self, *args) -> None", "def __exit__(self, *args: typing.Any) -> None")
    made = made.replace("def __enter__(self) -> typing.Any", "def __enter__(self) -> SceneEdit")
    made = made.replace("errors: PartialErrors = None", "errors: PartialErrors | None = None")
    made = re.sub(r"\bdict(?=[\s,)\]:=])", "dict[str, typing.Any]", made)
    made = re.sub(r"-> (list|tuple):", r"-> \1[typing.Any, ...]:", made).replace("list[typing.Any, ...]", "list[typing.Any]")
    return NOTE + _with_keywords(made)


def is_stale():
    if not os.path.isfile(STUB):
        return True
    with open(STUB, encoding="utf-8") as file:
        return file.read() != text()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing, fail where the stub is stale")
    a = parser.parse_args()
    if missing():
        sys.exit(missing())
    if a.check:
        sys.exit("stale: plugin/python/_patina.pyi" if is_stale() else 0)
    made = text()
    with open(STUB, "w", encoding="utf-8") as file:
        file.write(made)
    print("wrote plugin/python/_patina.pyi")


if __name__ == "__main__":
    main()
