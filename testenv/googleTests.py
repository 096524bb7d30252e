# SPDX-License-Identifier: Apache-2.0
"""Which googletest programs the build made, and the suites in each.

To list them takes seconds, most of it the loading of libraries; so a list is kept beside its program (NAME.suites), and the
process that hands tests out makes all of them before its workers look."""
import concurrent.futures
import os
import stat
import subprocess


def programs():
    """:returns: paths, sorted; none without PATINA_BUILD_DIR"""
    folder = os.path.join(os.environ.get("PATINA_BUILD_DIR", ""), "tests")
    if not os.environ.get("PATINA_BUILD_DIR") or not os.path.isdir(folder):
        return []
    paths = [os.path.join(folder, name) for name in sorted(os.listdir(folder))]
    return [p for p in paths if os.path.isfile(p) and os.stat(p).st_mode & stat.S_IXUSR]


def suites(program):
    """:returns: names of the suites in a program, those of parameterized tests included; None where it cannot list them"""
    made = str(os.stat(program).st_mtime_ns)
    try:
        with open(program + ".suites", encoding="utf-8") as file:
            kept = file.read().split("\n")
        if kept[0] == made and kept[-1] == "end":  # of this very program, and whole
            return kept[1:-1]
    except OSError:
        pass
    listing = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, timeout=60)
    if listing.returncode != 0:
        return None
    found = [line.split("#")[0].strip().rstrip(".") for line in listing.stdout.splitlines()
             if line and not line[0].isspace() and line.split("#")[0].strip().endswith(".")]
    try:
        temporary = f"{program}.suites.{os.getpid()}"
        with open(temporary, "w", encoding="utf-8") as file:
            file.write("\n".join([made, *found, "end"]))
        os.replace(temporary, program + ".suites")
    except OSError:  # a build that may only be read
        pass
    return found


def list_all():
    """Lists all programs, several at once."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(suites, programs()))
