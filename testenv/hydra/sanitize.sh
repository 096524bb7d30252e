#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the Hydra plugin and its tests with sanitizers and runs them: 10,000 random edits while rendering,
# and everything that hosts do to a delegate. Each sanitizer has a build folder of its own.
#
#   testenv/hydra/sanitize.sh [address|thread|undefined|both] [EDITS] [BUILD_FOLDER] [--backend NAME] [--results]
#
# --backend raster or interactive: the edits are drawn by these, in place of the path tracer (embree). A driver in
# software takes seconds for a material: a hundred edits are many then.
#
# The edits come in runs of 5,000 by the delegate and as many by scene indices, each with a seed of its own
# from PATINA_HYDRA_SEED on (default 20240817). --results adds a row for each run to testenv/fuzz/results.json,
# of which docs/trust.md is made (address and thread).
#
# Without arguments (or with "both"): AddressSanitizer, then ThreadSanitizer, in BUILD_FOLDER-address and
# BUILD_FOLDER-thread. A summary ends the run: program, seconds, exit status, reports. The logs stay in the
# build folders.
#
# OpenUSD, TBB and Embree are not instrumented. AddressSanitizer does not need them to be, for what is
# allocated and freed passes through its allocator all the same. ThreadSanitizer does not see how they
# synchronise: our own loops run on plain threads then (hdDelegate/parallel.h), and OpenUSD, which shares
# inline functions with us, on the host's thread alone. So it watches the renderer's threads and the
# host's; prims that sync side by side are those of testHydraCore.
set -euo pipefail

results=""
backend=embree
words=()
while (($# > 0)); do
    case $1 in
    --results) results=yes ;;
    --backend) backend=${2:-}; [[ $# -lt 2 ]] || shift ;;
    *) words+=("$1") ;;
    esac
    shift
done
set -- "${words[@]}"
case $backend in
embree | raster | interactive) ;;
*) echo "sanitize.sh: unknown back end '$backend': embree, raster or interactive" >&2; exit 2 ;;
esac
export PATINA_HYDRA_BACKEND=$backend
kinds=${1:-both}
edits=${2:-10000}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
folder=${3:-$root/build}
supp=$root/testenv/sanitizers
case $kinds in
both) kinds="address thread" ;;
address | thread | undefined) ;;
*) echo "sanitize.sh: unknown sanitizer '$kinds': address, thread, undefined or both" >&2; exit 2 ;;
esac

# Interceptors come from the program, so the plugin's own copy may be loaded late.
export ASAN_OPTIONS=detect_odr_violation=0:strict_string_checks=1:detect_stack_use_after_return=1:suppressions=$supp/address.supp
export LSAN_OPTIONS=suppressions=$supp/leak.supp:print_suppressions=0
# g++ 12's library guesses the size of thread-local blocks of plugins from what lies before them, in vain with
# glibc 2.36 (it dies after some 1500 threads): intercept_tls_get_addr=0.
export TSAN_OPTIONS=suppressions=$supp/thread.supp:ignore_noninstrumented_modules=1:second_deadlock_stack=1:history_size=4:intercept_tls_get_addr=0
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1

# Runs a program of a build, and adds a line to the summary.
runProgram() {
    local program=$1 name=$2 code=0 start=$SECONDS reports fast log
    log=$build/$name.log
    # Without whole stacks leaks of OpenUSD's diagnostics are not known as such. They are slow; and beside llvmpipe,
    # whose compiler registers its frames, the unwinder would wait for itself.
    fast=$([[ $program == hydraEdits ]] && echo 1 || echo 0)
    ASAN_OPTIONS=$ASAN_OPTIONS:fast_unwind_on_malloc=$fast \
        "$build/tests/$program" 2>&1 | tee "$log" || code=${PIPESTATUS[0]}
    reports=$(grep -cE '(ERROR|WARNING): [A-Za-z]+Sanitizer|runtime error:' "$log" || true)
    summary+="$kind $name: $((SECONDS - start)) s, exit status $code, $reports reports"$'\n'
    [[ $code == 0 && $reports == 0 ]] || status=1
    [[ $program != hydraEdits || -z $results || $kind == undefined ]] ||
        python3 "$root/testenv/hydra/editResults.py" "$kind" "$backend" "$PATINA_HYDRA_SEED" "$PATINA_HYDRA_EDITS" \
            "$((SECONDS - start))" "$code" "$log"
}

firstSeed=${PATINA_HYDRA_SEED:-20240817}
status=0
summary=""
for kind in $kinds; do
    build=$folder-$kind
    # A folder that was named for one sanitizer is used as it is.
    [[ $kinds == "$kind" && -n ${3:-} ]] && build=$3
    if ! cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
        -DPATINA_SANITIZE="$kind" -DPATINA_BUILD_TESTS=ON ${PATINA_CMAKE_FLAGS:-} \
        >"$build.configure.log" 2>&1; then
        tail -20 "$build.configure.log" >&2
        summary+="$kind: not configured"$'\n'
        status=1
        continue
    fi
    if ! cmake --build "$build" --target hdPatina testHydraCore hydraLifetime hydraEdits; then
        summary+="$kind: not built"$'\n'
        status=1
        continue
    fi
    [[ $kind == thread ]] && export PXR_WORK_THREAD_LIMIT=1 || unset PXR_WORK_THREAD_LIMIT
    for program in testHydraCore hydraLifetime; do runProgram $program $program; done
    seed=$firstSeed
    for ((left = edits; left > 0; left -= 5000)); do
        export PATINA_HYDRA_SEED=$((seed++)) PATINA_HYDRA_EDITS=$((left < 5000 ? left : 5000))
        runProgram hydraEdits "hydraEdits$PATINA_HYDRA_SEED"
    done
done
printf '\n%s edits\n%s' "$edits" "$summary"
exit $status
