# SPDX-License-Identifier: Apache-2.0
import sys

try:
    from patina.cli import interrupts

    interrupts.begin(sys.argv[1:2])
except KeyboardInterrupt:  # before there is anything that would handle it
    print("patina: interrupted", file=sys.stderr)
    sys.exit(75 if sys.argv[1:2] in (["record"], ["merge"], ["denoise"], ["farm"]) else 1)

interrupts.hold_standard_streams()

from patina.cli import ending  # noqa: E402
from patina.cli.main import main  # noqa: E402

sys.exit(ending.end(main()))
