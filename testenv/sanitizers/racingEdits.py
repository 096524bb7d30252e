# SPDX-License-Identifier: Apache-2.0
"""Random edits by two threads while the path tracer renders, without Hydra, under ThreadSanitizer.

    ./patina python testenv/sanitizers/racingEdits.py --seconds 600 [--seed 1] [--build FOLDER] [--results]

Builds testEmbree for it (preset tsan; loops run on plain threads there, since TBB is not instrumented) and runs its test
EditsWhileRendering again and again, each time with another seed. What is reported is printed once per place; exit status 1
where there is anything.
"""
import argparse
import os
import re
import subprocess
import sys
import time

if __name__ == "__main__":
    sys.path.insert(0, os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")))
    import checkout

    checkout.enter()

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", ".."))
EDITS = 100  # of each thread in one run
THREADS = 2  # that edit, see testEditsWhileRendering.cpp
SECONDS = 900  # after which a run counts as hanging
_REPORT = re.compile(r"WARNING: ThreadSanitizer: (.*?) \(pid=\d+\)(.*?)SUMMARY: ThreadSanitizer: (.*?)\n", re.DOTALL)


def build(folder):
    for command in (["cmake", "-S", ROOT, "--preset", "tsan", "-B", folder, "-DPATINA_MODULE=OFF",
                     "-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1",
                     "-DCMAKE_DISABLE_FIND_PACKAGE_pxr=ON"], ["cmake", "--build", folder, "--target", "testEmbree"]):
        if subprocess.call(command, cwd=ROOT, stdout=subprocess.DEVNULL):
            sys.exit(f"racingEdits.py: {' '.join(command[:3])} ... failed")


def once(program, seed):
    """:returns: (kind, reason) of each place that is reported, and the words of the program"""
    environment = dict(os.environ, PATINA_EDITS=str(EDITS), PATINA_EDITS_SEED=str(seed), TSAN_OPTIONS=(
        f"suppressions={HERE}/thread.supp:ignore_noninstrumented_modules=1:second_deadlock_stack=1:history_size=4"))
    try:
        done = subprocess.run([program, "--gtest_filter=EditsWhileRendering.*"], env=environment, timeout=SECONDS,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    except subprocess.TimeoutExpired as error:
        return [("hang", f"seed {seed} does not end")], str(error)
    found = {("report", f"{kind}: {where}") for kind, _, where in _REPORT.findall(done.stdout)}
    if not found and done.returncode:
        found = {("crash" if done.returncode < 0 else "promise", f"seed {seed} ends with {done.returncode}")}
    return sorted(found), done.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", default=os.path.join(ROOT, "build-tsan"))
    parser.add_argument("--no-build", action="store_true", help="take the program that is there")
    parser.add_argument("--results", nargs="?", const="", metavar="FILE",
                        help="add the figures to this table (default: testenv/fuzz/results.json)")
    a = parser.parse_args()
    if not a.no_build:
        build(a.build)
    start, seed, counts, findings = time.monotonic(), a.seed, {}, {}
    while seed == a.seed or time.monotonic() - start < a.seconds:
        found, words = once(os.path.join(a.build, "tests", "testEmbree"), seed)
        for kind, reason in found:
            counts[kind] = counts.get(kind, 0) + 1
            if reason not in findings:
                findings[reason] = (kind, reason)
                print(f"seed {seed}: {kind}: {reason}\n{words[-6000:]}", flush=True)
        seed += 1
    edits = (seed - a.seed) * EDITS * THREADS
    seconds = time.monotonic() - start
    print(f"{edits} edits in {seed - a.seed} runs, {seconds:.0f} s, {len(findings)} findings")
    if a.results is not None:
        sys.path.insert(0, os.path.join(ROOT, "testenv", "fuzz"))
        import results

        counts["fine"] = edits - sum(counts.values())
        results.append([results.row("racingEdits", a.seed, {"inputs": edits, "seconds": seconds, "counts": counts,
                                                            "findings": list(findings.values())})], a.results or results.FILE)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
