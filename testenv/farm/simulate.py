# SPDX-License-Identifier: Apache-2.0
"""The speed of farms of other sizes, by the seconds of a part, a merge and a task of the sender.

    ./patina python testenv/farm/simulate.py --part 3.5 --merge 0.5 --sender 0.001 --frames 240 --parts 16
"""
import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

import checkout  # noqa: E402

checkout.enter()

from patina.farm import simulation  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--part", type=float, nargs="+", required=True, metavar="SECONDS",
                        help="of parts; each takes one by chance")
    parser.add_argument("--merge", type=float, nargs="+", required=True, metavar="SECONDS")
    parser.add_argument("--sender", type=float, required=True, metavar="SECONDS")
    parser.add_argument("--frames", type=int, default=240)
    parser.add_argument("--parts", type=int, default=16)
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2, 10, 100, 1000])
    a = parser.parse_args()
    costs = simulation.Costs(tuple(a.part), tuple(a.merge), a.sender)
    print("\n".join(simulation.table(costs, a.frames, a.parts, a.workers)))


if __name__ == "__main__":
    main()
