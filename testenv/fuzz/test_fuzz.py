# SPDX-License-Identifier: Apache-2.0
"""Findings of fuzzers stay found, and the fuzzers themselves tell right from wrong.

The kept inputs of the native fuzzers are run by testFuzzCorpus.
"""
import importlib
import json
import os
import subprocess
import sys
import types

import pytest

import following
import fuzzRun
import generated
import keptFindings
import native
import outcomes
import results
import shrink
import traced
from fuzzers import FUZZERS

GENERATED = [name for name, fuzzer in FUZZERS.items() if fuzzer.kind == "generated"]
HANGS = 3600  # seconds that no number of inputs takes, however busy the machine
KEPT = [(name, path) for name in GENERATED for path in keptFindings.corpus(name)]


@pytest.fixture(scope="module")
def hand():
    made = generated.Hand()
    yield made
    made.end()


@pytest.mark.parametrize("name, path", KEPT, ids=lambda value: os.path.splitext(os.path.basename(value))[0])
def test_what_was_found(name, path, hand):
    module = importlib.import_module(name)
    with open(path, "rb") as file:
        kind, signature, answer = generated.outcome(hand, module, file.read(), module.EXTENSION)
    assert kind in outcomes.GOOD, signature + "\n" + answer["error"]


@pytest.mark.parametrize("name", [name for name, fuzzer in FUZZERS.items() if fuzzer.kind == "python"])
def test_what_followers_of_coverage_have_kept(name):
    done = subprocess.run(traced.command(name, "--run", *keptFindings.corpus(name)), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_lines_that_are_reached_are_counted(tmp_path, monkeypatch):
    """Those of functions, and of these the ones that an input runs."""
    import patina
    import pythonTargets

    (tmp_path / "__init__.py").write_text("")
    (tmp_path / "some.py").write_text("def some(x):\n    if x:\n        return 1\n"
                                      "    return [y for y in\n            (2, 3)]\n\n\nZ = 7\n")
    monkeypatch.setattr(patina, "__file__", str(tmp_path / "__init__.py"))
    space = {}
    exec(compile((tmp_path / "some.py").read_text(), str(tmp_path / "some.py"), "exec"), space)
    inputs = [tmp_path / "a", tmp_path / "b"]
    inputs[0].write_bytes(b"1")
    inputs[1].write_bytes(b"")
    assert pythonTargets.lines(space["some"], ("some.py",), inputs[:1]) == (2, 4)
    assert pythonTargets.lines(space["some"], ("some.py",), inputs) == (4, 4)
    assert pythonTargets.lines(space["some"], ("other.py",), inputs) == (0, 0)


@pytest.mark.parametrize("name, inputs", (("faults", 1), ("faults", 4), ("changing", 6), ("killed", 2)))
def test_the_first_seeds(name, inputs):
    """More of what the kept inputs show: the same inputs on every machine. `./patina fuzz NAME --seconds S` goes on."""
    found = generated.run(importlib.import_module(name), HANGS, 5000, print, inputs)
    assert found["inputs"] == inputs and not found["findings"], [finding[1] for finding in found["findings"]]


@pytest.mark.parametrize("name", GENERATED)
def test_a_seed_is_an_input_for_ever(name):
    module = importlib.import_module(name)
    assert module.make(5) == module.make(5)
    assert len({module.make(seed) for seed in range(8)}) == 8


WRONG = {"crash": "os.kill(os.getpid(), 11)", "traceback": "raise ValueError('x')", "memory": "bytearray(1 << 40)",
         "promise": "return outcomes.broken('lost')", "fine": "return 0",
         "hang": "resource.setrlimit(resource.RLIMIT_CPU, (1, 9))\n"
         "    while True:\n        pass"}


@pytest.mark.parametrize("kind", WRONG)
def test_every_end_has_its_name(kind, hand, tmp_path, monkeypatch):
    text = f"import os\nimport resource\nimport outcomes\ndef execute(path, folder):\n    {WRONG[kind]}\n"
    if kind == "memory":
        text = text.replace("bytearray", "x = bytearray").rstrip("\n") + "\n    return len(x)\n"
    name = f"endsBy{kind.capitalize()}"
    (tmp_path / f"{name}.py").write_text(text)
    own = generated.Hand()
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    try:
        found, _, answer = generated.outcome(own, types.SimpleNamespace(__name__=name), b"", ".txt")
    finally:
        own.end()
    expected = {"memory": ("traceback", "memory")}.get(kind, (kind,))
    assert found in expected, answer


def test_what_ends_as_a_warning_is_found_too(hand, tmp_path, monkeypatch):
    """Neither memory that ran out nor an error of the reader's own is fine because the rest was drawn."""
    (tmp_path / "swallows.py").write_text(
        "import outcomes\ndef execute(path, folder):\n    from patina.stage import geometry\n"
        "    def broken(*a, **k):\n        raise KeyError('a defect')\n    import patina.stage.readStage as r\n"
        "    r.cameras.emit = broken\n    return outcomes.record(['record', path, 'image.exr'], folder)\n")
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}")
    own = generated.Hand()
    try:
        found = generated.outcome(own, types.SimpleNamespace(__name__="swallows"), b'#usda 1.0\ndef Camera "c"\n{\n}\n',
                                  ".usda")
    finally:
        own.end()
    assert found[0] == "traceback" and "a defect" in found[2]["error"]
    assert outcomes.kind_of({"timedOut": False, "signal": 0, "status": 0,
                             "error": "out of memory: /dome: no memory for it"}) == "memory"


