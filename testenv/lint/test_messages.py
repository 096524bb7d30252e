# SPDX-License-Identifier: Apache-2.0
"""Every warning in the code has a line that says what to do, and every such line has a warning."""
import messageTexts
from patina.cli import advice


def test_every_warning_has_advice():
    lost = [text for listed in messageTexts.texts().values() for text in listed if not advice.advice(text)]
    assert not lost, lost


def test_no_advice_is_left_over():
    used = {advice.row_of(text) for listed in messageTexts.texts().values() for text in listed}
    assert set(range(advice.count())) == used, [advice._ROWS[i] for i in sorted(set(range(advice.count())) - used)]


def test_all_areas_have_texts():
    found = messageTexts.texts()
    assert all(found.values()) and sum(map(len, found.values())) > 150


def test_texts_are_read_from_expressions():
    cpp = list(messageTexts._cpp("a.cpp", 'd.warn(p.path, "x", std::to_string(n) + " curves (a+b) " "are \'" + name(q, 2) + '
                                          '"\'; off");'))
    assert cpp == [("a.cpp", "… curves (a+b) are '…'; off")]
    assert not list(messageTexts._cpp("a.cpp", "d.warn(a, b, message); int warn(int a);"))
    choice = list(messageTexts._cpp("a.cpp", 'warn(a, "", bad ? "is bad" : "is good");'))
    assert [text for _, text in choice] == ["is bad", "is good"]
    assert list(messageTexts._python("a.py", 'c.warn(p, "x", f"is {a}, " + ("b" if c else "d"))')) == [("a.py", "is …, …")]
