#!/usr/bin/env bash
# Builds the Hydra plugin and its tests with a sanitizer and runs them: 10,000 random edits while rendering,
# and everything that hosts do to a delegate. Each sanitizer has a build folder of its own.
#
#   testenv/hydra/sanitize.sh address|thread|undefined [EDITS] [BUILD_FOLDER]
#
# OpenUSD, TBB and Embree are not instrumented. AddressSanitizer does not need them to be, for what is
# allocated and freed passes through its allocator all the same. ThreadSanitizer does not see how they
# synchronise; testenv/sanitizers/thread.supp says which reports that explains.
set -euo pipefail

kind=${1:?which sanitizer: address, thread or undefined}
edits=${2:-10000}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
build=${3:-$root/build-$kind}
supp=$root/testenv/sanitizers

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DPATINA_SANITIZE="$kind" \
    -DPATINA_BUILD_TESTS=ON ${PATINA_CMAKE_FLAGS:-} >"$build.configure.log" 2>&1 ||
    { tail -20 "$build.configure.log" >&2; exit 1; }
cmake --build "$build" --target hdPatina hydraEdits hydraLifetime

# Interceptors come from the program, so the plugin's own copy may be loaded late.
export ASAN_OPTIONS=detect_odr_violation=0:strict_string_checks=1:detect_stack_use_after_return=1:suppressions=$supp/address.supp
export LSAN_OPTIONS=suppressions=$supp/leak.supp:print_suppressions=0
export TSAN_OPTIONS=suppressions=$supp/thread.supp:ignore_noninstrumented_modules=1:second_deadlock_stack=1:history_size=4
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export PATINA_HYDRA_EDITS=$edits
status=0
for program in hydraLifetime hydraEdits; do
    "$build/tests/$program" || status=1
done
exit $status