def test_long_words_leave_the_head_of_what_was_told(tmp_path):
    """A refusal begins with `patina`, and may end with a long word that the user gave."""
    import hand as hands

    told = tmp_path / "told"
    told.write_bytes(b"patina: error: " + b"x" * 50000 + b" end")
    with open(told, "rb") as file:
        text = hands._head_and_tail(file, hands.TOLD)
    assert text.startswith(b"patina: error") and text.endswith(b" end") and len(text) < 2 * hands.TOLD + 10
    told.write_bytes(b"patina: short")
    with open(told, "rb") as file:
        assert hands._head_and_tail(file, hands.TOLD) == b"patina: short"


def test_back_ends_that_differ_are_told(hand):
    """Points under a scale that is not uniform are stretched by one back end alone, by design."""
    import backEndPairs

    backEndPairs.inProcess.needs_opengl()
    data = backEndPairs.make(113)
    stretched = data.replace(b"scale = (0.6, 0.6, 0.6)", b"scale = (3, 0.3, 0.3)")
    assert stretched != data
    kind, _, answer = generated.outcome(hand, backEndPairs, stretched, ".usda")
    assert kind == "promise" and "the back ends differ: " in answer["error"], answer


def test_documents_hold_every_node():
    import generateDocs
    import materialDocuments

    table = {category for family in generateDocs.families() for category in generateDocs.categories(family)}
    known = {node[1] for node in materialDocuments._known()}
    assert len(table) > 150 and not table - known
    assert {"standard_surface", "open_pbr_surface", "UsdPreviewSurface"} <= known


def test_inputs_shrink():
    data = b"".join(b"line %d\n" % i for i in range(40))
    assert shrink.lines(data, lambda d: b"line 7\n" in d and b"line 31\n" in d, 10) == b"line 7\nline 31\n"


def test_a_finding_becomes_a_test(tmp_path, monkeypatch):
    monkeypatch.setattr(keptFindings, "CORPUS", str(tmp_path / "corpus"))
    os.makedirs(tmp_path / "corpus" / "randomStages")
    path = keptFindings.save(str(tmp_path / "found"), "randomStages", ".usda", ("crash", "signal 11", b"#usda 1.0\n", "words"))
    assert keptFindings.keep(path, "smallCrash") == keptFindings.corpus("randomStages")[0]
    for file, name in ((path, "smallCrash"), (path, "no name"), (str(tmp_path / "other"), "a")):
        with pytest.raises(ValueError):
            keptFindings.keep(file, name)


def test_every_fuzzer_has_a_corpus():
    assert {name for name in FUZZERS if keptFindings.corpus(name)} == set(FUZZERS)


def test_rows_hold_no_path_of_a_machine():
    place = os.path.join(os.path.dirname(os.path.abspath(results.FILE)), "generated.py")
    found = {"inputs": 1, "seconds": 1.0, "counts": {}, "findings": [("crash", f'File "{place}", line 7')]}
    assert results.row("edits", 1, found)["findings"] == ['File "testenv/fuzz/generated.py", line 7']


