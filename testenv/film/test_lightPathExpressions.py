# SPDX-License-Identifier: Apache-2.0
"""Light path expressions: what is read and what is refused, and the automata beside Python's regular expressions."""
import random
import re

import pytest

import _patina


# Those of the documentation of OSL, RenderMan and Arnold, and one for each rule.
READ = ["C.*", "C.*L", "C<RD>L", "C<RD>.*L", "C[DG]L", "C<R[^D]>L", "C[^DG]*L", "CG*[LO]", "C<..'hair'>.*L", "C'hair'.*L",
        "C(<RD>|<TD>)L", "CDL", "CSDL", "C<TS>*D+L", "C.{2}L", "C.{1,3}[LB]", "C.{2,}O", "C.?L", "C[<L.>O]", "C<RD>[<L.>O]",
        "C<RD>[DS]+[<L.>O]", "C.*<L.'key'>", "C.*<L.['key''fill']>", "C.*<L.[^'key']>", "C.*<L.x>", "C.*[^'key']", "C <RD> L",
        "CV*B",
        "C<.D>L", "C<[RT]S>*L", "CD|GL", "C(DD|G)L", "C((D))L", "C.**L", "C<R>L", "C<L..>", "C[LO]", "C<T.[^'subsurface']>.*L"]
REFUSED = [  # expression, column, what the message says
    ("", 1, "an event"), ("C<RD.*L", 6, "a label such as 'key', x or >"), ("CQL", 2, "an event"),
    ("C(DL", 5, ") to end the group"), ("C)L", 2, "an event"), ("C[DG", 5, "]"), ("C[]L", 3, "an event in the list"),
    ("C()L", 3, "in the group"),
    ("C[^]L", 4, "after ^"), ("C<>L", 3, "an event type"), ("C<DR>L", 3, "an event type"), ("C<RR>L", 4, "how it scatters"),
    ("C<R*>L", 4, "how it scatters"), ("C<RD", 5, "label"), ("C'keyL", 7, "' to end the label"), ("C''L", 2, "between quotes"),
    ("C.{L", 4, "a number of repetitions"), ("C.{2L", 5, "}"), ("C.{3,2}L", 6, "below 3"), ("C.{65}L", 4, "at most 64"),
    ("|CL", 1, "before |"), ("C|", 3, "an event"), ("CxL", 2, "an event"), ("*CL", 1, "an event"),
    ("C<(R)D>L", 3, "an event type"),
    ("C[^D'key']L", 5, "how it scatters"), ("(" * 70 + "C" + ")" * 70 + "L", 66, "fewer groups")]
LABELS = "".join(f"'{a}{b}'" for a in "abcdefghijklm" for b in ("", *"nopqrstuvwxyz"))  # 182
HAPPENING = ([("C", "x")] + [(t, s) for t in "RT" for s in "DGS"] + [("V", "D")] + [(t, "x") for t in "LBO"])


@pytest.mark.parametrize("expression", READ)
def test_it_is_read(expression):
    assert _patina.light_path_states(expression) >= 2


@pytest.mark.parametrize("expression, column, words", REFUSED)
def test_it_is_refused_at_its_column(expression, column, words):
    with pytest.raises(ValueError) as error:
        _patina.light_path_states(expression)
    assert f"'{expression}'" in str(error.value) and f"column {column}: " in str(error.value) and words in str(error.value)


@pytest.mark.parametrize("expression", ["L", "CD", "CLD", "CL'key'", "CC", "D*L", "C<RD'a''b'>L", "C"])
def test_what_fits_no_path_is_refused(expression):
    with pytest.raises(ValueError, match="no path fits it"):
        _patina.light_path_states(expression)


def test_what_would_need_too_much_is_refused():
    with pytest.raises(ValueError, match="too many states"):
        _patina.light_path_states("C((.{64}){64}){64}L")
    with pytest.raises(ValueError, match="too many states"):
        _patina.light_path_states("C.*D.{20}L")  # 2^20 sets of states
    with pytest.raises(ValueError, match="too many states"):
        _patina.light_path_states("C((.?){64}){64}<L.[" + LABELS + "]>")


def test_labels_in_one_list_need_no_states_of_their_own():
    long = "C" + ".{64}" * 29
    assert _patina.light_path_states(long + f"<L.[{LABELS}]>") == _patina.light_path_states(long + "<L.'a'>") == 1860


def test_a_render_has_few_labels():
    assert _patina.light_path_states("C[" + "".join(f"<L.'{k}'>" for k in range(1024)) + "]") == 4
    with pytest.raises(ValueError, match="at most 1024 labels"):
        _patina.light_path_states("C[" + "".join(f"<L.'{k}'>" for k in range(1025)) + "]")


def path(text):
    """:param text: events, blanks between them: C RD L'key'"""
    found = []
    for word in text.split():
        kind, _, label = word.partition("'")
        found.append((kind[0], kind[1:2] or "x", label.rstrip("'")))
    return found


