# SPDX-License-Identifier: Apache-2.0
"""What a run of tests says becomes a row of the page of OpenUSDs."""
import io
import json
import xml.etree.ElementTree as ElementTree

import versions

REPORT = """<testsuites><testsuite>
<testcase classname="testenv.hydra.test_usdview" name="a"><skipped message="no usdview"/></testcase>
<testcase classname="testenv.hydra.test_usdrecord" name="b"/>
<testcase classname="testenv.hydra.test_usdrecord" name="c"><failure/></testcase>
<testcase classname="testenv.hydra.test_aovs" name="d"><error/></testcase>
</testsuite></testsuites>"""


def test_outcomes_are_counted():
    counts = versions.counted(versions.outcomes(ElementTree.parse(io.StringIO(REPORT))))
    assert counts == {"all": {"passed": 1, "failed": 2, "skipped": 1}, "usdrecord": {"passed": 1, "failed": 1},
                      "usdview": {"skipped": 1}, "Blender": {}}


def test_a_row_replaces_that_of_the_same_host(tmp_path, monkeypatch):
    monkeypatch.setattr(versions, "FILE", str(tmp_path / "rows.json"))
    (tmp_path / "rows.json").write_text("[]")
    for host, passed in (("b", 1), ("a", 2), ("b", 3)):
        versions.add({"version": 2603, "host": host, "date": "2026-01-01", "counts": {"all": {"passed": passed}}})
    assert [(row["host"], row["counts"]["all"]["passed"]) for row in json.loads((tmp_path / "rows.json").read_text())] == [
        ("a", 2), ("b", 3)]
    assert "| 26.03 | b | 2026-01-01 | 3 passed |  |  |  |" in versions.page()
