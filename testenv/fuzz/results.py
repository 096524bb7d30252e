# SPDX-License-Identifier: Apache-2.0
"""The fuzzers' findings, by their own figures: testenv/fuzz/results.json, from which docs/trust.md is made.

A run adds a row to `runs`. The other lists are written by hand: `mended` (defects), `mistakes` (of the fuzzers) and `known`
(gaps)."""
import json
import os
import shutil
import tempfile

FOLDER = os.path.dirname(os.path.abspath(__file__))
FILE = os.path.join(FOLDER, "results.json")
ROOT = os.path.normpath(os.path.join(FOLDER, "..", "..")) + os.sep
# Scripts that search like fuzzers: what they try, and how they are run.
OTHERS = {
    "randomGraphs": ("legal material graphs, evaluated in C++", "./patina python testenv/stability/randomGraphs.py --seed 1 "
                                                                "--count 1000000 --jobs 2 --results"),
    "randomGraphsRaster": ("legal material graphs in C++ and in GLSL, compared",
                           "./patina python testenv/stability/randomGraphs.py --seed 1 --count 20000 --raster --results"),
    "racingEdits": ("random edits by two threads while the path tracer renders, under ThreadSanitizer, without Hydra",
                    "./patina python testenv/sanitizers/racingEdits.py --seconds 3600 --results"),
    **{f"hydraEdits{kind.capitalize()}": (f"random edits of a stage through Hydra while the path tracer renders, under {name}: "
                                          "half of them by the delegate, half by scene indices",
                                          f"testenv/hydra/sanitize.sh {kind} 50000 build-{kind} --results")
       for kind, name in (("address", "AddressSanitizer"), ("thread", "ThreadSanitizer"))},
    **{f"hydraEdits{backend.capitalize()}{kind.capitalize()}": (
        f"such edits under {name}, {how}", f"testenv/hydra/sanitize.sh {kind} 100 build-{kind} --backend {backend} --results")
       for backend, how in (("raster", "drawn by the rasterizer"),
                            ("interactive", "begun by the rasterizer, ended by the path tracer"))
       for kind, name in (("address", "AddressSanitizer"), ("thread", "ThreadSanitizer"))},
    **{f"viewport{kind.capitalize()}": (f"a viewport's session in Hydra, drawn by the {name}: edits of every kind, which are "
                                        "taken back again and again",
                                        f"./patina python testenv/hydra/viewportSession.py --seconds 3600 --backend {kind} "
                                        "--results")
       for kind, name in (("embree", "path tracer"), ("raster", "rasterizer"))},
}


# Kinds of findings, as outcomes.py has them, in words.
KINDS = {
    "crash": "*crash*: the process died of a signal.",
    "growth": "*growth*: memory of the heap, or resident memory, that grows with each edit.",
    "hang": "*hang*: the process did not end within its time limit.",
    "library": "*library*: another library failed, and fails without Patina too; or it died in the very call that failed.",
    "memory": "*memory*: the process ran out of memory.",
    "promise": "*promise*: a result breaks what Patina claims. An image holds NaN, say, an old image is lost, or back ends "
               "differ.",
    "report": "*report*: a sanitizer reported an error.",
    "traceback": "*traceback*: an exception that the command had not foreseen.",
}


def read(path=FILE):
    """:raises ValueError: with a one-line reason, where it is no table of runs"""
    if os.path.exists(path) and not os.path.isfile(path):
        raise ValueError(f"{path} is no regular file")
    try:
        with open(path, encoding="utf-8") as file:
            table = json.load(file)
    except OSError as error:
        raise ValueError(f"{path} cannot be read ({error.strerror})") from error
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is no JSON ({error})") from error
    if not isinstance(table, dict) or "runs" not in table or not all(isinstance(rows, list) for rows in table.values()):
        raise ValueError(f"{path} is no table of runs: an object of lists, one of which is `runs`")
    return table


def row(machine, seed, found):
    """:param found: numbers of a run, as generated.run() and native.run() have them"""
    return {"machine": machine, "seed": seed, "inputs": found["inputs"], "seconds": round(found["seconds"], 1),
            "counts": found["counts"], **({"sums": found["sums"]} if found.get("sums") else {}),
            **({"memory": found["memory"]} if found.get("memory") else {}),
            "lines": list(found["lines"]) if found.get("lines") else None,
            **({"plateau": round(found["plateau"], 1), "edges": found["edges"]} if "plateau" in found else {}),
            "findings": [signature.replace(ROOT, "") for _, signature, *_ in found["findings"]]}


