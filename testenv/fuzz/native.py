# SPDX-License-Identifier: Apache-2.0
"""libFuzzer's programs: built in a folder of their own, run for a time, their corpora and findings kept small."""
import json
import os
import re
import shutil
import subprocess

import following

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
HANG_SECONDS = 120  # of the clock: an empty image took 20 where sixteen processes shared two cores
MEGABYTES = 2048
_REASONS = ((r"promise broken: (.*)", "promise"), (r"ERROR: AddressSanitizer: ([\w-]+)", "crash"),
            (r"runtime error: (.*)", "crash"),
            (r"ERROR: libFuzzer: timeout", "hang"), (r"ERROR: libFuzzer: out-of-memory", "memory"),
            (r"ERROR: LeakSanitizer: (.*)", "memory"), (r"ERROR: libFuzzer: (.*)", "crash"))
# The first frame of a crash that is no sanitizer's is in the reader of a format: Patina could not have known.
_LIBRARY = re.compile(r"ERROR: AddressSanitizer: .*\n(?:(?! +#0 ).*\n){0,4}(?: +#\d+ 0x\w+ in (?:__|mem|operator).*\n)*"
                      r" +#\d+ 0x\w+ in ([^\s(]+).*\(/\S*/(lib(?:OpenImageIO|OpenEXR|tiff|png|jpeg|z)\b)")


class Missing(Exception):
    """Why there are no programs, in one line."""


def build(folder, names, jobs=1):
    """Builds programs where that was not done yet.

    :param folder: the instrumented build
    :raises Missing: without clang, or where the build fails"""
    if not shutil.which("clang++"):
        raise Missing("clang++ is missing (Debian: apt-get install clang llvm libclang-rt-dev)")
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "fuzz.log"), "w", encoding="utf-8") as log:
        for command in (["cmake", "-S", ROOT, "--preset", "fuzz", "-B", folder],
                        ["cmake", "--build", folder, "-j", str(jobs), "--target", *(f"fuzz_{name}" for name in names)]):
            if subprocess.call(command, stdout=log, stderr=log, cwd=ROOT):
                raise Missing(f"the instrumented build failed, see {log.name}")


def _environment(fuzzer, scratch, profile=None):
    # The stack of each allocation, which took a tenth of an input's time, is told of leaks alone.
    stacks = "" if fuzzer.leaks else ":malloc_context_size=1"
    return dict(os.environ, TMPDIR=scratch,
                ASAN_OPTIONS=f"detect_leaks={int(fuzzer.leaks)}:allocator_may_return_null=1:handle_abort=1{stacks}",
                UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1", LLVM_PROFILE_FILE=profile or os.devnull)


def _why(text):
    """:returns: (kind, reason) of a program's last words"""
    died = _LIBRARY.search(text)
    if died:
        return "library", f"{died.group(1)[:80]} in {died.group(2)}"
    for pattern, kind in _REASONS:
        match = re.search(pattern, text)
        if match:
            frame = re.search(r"#\d+ 0x\w+ in (patina::\S+)[^\n]*?([\w./]+:\d+)?", text)
            reason = re.sub(r"0x[0-9a-f]+", "*", match.group(1)) if match.groups() else pattern.rpartition(" ")[2]
            return kind, f"{reason[:120]}" + (f" in {frame.group(1)[:80]}" if frame else "")
    return "crash", (text.strip().splitlines() or ["no words"])[-1][:160]


def run(name, fuzzer, folder, corpus, seconds, plateau, seed, say):
    """As following.search(). The corpus is minimised at the end."""
    program = os.path.join(folder, "fuzzers", name)

    def lines(work, scratch):
        reached = _coverage(program, work, fuzzer, scratch)
        _keep_small(program, work, scratch, fuzzer)
        return reached

    return following.search(
        name, [program, f"-timeout={HANG_SECONDS}", f"-rss_limit_mb={MEGABYTES}", "-use_value_profile=0",
               "-entropic=0"],  # weighing inputs by what is rare costs time, and reached no more edges in runs of 40 s
        corpus, seconds, plateau, seed, say, lambda _, said: _why(said),
        lambda file, kind, scratch: _minimise(program, file, kind, scratch, fuzzer), lines,
        lambda scratch: {"cwd": scratch, "env": _environment(fuzzer, scratch)}, program)


def _minimise(program, file, kind, scratch, fuzzer):
    """:returns: the bytes of the smallest input that still fails, found within half a minute"""
    smaller = os.path.join(scratch, "smaller")
    if kind == "crash" or kind == "promise":
        subprocess.run([program, "-minimize_crash=1", "-max_total_time=30", f"-exact_artifact_path={smaller}", file],
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=scratch, env=_environment(fuzzer, scratch))
    with open(smaller if os.path.exists(smaller) else file, "rb") as stream:
        data = stream.read()
    if os.path.exists(smaller):
        os.remove(smaller)
    return data


def _keep_small(program, work, scratch, fuzzer):
    """Leaves only inputs that reach code that no other of them reaches. All that are kept lie there before one is removed."""
    merged = os.path.join(scratch, "merged")
    os.makedirs(merged)
    done = subprocess.run([program, "-merge=1", merged, work], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          cwd=scratch, env=_environment(fuzzer, scratch))
    kept = set(os.listdir(merged))
    if done.returncode or not kept:
        return
    half = os.path.join(work, ".half")  # a copy that ends early must not stand for a whole input
    for name in kept:
        shutil.copy(os.path.join(merged, name), half)
        os.replace(half, os.path.join(work, name))
    for file in list(os.scandir(work)):
        if file.name not in kept and file.is_file(follow_symlinks=False):
            os.remove(file.path)


def _coverage(program, work, fuzzer, scratch):
    """:returns: (lines that the corpus reaches, lines that there are) of the sources that a fuzzer is for; None without llvm"""
    profdata, cov = (shutil.which(name) or shutil.which(name + "-14") for name in ("llvm-profdata", "llvm-cov"))
    if not profdata or not cov:
        return None
    raw, indexed = os.path.join(scratch, "raw"), os.path.join(scratch, "indexed")
    subprocess.run([program, work, "-runs=0"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=scratch,
                   env=_environment(fuzzer, scratch, raw))
    if not os.path.exists(raw) or subprocess.call([profdata, "merge", "-sparse", raw, "-o", indexed],
                                                  stderr=subprocess.DEVNULL):
        return None
    told = subprocess.run([cov, "export", "-summary-only", program, f"-instr-profile={indexed}"], capture_output=True,
                          text=True)
    if told.returncode:
        return None
    covered = total = 0
    for file in json.loads(told.stdout)["data"][0]["files"]:
        name = os.path.relpath(file["filename"], ROOT)
        if any(name.startswith(source) for source in fuzzer.sources):
            covered += file["summary"]["lines"]["covered"]
            total += file["summary"]["lines"]["count"]
    return (covered, total) if covered else None  # a program that ended before its profile was written
