#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the files of a release (`patina release`) and uses each as its users do: the wheel in a fresh Python environment, the
# .deb with the system's Python, the tarball where it is unpacked, and the example host against what the .deb holds. All must
# render the same bits, with the library of every level that the processor has.
#
#   testenv/package/everyPackage.sh FOLDER [--install]
#
# FOLDER takes what is made. Without --install the system stays as it is: the .deb is unpacked, and its dependencies are looked
# up. With it (root, on a Debian that may be changed) missing packages are installed, and the .deb as well, by apt.
# Exit status 3: this machine lacks something, which is said.
set -euo pipefail

[ $# -ge 1 ] || { sed -n '2,11s/^# \{0,1\}//p' "$0" >&2; exit 2; }
checkout=$(cd "$(dirname "$0")/../.." && pwd -P)
mkdir -p "$1"
folder=$(cd "$1" && pwd -P)
install=${2:-}
log=$folder/log
: >"$log"

say() { printf 'everyPackage: %s\n' "$*"; }
lacks() { say "$*"; exit 3; }
loudly() { # a step whose output is of interest only where it fails
    printf '\n$ %s\n' "$*" >>"$log"
    "$@" >>"$log" 2>&1 || { tail -n 40 "$log" >&2; say "failed: $*"; exit 1; }
}

if [ "$install" = --install ]; then
    [ "$(id -u)" = 0 ] || lacks "--install needs the rights of root"
    # The page's own line, so that it is known to be enough.
    wanted=$(awk '/^    apt-get install --/ {on = 1} on {more = sub(/\\$/, ""); printf "%s ", $0; if (!more) exit}' \
        "$checkout/docs/install.md")
    export DEBIAN_FRONTEND=noninteractive
    loudly apt-get update -q
    loudly ${wanted/apt-get install/apt-get install -y -q}
fi
for program in c++ cmake ninja dpkg-deb dpkg-shlibdeps file npm python3; do
    command -v $program >/dev/null || lacks "$program is missing"
done
python3 -c 'import venv, ensurepip' 2>/dev/null || lacks "python3-venv is missing"

stage=$folder/stage
mkdir -p "$stage"
cp -r "$checkout/testenv/scenes/"{texturedDiffuse.usda,shaderball.usda,textures} "$stage"
cd "$stage" # not in the checkout
loader=/lib64/ld-linux-x86-64.so.2
levels=$("$loader" --help 2>/dev/null || true) # of glibc 2.33 or later: those of the processor are said to be supported
render() { # NAME PYTHON COMMAND...: an image of the path tracer, and one of the rasterizer
    local name=$1; shift
    loudly "$@" record texturedDiffuse.usda "$folder/$name.exr" -w 96 --samples 4 --quiet
    loudly "$@" record shaderball.usda "$folder/$name.png" --backend raster -w 96 --samples 1 --strict --quiet
    say "$name renders"
}
same() { # NAME NAME: whether two images have equal bits
    loudly "$folder/wheel/bin/python" -c '
import sys, numpy, _patina
a, b = (numpy.array(_patina.read_image(name).pixels) for name in sys.argv[1:3])
assert a.shape == b.shape and a.std() > 0.0 and numpy.array_equal(a, b), sys.argv[1:]' "$folder/$1.exr" "$folder/$2.exr"
}

# The files of a release.
rm -rf "$folder/dist"
loudly env PATINA_BUILD_DIR="$folder/build" "$checkout/patina" release "$folder/dist" --uncommitted
(cd "$folder/dist" && loudly sha256sum --check --strict SHA256SUMS)

# The wheel.
wheel=$(ls "$folder"/dist/*-linux_*.whl)
loudly python3 -m venv --clear "$folder/wheel"
loudly "$folder/wheel/bin/pip" install "$wheel"
say "the wheel: $(du -h "$wheel" | cut -f1)"
render wheel "$folder/wheel/bin/patina"

[ ! -e "$folder"/wheel/lib/python3*/site-packages/plugin ] || { say "failed: the wheel has Hydra's plugin, for one host"; exit 1; }

# The same with all libraries in it, as another machine installs it.
wheel=$(ls "$folder"/dist/*-manylinux_*.whl)
say "the wheel with libraries: $(du -h "$wheel" | cut -f1)"
[ "$(stat -c %s "$wheel")" -lt 200000000 ] || { say "failed: the wheel is larger than 200 MB"; exit 1; }
loudly python3 -m venv --clear "$folder/wholeWheel"
loudly "$folder/wholeWheel/bin/pip" install "$wheel"
render whole "$folder/wholeWheel/bin/patina"
loudly "$folder/wholeWheel/bin/patina" record texturedDiffuse.usda "$folder/denoised.exr" -w 96 --samples 1 --denoise --quiet
same wheel whole
outside=$("$folder/wholeWheel/bin/python" -c '
import _patina, os, sys
found = {line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}
print(*(path for path in found if not path.startswith(sys.prefix)))')
for path in $outside; do
    case $(basename "$path") in
    libOpenImageIO* | libembree* | libosd* | libtbb* | libOpenEXR* | libopenvdb* | libOpenColorIO*)
        say "failed: the wheel with libraries uses $path"; exit 1 ;;
    esac
done

# The library of each level: the loader is told to look for no higher one.
package=$("$folder/wheel/bin/python" -c 'import os, patina; print(os.path.dirname(patina.__file__))')
[ -s "$package/view/web/page.js" ] || { say "failed: the wheel has no script of the material page"; exit 1; }
for level in lowest $(ls "$package/lib/glibc-hwcaps"); do
    case $level,$levels in
    lowest,*glibc-hwcaps-mask* | *"$level (supported"*) ;;
    *) say "the library of level $level is not tried: the loader or the processor knows none"; continue ;;
    esac
    name=wheel-$level
    of_level=(env PYTHONSAFEPATH=1 "$loader" --glibc-hwcaps-mask "$level" "$folder/wheel/bin/python")
    loaded=$("${of_level[@]}" -c 'import _patina; print(*{line.split()[-1] for line in open("/proc/self/maps") if "libpatina" in line})')
    case $level,$loaded in
    lowest,*/glibc-hwcaps/*) say "failed: $loaded is loaded where no level is looked for"; exit 1 ;;
    lowest,*/libpatina.so | *,*/glibc-hwcaps/$level/libpatina.so) ;;
    *) say "failed: $loaded is loaded for $level"; exit 1 ;;
    esac
    loudly "${of_level[@]}" -m patina record texturedDiffuse.usda "$folder/$name.exr" -w 96 --samples 4 --quiet
    same wheel "$name"
    say "the library of level $level gives the same bits"
