#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures the rasterizer on a graphics card: testenv/bench/onCard.sh FOLDER
#
# Needs a built checkout (./patina test --tier unit) and a driver with EGL. Writes what docs/measurements/gpu.md is made of to
# FOLDER: the driver's name, each lobe beside double precision, first images, edits and moves of a viewport, and what the
# processor does for a frame. Takes some ten minutes; parts that fail leave their reason in their log.
set -u
folder=${1:?usage: testenv/bench/onCard.sh FOLDER}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1

part() { # NAME SECONDS COMMAND...
    local name=$1 seconds=$2
    shift 2
    echo "$name: $*"
    timeout "$seconds" "$@" >"$folder/$name.log" 2>&1 || echo "$name: status $?, see $folder/$name.log"
}

part driver 60 ./patina python -c 'import _patina; print(_patina.machine())'
part agreement 120 build/tests/testGlslAgreement
part pictures 120 ./patina test --room raster --tier smoke
part viewport 240 ./patina bench viewport --size 1280x720 --repeats 10 --runs 2 --json="$folder/viewport.json"
part frame 60 ./patina bench frame --repeats 20 --json="$folder/frame.json"
grep -h "^\[  FAILED\|worst" "$folder/agreement.log" | tail -40