def append(rows, path=FILE):
    """Adds rows to the file, which is replaced as a whole; a link to it stays one.

    patina.cli.outputs would need the compiled module, and testenv/hydra/sanitize.sh adds rows by any Python.

    :raises ValueError: as read()"""
    table = read(path)
    table["runs"] += rows
    lines = {key: ",\n".join("  " + json.dumps(item, ensure_ascii=False) for item in table[key]) for key in table}
    target = os.path.realpath(path)
    handle, made = tempfile.mkstemp(".new", dir=os.path.dirname(target))
    try:
        with open(handle, "w", encoding="utf-8", errors="backslashreplace") as file:
            file.write("{\n" + ",\n".join(f' {json.dumps(key)}: [\n{text}\n ]' for key, text in lines.items()) + "\n}\n")
        shutil.copymode(target, made)
        os.replace(made, target)
    except BaseException:
        os.remove(made)
        raise


def sums(table):
    """:returns: dict of machine -> inputs, seconds, counts by kind, lines and memory of the last run that has them, the longest
    plateau, and findings"""
    found = {}
    for run in table["runs"]:
        of = found.setdefault(run["machine"], {"inputs": 0, "seconds": 0.0, "counts": {}, "sums": {}, "lines": None,
                                               "plateau": None, "memory": None, "findings": []})
        of["inputs"] += run["inputs"]
        of["seconds"] += run["seconds"]
        of["lines"] = run["lines"] or of["lines"]
        of["memory"] = run.get("memory") or of["memory"]
        of["plateau"] = max(run["plateau"], of["plateau"] or 0.0) if "plateau" in run else of["plateau"]
        for key in ("counts", "sums"):
            for kind, number in run.get(key, {}).items():
                of[key][kind] = of[key].get(kind, 0) + number
        of["findings"] += [reason for reason in run["findings"] if reason not in of["findings"]]
    return found


