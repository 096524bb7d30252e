# SPDX-License-Identifier: Apache-2.0
"""Which stages of a folder are tested, and how: `scenes.json` in the folder, where it is not as the defaults say."""
import dataclasses
import fnmatch
import glob
import json
import os

ENDINGS = (".usd", ".usda", ".usdc", ".usdz")
FILE = "scenes.json"
GOLDEN = "golden"


class SceneError(Exception):
    """scenes.json cannot be used; the text says where and why."""


@dataclasses.dataclass(frozen=True)
class Scene:
    """How one stage is tested.

    `arguments`: of `patina record` after the image, without --seed; `renders`: with seeds of their own, 2 or more;
    `margin`: relative difference of a tile's mean that is taken, 0 or more; `sees`: relative difference that the test has to be
    able to show, above `margin`: where noise hides it, the test fails and asks for samples"""
    arguments: tuple = ("--imageWidth", "160", "--samples", "32")
    renders: int = 8
    margin: float = 0.01
    sees: float = 0.05


def _checked(values, place):
    known = {field.name for field in dataclasses.fields(Scene)}
    for name in values:
        if name not in known:
            raise SceneError(f"{place}: there is no '{name}' (there are: {', '.join(sorted(known))})")
    arguments = values.get("arguments", [])
    if not isinstance(arguments, list) or not all(isinstance(a, str) for a in arguments):
        raise SceneError(f"{place}: arguments is a list of texts, such as [\"-w\", \"320\"]")
    if any(a == "--seed" or a.startswith("--seed=") for a in arguments):
        raise SceneError(f"{place}: --seed is chosen by the test")
    renders, margin = values.get("renders", 2), values.get("margin", 0.0)
    if type(renders) is not int or not 2 <= renders <= 1000:
        raise SceneError(f"{place}: renders is a whole number from 2 to 1000")
    if type(margin) not in (int, float) or not 0.0 <= margin < float("inf"):
        raise SceneError(f"{place}: margin is a number of 0 or more")
    sees = values.get("sees", 0.05)
    if type(sees) not in (int, float) or not margin < sees < float("inf"):
        raise SceneError(f"{place}: sees is a number above the margin")
    return dict(values, arguments=tuple(arguments)) if "arguments" in values else values


class Folder:
    """A folder of stages."""

    def __init__(self, path):
        """:raises SceneError: where there is no such folder, or its scenes.json cannot be used"""
        self.path = os.path.abspath(path)
        if not os.path.isdir(self.path):
            raise SceneError(f"there is no folder {path}")
        self._patterns, self._rules = None, []
        file = os.path.join(self.path, FILE)
        if not os.path.exists(file):
            return
        try:
            with open(file, encoding="utf-8") as stream:
                data = json.load(stream)
        except (ValueError, OSError) as error:
            raise SceneError(f"{file}: {error}") from None
        if not isinstance(data, dict):
            raise SceneError(f"{file}: an object is expected, with `stages` and names of stages")
        for name, values in data.items():
            if name == "stages":
                if not isinstance(values, list) or not all(isinstance(v, str) for v in values):
                    raise SceneError(f"{file}: stages is a list of patterns, such as [\"shots/**/*.usda\"]")
                self._patterns = values
            elif not isinstance(values, dict):
                raise SceneError(f"{file}: {name} is an object, such as {{\"renders\": 8}}")
            else:
                self._rules.append((name, _checked(values, f"{file}: {name}")))

    def names(self):
        """:returns: paths of the stages below the folder, with /; without `stages`, those that lie in the folder itself"""
        patterns = self._patterns or ["*" + ending for ending in ENDINGS]
        found = set()
        for pattern in patterns:
            for path in glob.glob(os.path.join(glob.escape(self.path), pattern), recursive=True):
                name = os.path.relpath(path, self.path).replace(os.sep, "/")
                if os.path.isfile(path) and name.endswith(ENDINGS) and name.split("/")[0] != GOLDEN:
                    found.add(name)
        return sorted(found)

    def scene(self, name):
        """:returns: how a stage is tested: rules in their order, where the pattern matches, the later over the earlier"""
        chosen = Scene()
        for pattern, values in self._rules:
            if fnmatch.fnmatchcase(name, pattern):
                chosen = dataclasses.replace(chosen, **values)
        return chosen

    def golden(self, name, ending):
        """:param ending: .npz (numbers that the test reads) or .exr (the mean image, to look at)
        :returns: the path of a golden file"""
        return os.path.join(self.path, GOLDEN, *(name + ending).split("/"))
