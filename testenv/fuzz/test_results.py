# SPDX-License-Identifier: Apache-2.0
"""Rows of the table of runs say what the runs said."""
import json
import os

HERE = os.path.dirname(os.path.abspath(__file__))

import editResults
import results

RACE = """WARNING: ThreadSanitizer: data race (pid=7)
  Write of size 8 at 0x7b0400001f40 by main thread:
SUMMARY: ThreadSanitizer: data race /some/where/film.cpp:12 in patina::Film::add
"""
FAILURE = "edited and fresh host differ after 125 edits, the last of them moves\n"


def test_edits_through_hydra():
    for status, log, counts, findings in (
            (0, "[  PASSED  ] 2 tests.\n", {"fine": 200}, []),
            (66, RACE + RACE, {"report": 2, "fine": 1}, ["data race film.cpp:12 in patina::Film::add"]),
            (1, FAILURE, {"promise": 1, "fine": 199}, ["seed 3 ends with 1"]),
            (139, "", {"crash": 1, "fine": 0}, ["seed 3 ends with 139"])):
        row = editResults.row("thread", "embree", 3, 100, 5.0, status, log)
        assert row["machine"] in results.OTHERS and row["counts"] == counts and row["findings"] == findings
        assert set(counts) <= set(results.KINDS) | {"fine"}


def test_a_row_is_added_and_summed(tmp_path):
    table = tmp_path / "table.json"
    table.write_text(json.dumps({"runs": [], "mended": [], "mistakes": [], "known": ["a gap"]}))
    found = {"inputs": 2, "seconds": 3.0, "counts": {"fine": 2}, "sums": {"kills": 5}, "findings": []}
    for _ in range(2):
        results.append([results.row("killed", 1, found)], str(table))
    read = results.read(str(table))
    assert read["known"] == ["a gap"]
    killed = results.sums(read)["killed"]
    assert killed["inputs"] == 4 and killed["sums"] == {"kills": 10} and killed["counts"] == {"fine": 4}


def test_a_table_is_replaced_where_it_lies(tmp_path):
    """Through a link to it, and over no file beside it."""
    (tmp_path / "tables").mkdir()
    table, link = tmp_path / "tables" / "table.json", tmp_path / "link.json"
    table.write_text('{"runs": [], "a \\"key": ["x"]}')
    table.chmod(0o640)
    link.symlink_to(table)
    other = tmp_path / "other"
    other.write_text("other")
    for beside in (str(link) + ".new", str(table) + ".new"):
        os.symlink(other, beside)
    row = results.row("killed", 1, {"inputs": 2, "seconds": 3.0, "counts": {"fine": 2},
                                    "findings": [("crash", "not UTF-8: \udcff")]})
    results.append([row], str(link))
    assert results.read(str(table)) == {"runs": [row], 'a "key': ["x"]} and link.is_symlink()
    assert other.read_text() == "other" and table.stat().st_mode & 0o777 == 0o640
    assert sorted(os.listdir(tmp_path / "tables")) == ["table.json", "table.json.new"]