def page():
    """:returns: lines of docs/trust.md"""
    from fuzzers import FUZZERS

    table = read()
    by_machine = sums(table)
    kinds = sorted({kind for of in by_machine.values() for kind in of["counts"]} - {"fine", "message"})
    rows, parsers, total, seconds = [], [], 0, 0.0
    for name in [*FUZZERS, *OTHERS]:
        of = by_machine.get(name)
        what = FUZZERS[name].reads if name in FUZZERS else OTHERS[name][0]
        followed = name in FUZZERS and FUZZERS[name].kind != "generated"
        time = "7200 --plateau 3600" if followed else "3600"
        command = f"./patina fuzz {name} --seconds {time} --results" if name in FUZZERS else OTHERS[name][1]
        if of is None:
            rows.append((f"`{name}`", what, "no run is noted", "", "", "", "", *[""] * len(kinds), f"`{command}`"))
            continue
        total, seconds = total + of["inputs"], seconds + of["seconds"]
        what += "".join(f": {number:,} {name}" for name, number in sorted(of["sums"].items()))
        rows.append((f"`{name}`", what, f"{of['inputs']:,}", f"{of['seconds'] / 3600:.2f}",
                     f"{of['inputs'] / max(of['seconds'], 1e-3):.2g}" if of["inputs"] < 100 * of["seconds"] else
                     f"{of['inputs'] / max(of['seconds'], 1e-3):,.0f}",
                     "{:.0f} %".format(100 * of["lines"][0] / of["lines"][1]) if of["lines"] else "",
                     f"{of['plateau'] / 60:.0f}" if of["plateau"] is not None else "not noted" if followed else "",
                     *(str(of["counts"].get(kind, 0)) for kind in kinds), f"`{command}`"))
        if name in FUZZERS and FUZZERS[name].sources:
            covered = "not measured" if not of["lines"] else f"{of['lines'][0]:,} of {of['lines'][1]:,} lines, " \
                f"{100 * of['lines'][0] / of['lines'][1]:.0f} %"
            parsers.append((", ".join(f"`{source}`" for source in FUZZERS[name].sources), f"`{name}`", covered))
    head = ("fuzzer", "tries", "inputs", "hours", "inputs per second", "lines reached", "plateau", *kinds, "command")
    most = max(by_machine, key=lambda name: by_machine[name]["inputs"])
    share = 100 * by_machine[most]["inputs"] / max(total, 1)
    reads = FUZZERS[most].reads if most in FUZZERS else OTHERS[most][0]
    mended = [(item["what"], item["by"], f"`{item['test']}`") for item in table["mended"]]
    mistakes = [(f"`{item['fuzzer']}`", item["counted"], item["was"]) for item in table["mistakes"]]
    return ["# Trust, in figures", "",
            "Fuzzers try inputs that no user has tried yet, and look for crashes, hangs, memory without end, lost images and",
            f"values that are no numbers. The runs below took {seconds / 3600:.1f} hours on two cores that other work",
            f"shared, and tried {total:,} inputs. [SECURITY.md](../SECURITY.md) says what Patina claims,",
            "[limits](generated/limits.md) how much an input may ask for.", "",
            f"**The total says little**: {by_machine[most]['inputs']:,} of the inputs ({share:.0f} %) are those of `{most}`",
            f"({reads}), which took {by_machine[most]['seconds'] / 3600:.2f} hours.", "",
            "`./patina fuzz NAME --results` runs a fuzzer, and adds a row to `testenv/fuzz/results.json`, from which this",
            "page is made.", "",
            "## Runs", "",
            "*Lines reached* is the share of [a parser's sources](#coverage-of-the-parsers) that the",
            "kept inputs run. *Plateau* is for how many minutes of a processor the longest such run reached at most a",
            "thousandth more edges of the program: more inputs of the kind say little. An hour of it is the aim, and no",
            "number of inputs. A fuzzer that has had it ends, and leaves the rest of its time to the others. One that is",
            "compiled goes on with the plateau of its last run, where program and inputs are the same.", "",
            "The columns after *plateau* count inputs, not causes. All other inputs gave a result, or ended with a",
            "message.", "",
            *(f"- {KINDS[kind]}" for kind in kinds), "",
            *_table(head, rows), "",
            "The next two tables say what the numbers above 0 were.", "",
            *_sessions(by_machine),
            "## Defects that were mended", "",
            *_table(("what was wrong", "found by", "test"), mended), "",
            "## Mistakes of the fuzzers", "",
            "These counts were no defects of Patina. The fuzzers are mended; the counts stay in the table above.", "",
            *_table(("fuzzer", "counted", "what it was"), mistakes), "",
            "## Coverage of the parsers", "",
            "Lines of these sources that the kept inputs of a fuzzer run, measured by llvm-cov (C++) or by tracing (Python",
            "functions). Generated inputs reach the rest through the command line, which is not counted.", "",
            *_table(("sources", "fuzzer", "reached"), parsers), "",
            "## Gaps", "", *(f"- {text}" for text in table["known"])]


def _sessions(by_machine):
    """:returns: lines about the memory of sessions, of the last run of each"""
    rows = []
    for name, of in by_machine.items():
        for kind in ("heap", "resident") if of["memory"] else ():
            found = of["memory"][kind]
            limits = "not known" if found["limits"] is None else "{:,} to {:,}".format(*found["limits"])
            rows.append((f"`{name}`", f"{of['memory']['cycles']:,}", kind, f"{found['megabytes']:,}", f"{found['perEdit']:,}",
                         limits, f"{found['bound']:,}", found["verdict"]))
    if not rows:
        return []
    return ["## Memory of sessions", "",
            "The last run of each session. A cycle makes every kind of edit and takes all of them back; then memory is",
            "counted: bytes that are in use on the heap, and resident memory of no file. The first third of the time is left",
            "out, in which caches fill; the rest is cut into at most 20 spans of six counts or more. The smallest of each is",
            "taken. Growth is a slope after Theil and Sen with limits of 99 % on either side. Memory is *flat* where the upper",
            "limit is below the bound, and *grows* where the lower one is above. The bounds are 32 bytes of the heap for each",
            "edit, malloc's smallest chunk, and one page of resident memory for each cycle.", "",
            *_table(("session", "cycles", "memory", "MB at the end", "bytes per edit", "limits", "bound", "memory is"), rows),
            ""]


def _table(head, rows):
    import generateDocs

    return generateDocs.table(head, rows)
