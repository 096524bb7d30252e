# SPDX-License-Identifier: Apache-2.0
"""Makes one stage ready for all ways: with a camera and a light where it has none. A process of its own: reading may fail.

Usage: prepare.py STAGE FOLDER WIDTH HEIGHT OUT.json"""
import json
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "..", "hydra")]

import hydraBuild  # noqa: E402
import stages  # noqa: E402
from usda import prim  # noqa: E402

# Light from the eye shows which way a surface looks; what is behind the camera must not hide it.
LIGHT = (
    prim("DistantLight", "conformanceEye", "bool inputs:shadow:enable = 0", angle=2, normalize=True, intensity=2.4,
         apis=("ShadowAPI",), matrix="( @rows@ )")
    + prim("DomeLight", "conformanceDome", intensity=0.25))
SHAPES = ("Mesh", "Curves", "Points", "Implicit", "Volume")


def prepared(stage, folder, size):
    """:returns: dict of what the ways need: stage, camera, frame, size; `shapes`, the kinds that are drawn; `unreadable`, why
        this OpenUSD cannot open the stage, or None"""
    from patina import stage as reader

    shot = stages.Shot(stage, folder, light=LIGHT)
    kinds = {line.partition(" ")[0] for line in shot.scene.dump().splitlines() if line and not line.startswith(" ")}
    hydra = None if hydraBuild.missing() else hydraBuild.unreadable(reader.open_stage(stage))
    return {"stage": shot.stage, "camera": shot.camera, "frame": shot.frame, "size": fitted(shot.size, size),
            "shapes": [kind for kind in SHAPES if kind in kinds], "unreadable": hydra}


def fitted(shape, most):
    """:returns: width and height of a shape's proportions that fit into the other"""
    scale = min(most[0] / shape[0], most[1] / shape[1])
    return [max(1, round(shape[0] * scale)), max(1, round(shape[1] * scale))]


def main():
    stage, folder, width, height, out = sys.argv[1:]
    from patina import stage as reader

    try:
        found = prepared(stage, folder, (int(width), int(height)))
    except reader.StageError as error:
        sys.exit(f"patina: {error}")
    with open(out, "w", encoding="utf-8") as file:
        json.dump(found, file)


if __name__ == "__main__":
    main()
