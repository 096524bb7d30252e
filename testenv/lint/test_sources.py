# SPDX-License-Identifier: Apache-2.0
"""Every source that documents and comments cite by author and year has its title in docs/sources.md."""
import re

from test_lineLengths import listed, read

PAGE = "docs/sources.md"
FILES = ("*.md", "*.glsl", "*.h", "*.cpp", "*.py", "*.mtlx", "*.inc", "*.def")
NAME = r"(?:d')?[A-ZÁ][\w'-]*[a-zé]"
CITATION = re.compile(rf"({NAME})((?:,? (?:and )?(?:d')?{NAME})*)( et al\.)?,? \(?((?:18|19|20)\d\d)\b(?!-|\.\d)")
NO_SOURCES = {"January", "February", "March", "April", "May", "June", "July", "August", "September", "October", "November",
              "December", "Debian", "Ubuntu", "CIE", "OpenUSD", "Copyright", "Python", "Houdini", "Maya", "Cycles"}


def keys(text):
    """Yields the family names, the year and the text of each citation."""
    for match in CITATION.finditer(text):
        names = [name.removesuffix("'s") for name in re.findall(NAME, match[1] + match[2])]
        yield names, match[4], match[0]


def known():
    """Family names by year, of every row."""
    rows = [line.split("|")[1] for line in read(PAGE).splitlines() if line.startswith("| ") and "cited as" not in line]
    return {(name, year) for row in rows for year in re.findall(r"\d{4}", row) for name in re.findall(NAME, row)}, rows


def cited(paths):
    for path in paths:
        if path == PAGE:
            continue
        text = re.sub(r"\n\s*(?:///?|#|\*|//)? ?", " ", read(path))
        for names, year, words in keys(text):
            if not NO_SOURCES & set(names):
                yield path, names, year, words


def test_every_citation_has_a_title():
    titles, _ = known()
    found = list(cited(listed(*FILES)))
    assert len(found) > 150
    missing = sorted({f"{words} ({path})" for path, names, year, words in found
                      if not any((name, year) in titles for name in names)})
    assert not missing, "without a row in " + PAGE


def test_no_title_is_left_over():
    """A row that nothing cites is one that somebody forgot."""
    used = {(name, year) for _, names, year, _ in cited(listed(*FILES)) for name in names}
    left = [row.strip() for row in known()[1]
            if not any((name, year) in used for year in re.findall(r"\d{4}", row) for name in re.findall(NAME, row))]
    assert not left
