"""Runs what a tutorial says, in a folder of its own, and shows it.

    ./patina python testenv/tutorials/runTutorial.py docs/tutorials/firstPicture.md [FOLDER]
"""
import os
import sys
import tempfile

import tutorialBlocks


def main():
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__.strip())
    folder = os.path.abspath(sys.argv[2]) if len(sys.argv) == 3 else tempfile.mkdtemp(prefix="tutorial-")
    os.makedirs(folder, exist_ok=True)
    try:
        count = tutorialBlocks.run(os.path.abspath(sys.argv[1]), folder, say=lambda line: print(line, flush=True))
    except tutorialBlocks.BlockFailure as failure:
        sys.exit(str(failure))
    print(f"{count} blocks; the files are in {folder}")


if __name__ == "__main__":
    main()
