# SPDX-License-Identifier: Apache-2.0
"""The look of charts and pages, once: colours for light and dark, and the style that all pages of Python share.

The hues are about those of Okabe and Ito (2008). Their lightness was searched for the largest difference between any two, with
all cones and without long-wave or middle-wave ones, among colours that can be read as text on white, or on the dark paper.
testenv/cli/test_look.py holds them to that. A chart is drawn for white; a rule in it replaces its colours where the reader's
system asks for dark.
"""
from xml.sax.saxutils import quoteattr

from patina import pagePolicy

PAPER, INK, DIM, GRID, FRAME, TRUTH, FRONT = "#ffffff", "#222222", "#5c6066", "#e4e4e4", "#bbbbbb", "#b4b8be", "#f0d878"
BLUE, ORANGE, GREEN, PURPLE, BROWN, BLACK = "#0967ed", "#a36704", "#19825f", "#9c0082", "#443300", "#27292a"
COLOURS = (BLUE, ORANGE, GREEN, PURPLE, BROWN, BLACK)
DARK = {PAPER: "#1b1c1f", INK: "#e7e8ea", DIM: "#a4a9b1", GRID: "#34373c", FRAME: "#50545b", TRUTH: "#63676e", FRONT: "#6d5c1a",
        BLUE: "#6c98fe", ORANGE: "#e95b37", GREEN: "#1cffa4", PURPLE: "#e7418f", BROWN: "#ffd925", BLACK: "#ececff"}
BACKENDS = {"embree": BLUE, "denoised": GREEN, "raster": ORANGE}
CHAR = 6.1  # width of a letter of 11 pixels' height, about


def start(title, width, height, size=11):
    """:param title: what a screen reader says of it
    :param size: of letters, in pixels
    :returns: the head of a chart, with its paper"""
    swaps = "".join(f'.chart [{kind}="{light}"]{{{kind}:{dark}}}' for light, dark in DARK.items()
                    for kind in ("fill", "stroke"))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" class="chart" role="img" aria-label={quoteattr(title)} width="{width}" '
            f'height="{height}" viewBox="0 0 {width} {height}" font-family="system-ui, sans-serif" font-size="{size}">'
            f"<style>@media (prefers-color-scheme:dark){{{swaps}}}</style>"
            f'<rect width="{width}" height="{height}" fill="{PAPER}"/>')


# Pages: charts, stability, both back ends. report.css and page.css take the same values.
PAGE = """
:root{color-scheme:light dark;--back:#fafafa;--card:#fff;--line:#ddd;--text:#222;--dim:#5c6066;--bad:#a3180b;--mark:#f0d878;
--tint:#fff6d6;--link:#0967ed}
@media (prefers-color-scheme:dark){:root{--back:#17181a;--card:#1b1c1f;--line:#34373c;--text:#e7e8ea;--dim:#a4a9b1;
--bad:#ff8f80;--mark:#6d5c1a;
--tint:#2c2817;--link:#6c98fe}}
*{box-sizing:border-box}
body{font:15px/1.5 system-ui,"DejaVu Sans",sans-serif;color:var(--text);background:var(--back);margin:0 auto;max-width:1440px;
padding:28px 24px 60px}
h1{font-size:24px;margin:0 0 6px}h2{font-size:20px;margin:44px 0 8px;border-top:2px solid var(--line);padding-top:18px}
h3{font-size:15px;margin:18px 0 6px}p{max-width:76em}a{color:var(--link)}.dim,figcaption{color:var(--dim)}
.bad{color:var(--bad)}b{font-weight:600}
code{font:13px/1.5 ui-monospace,"DejaVu Sans Mono",monospace;overflow-wrap:anywhere}
table{border-collapse:collapse;font-size:13px;background:var(--card)}
td,th{padding:3px 9px;border:1px solid var(--line);text-align:right;vertical-align:top}
th{font-weight:600;background:var(--back)}td.t,th.t{text-align:left}.wide{overflow-x:auto}
.charts{display:flex;flex-wrap:wrap;gap:14px}.charts svg{border:1px solid var(--line);max-width:100%;height:auto}
.shots{display:flex;flex-wrap:wrap;gap:10px}figure{margin:0}figcaption{font-size:13px;padding-top:4px}
:focus-visible{outline:2px solid var(--link);outline-offset:1px}
@media (max-width:640px){body{padding:16px 12px 40px}}
"""


def page(title, style=""):
    """:returns: the beginning of an HTML page, up to its first heading"""
    return (f'<!doctype html><html lang="en"><head><meta charset="utf-8">{pagePolicy.meta()}'
            '<meta name="viewport" content="width=device-width">'
            f"<title>{title}</title><style>{PAGE}{style}</style></head><body><main>")


WIDE = '<div class="wide" tabindex="0" role="region" aria-label="table">'  # scrolls by keyboard, too
END = "</main></body></html>\n"