@pytest.mark.parametrize("expression, fits, others", [
    ("C<RD>L", ["C RD L", "C RD B", "C RD L'key'"], ["C RG L", "C TD L", "C RD RD L", "C RD O", "C L"]),
    ("C.*B", ["C B", "C RS TD B"], ["C L", "C RD O"]),
    ("C.*<L.'key'>", ["C L'key'", "C RD B'key'"], ["C L", "C L'fill'", "C O'key'"]),
    ("C.*<L.[^'key']>", ["C L", "C L'fill'"], ["C L'key'"]),
    ("C.*<L.x>", ["C L"], ["C L'fill'"]),
    ("CD|GL", ["C RD L", "C TG L"], ["C RD", "C RD RG L"]),
    ("C(DD|G)L", ["C RD RD L", "C RD RG L"], ["C RD L", "C RG L"]),  # | joins the events beside it alone
    ("C.{2}O", ["C RD RD O"], ["C RD O", "C RD RD RD O"]),
    ("C[^DG]L", ["C RS L"], ["C RD L", "C TG L"]),
])
def test_paths_that_fit(expression, fits, others):
    texts = fits + others
    assert _patina.light_path_accepts(expression, [path(t) for t in texts]) == [True] * len(fits) + [False] * len(others)


class Random:
    """Random expressions, each with the regular expression that means the same of events written as three letters: type,
    scattering, and a, b, o (another label) or - (none)."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def some(self, letters):
        return "".join(sorted(self.random.sample(letters, self.random.randint(1, 2))))

    def place(self, letters):
        kind = self.random.randrange(4)
        chosen = self.random.choice(letters) if kind == 1 else self.some(letters)
        if kind == 0:
            return ".", "."
        known = chosen.replace("L", "LB")
        return (chosen, f"[{known}]") if kind == 1 else (f"[{chosen}]", f"[{known}]") if kind == 2 else (f"[^{chosen}]",
                                                                                                         f"[^{known}]")

    def label(self):
        kind = self.random.randrange(5)
        name = self.random.choice("ab")
        return [("", "."), (f"'{name}'", name), ("['a''b']", "[ab]"), (f"[^'{name}']", f"[^{name}]"), ("x", "-")][kind]

    def event(self):
        kind = self.random.randrange(5)
        if kind == 0:
            return ".", "..."
        if kind == 1:
            letter = self.random.choice("RTVLBO")
            return letter, "[LB].." if letter == "L" else letter + ".."
        if kind == 2:
            letter = self.random.choice("DGS")
            return letter, f".{letter}."
        if kind == 3:
            name = self.random.choice("ab")
            return f"'{name}'", f"..{name}"
        places = self.place("RTVLBO"), self.place("DGS"), self.label()
        return "<" + "".join(p[0] for p in places) + ">", "".join(p[1] for p in places)

    def element(self, depth):
        kind = self.random.randrange(6)
        if depth == 0 or kind < 3:
            text, meant = self.event()
        elif kind == 3:
            text, meant = self.sequence(depth - 1)
            text = f"({text})"
        elif kind == 4:
            parts = [self.element(depth - 1) for _ in range(2)]
            text, meant = "[" + "".join(p[0] for p in parts) + "]", "|".join(p[1] for p in parts)
        else:
            parts = [self.element(depth - 1) for _ in range(2)]
            text, meant = f"({parts[0][0]}|{parts[1][0]})", "|".join(p[1] for p in parts)
        repeat = self.random.choice(["", "", "", "*", "+", "?", "{2}", "{1,2}", "{1,}"])
        return text + repeat, f"(?:{meant}){repeat}"

    def sequence(self, depth):
        parts = [self.element(depth) for _ in range(self.random.randint(1, 3))]
        return "".join(p[0] for p in parts), "".join(p[1] for p in parts)

    def path(self):
        events = [("C", "x", "")]
        for _ in range(self.random.randint(0, 5)):
            events.append((*self.random.choice(HAPPENING[1:8]), self.random.choice(["", "", "a", "b", "other"])))
        return [*events, (self.random.choice("LBO"), "x", self.random.choice(["", "a", "b", "other"]))]


def test_automata_are_pythons_regular_expressions():
    drawn, accepted, compared, large = Random(7), 0, 0, 0
    for _ in range(200):
        text, meant = drawn.sequence(2)
        text, meant = "C" + text + ".?", f"C..(?:{meant})(?:...)?"
        paths = [drawn.path() for _ in range(60)]
        written = ["".join(t + s + {"": "-", "other": "o"}.get(label, label) for t, s, label in p) for p in paths]
        expected = [re.fullmatch(meant, w) is not None for w in written]
        try:
            found = _patina.light_path_accepts(text, paths)
        except ValueError as error:
            large += "too many states" in str(error)
            assert "too many states" in str(error) or "no path fits it" in str(error) and not any(expected), (text, str(error))
            continue
        assert found == expected, text
        accepted += sum(found)
        compared += len(found)
    assert compared > 5000 and accepted > 200 and large < 10  # so that both outcomes are met
