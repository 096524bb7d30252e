# SPDX-License-Identifier: Apache-2.0
import sys

try:
    from patina.cli import ending, interrupts

    interrupts.hold_standard_streams()
    from patina.cli.main import main
except KeyboardInterrupt:  # before there is anything that would handle it
    print("patina: interrupted", file=sys.stderr)
    sys.exit(1)

sys.exit(ending.end(main()))