def test_time_goes_where_something_new_is_reached(monkeypatch):
    """Fuzzers that follow coverage are first, and what they leave at their plateau is shared among the others."""
    now, given = [0.0], {}

    def run(taken):
        def one(name, share):
            given[name] = share
            now[0] += min(share, taken)
            return {"inputs": 1, "seconds": min(share, taken), "counts": {}, "lines": None, "findings": []}
        return one

    follows, makes = run(1.0), run(1e9)
    monkeypatch.setattr(fuzzRun.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(native, "build", lambda *_: None)
    monkeypatch.setattr(native, "run", lambda name, fuzzer, build, corpus, share, quiet, *_: follows(name, share))
    monkeypatch.setattr(generated, "run", lambda module, share, *_: makes(module.__name__, share))
    fuzzRun.run(["edits", "ies", "faults", "film"], 120.0, None, 1, None, "found", "build", lambda _: None)
    assert list(given) == ["ies", "film", "edits", "faults"]
    assert given == pytest.approx({"ies": 20.0, "film": 119.0 / 5.0, "edits": 59.0, "faults": 59.0})


@pytest.mark.parametrize("most, status", [(0.3, 0), (HANGS, 3)])
def test_a_plateau_ends_a_program(most, status):
    """It is asked to end where it reaches nothing new, and may go on where it does."""
    program = "print('#2\\tINITED cov: 7 ft: 8', flush=True)\nprint('#40\\tpulse cov: 7', flush=True)\n"
    program += "while True:\n    pass\n" if not status else "raise SystemExit(3)\n"
    edges = following.Plateau()
    found, said, inputs = following.run([sys.executable, "-c", program], edges, most)
    assert (found, inputs, edges.edges) == (status, 40, 7) and "INITED" in said


def test_a_program_that_waits_reaches_no_plateau():
    edges = following.Plateau()
    following.run([sys.executable, "-c", "import time\nprint('#2 cov: 7', flush=True)\ntime.sleep(1.5)"], edges, 1.0)
    assert edges.seconds() < 1.0


def test_a_plateau_allows_a_thousandth_of_the_edges():
    edges = following.Plateau()
    for edges.used, count in ((1.0, 2000), (5.0, 2996), (20.0, 2997), (60.0, 3000)):
        edges.hear(f"#9\tNEW    cov: {count} ft: 1")
    edges.used = 100.0
    assert edges.seconds() == 80.0  # 2997 of 3000
    edges.hear("#9\tNEW    cov: 3001")
    assert edges.seconds() == 40.0
    few = following.Plateau()
    for few.used, count in ((1.0, 998), (5.0, 999)):
        few.hear(f"#9\tNEW    cov: {count}")
    assert few.seconds() == 0.0


def test_a_plateau_goes_on_with_the_same_program(tmp_path):
    program, place = tmp_path / "program", str(tmp_path / "plateau.json")
    program.write_text("one")
    edges = following.Plateau(str(program), place)
    edges.hear("#9\tNEW    cov: 2000")
    edges.used = 40.0
    edges.keep()
    again = following.Plateau(str(program), place)
    again.hear("#9\tINITED cov: 1998")
    again.used += 20.0
    assert (again.seconds(), again.edges) == (60.0, 2000)
    program.write_text("other")
    assert following.Plateau(str(program), place).seconds() == 0.0
    (tmp_path / "plateau.json").write_text("{}")
    assert following.Plateau(str(program), place).edges == 0


def test_crashes_of_libraries_are_theirs():
    text = ("==7==ERROR: AddressSanitizer: SEGV on unknown address 0x61 (pc 0x7f bp 0x7f sp 0x7f T0)\n"
            "==7==The signal is caused by a READ memory access.\n    #0 0x55 in __asan_memcpy (/b/texture+0x1)\n"
            "    #1 0x7f in OpenImageIO_v2_4::decode(int) (/lib/libOpenImageIO.so.2.4+0x4c) (BuildId: b9)\n"
            "    #2 0x55 in patina::read(int) /b/read.cpp:71:13\n")
    assert native._why(text) == ("library", "OpenImageIO_v2_4::decode in libOpenImageIO")
    ours = text.replace("    #1 0x7f in OpenImageIO_v2_4::decode(int) (/lib/libOpenImageIO.so.2.4+0x4c) (BuildId: b9)\n", "")
    assert native._why(ours)[0] == "crash"


@pytest.fixture
def runs(monkeypatch):
    """`patina fuzz` without fuzzers: each call notes its names, and finds nothing."""
    called = []

    def run(names, *_):
        called.append(names)
        return {"ies": {"inputs": 3, "seconds": 1.0, "counts": {"fine": 3}, "lines": None, "findings": []}}

    monkeypatch.setattr(fuzzRun, "run", run)
    return called


def fuzz(*arguments):
    from patina.cli import main

    return main.main(["fuzz", "ies", *arguments])


@pytest.mark.parametrize("text, reason", [
    (None, "cannot be read"), ("{", "is no JSON"), ("[" * 100000, "is no JSON"), ("[]", "no table of runs"),
    ("{}", "no table of runs"), ('{"runs": 3}', "no table of runs"), ('{"runs": [], "known": 1}', "no table of runs")])
def test_a_table_is_read_before_the_run(runs, tmp_path, capsys, text, reason):
    table = tmp_path / "table.json"
    if text is not None:
        table.write_text(text)
    assert fuzz("--results", str(table)) == 1
    error = capsys.readouterr().err
    assert reason in error and str(table) in error and error.count("\n") == 1
    assert runs == [] and os.listdir(tmp_path) == ([] if text is None else ["table.json"])


@pytest.mark.parametrize("flag", ["--results", "--json"])
@pytest.mark.parametrize("kind", ["device", "pipe", "link", "folder"])
def test_what_is_no_file_is_refused_before_the_run(runs, tmp_path, capsys, flag, kind):
    path = tmp_path / "target"
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "folder":
        path = tmp_path / "none" / "figures.json"
    else:
        path.symlink_to({"device": "/dev/zero", "link": "none"}[kind])
    assert fuzz(f"{flag}={path}") == 1
    error = capsys.readouterr().err
    assert str(path) in error and error.count("\n") == 1 and runs == []


def test_figures_go_where_they_are_sent(runs, tmp_path, monkeypatch, capsys):
    """A file is replaced, - is standard output, and the table gets a row."""
    monkeypatch.chdir(tmp_path)
    figures, table = tmp_path / "figures.json", tmp_path / "table.json"
    table.write_text('{"runs": []}')
    assert fuzz(f"--json={figures}", "--results", str(table)) == 0
    expected = {"seed": 1, "fuzzers": {"ies": {"inputs": 3, "seconds": 1.0, "counts": {"fine": 3}, "lines": None,
                                               "findings": []}}}
    assert json.loads(figures.read_text()) == expected and len(results.read(str(table))["runs"]) == 1
    capsys.readouterr()
    assert fuzz("--json") == 0
    assert json.loads(capsys.readouterr().out) == expected
    assert fuzz(f"--json={table}", "--results", str(table)) == 1  # one of them would be lost
    assert "is the same file" in capsys.readouterr().err and runs == [["ies"]] * 2
    assert sorted(os.listdir(tmp_path)) == ["figures.json", "table.json"]


def test_a_corpus_outlives_a_copy_that_fails(tmp_path, monkeypatch):
    """Nothing is removed before all that is kept has been copied."""
    program, work = tmp_path / "program", tmp_path / "corpus"
    program.write_text('#!/bin/sh\ncp "$3/needed" "$2/0a1b"\n')
    program.chmod(0o755)
    work.mkdir()
    (tmp_path / "elsewhere").write_text("of the user")
    (work / "linked").symlink_to(tmp_path / "elsewhere")
    (work / "folder").mkdir()
    for name in ("needed", "spare"):
        (work / name).write_text(name)
    copy = native.shutil.copy

    def full(*_):
        raise OSError(28, "No space left on device")

    def keep(name):
        (tmp_path / name).mkdir()
        native._keep_small(str(program), str(work), str(tmp_path / name), FUZZERS["ies"])

    monkeypatch.setattr(native.shutil, "copy", full)
    with pytest.raises(OSError):
        keep("first")
    assert sorted(os.listdir(work)) == ["folder", "linked", "needed", "spare"]
    monkeypatch.setattr(native.shutil, "copy", copy)
    keep("second")
    assert sorted(os.listdir(work)) == ["0a1b", "folder", "linked"] and (work / "0a1b").read_text() == "needed"
