# SPDX-License-Identifier: Apache-2.0
"""Runs what a tutorial says, in a folder of its own, and shows it.

    ./patina python testenv/tutorials/runTutorial.py docs/tutorials/firstPicture.md [FOLDER]
"""
import argparse
import os
import sys
import tempfile

if __name__ == "__main__":
    here = os.path.dirname(os.path.abspath(__file__))
    sys.path[:0] = [here, os.path.dirname(here)]
    import checkout

    checkout.enter()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tutorial")
    parser.add_argument("folder", nargs="?", help="kept; without it a new one that is named at the end")
    a = parser.parse_args()
    import tutorialBlocks

    folder = os.path.abspath(a.folder) if a.folder else tempfile.mkdtemp(prefix="tutorial-")
    os.makedirs(folder, exist_ok=True)
    try:
        count = tutorialBlocks.run(os.path.abspath(a.tutorial), folder, say=lambda line: print(line, flush=True))
    except tutorialBlocks.BlockFailure as failure:
        sys.exit(str(failure))
    print(f"{count} blocks; the files are in {folder}")


if __name__ == "__main__":
    main()