done

# The .deb and the tarball.
deb=$(ls "$folder"/dist/*.deb)
say "the .deb: $(du -h "$deb" | cut -f1), depends on $(dpkg-deb -f "$deb" Depends)"
if [ "$install" = --install ]; then
    loudly apt-get install -y -q --no-install-recommends "$deb"
    prefix=/usr
else
    loudly dpkg-deb -x "$deb" "$folder/unpacked"
    prefix=$folder/unpacked/usr
    dpkg-deb -f "$deb" Depends | tr ',' '\n' | sed 's/|.*//; s/(.*//; s/ //g' | while read -r package; do
        dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
            lacks "the .deb depends on $package, which is not installed"
    done
fi
loudly /usr/bin/python3 -m venv --clear --system-site-packages "$folder/system" # it sees the .deb's python3-numpy
loudly "$folder/system/bin/pip" install usd-core
PATINA_PYTHON=$folder/system/bin/python render deb "$prefix/bin/patina"
same wheel deb
mkdir -p "$folder/tarball"
loudly tar -xf "$folder"/dist/*.tar.gz -C "$folder/tarball" --strip-components=1
PATINA_PYTHON=$folder/system/bin/python render tarball "$(find "$folder/tarball" -path '*/bin/patina')"
same wheel tarball

# A host in C++.
options=()
[ "$prefix" = /usr ] || options=("-DCMAKE_PREFIX_PATH=$prefix")
loudly cmake -G Ninja -S "$checkout/docs/examples/host" -B "$folder/host" ${options[@]+"${options[@]}"}
loudly cmake --build "$folder/host"
loudly "$folder/host/host" "$folder/host.exr"
loudly "$folder/host/host" "$folder/host.png" raster
say "the example renders"

if [ "$install" = --install ]; then
    loudly apt-get remove -y -q hdpatina
    [ -z "$(find /usr/lib /usr/include /usr/bin -iname '*patina*' -print -quit)" ] || { say "apt-get remove leaves files"; exit 1; }
    say "the .deb is removed without a trace"
fi
say "all is well"
