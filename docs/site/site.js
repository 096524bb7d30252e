// SPDX-License-Identifier: Apache-2.0
// Gives the theme's pages what keyboards and screen readers need and the theme leaves out.
"use strict";

function mend() {
    for (const dialog of document.querySelectorAll("[role=dialog]:not([aria-label])"))
        dialog.setAttribute("aria-label", "Search");
    for (const nav of document.querySelectorAll("nav.md-nav[aria-labelledby]")) {
        const label = document.getElementById(nav.getAttribute("aria-labelledby"));
        if (label) nav.setAttribute("aria-label", `Pages: ${label.textContent.trim()}`);
        nav.removeAttribute("aria-labelledby"); // the labels of two levels have the same text
    }
    for (const cell of document.querySelectorAll("th")) {
        if (cell.textContent.trim() || cell.children.length) continue;
        cell.replaceWith(document.createElement("td"));
    }
    for (const box of document.querySelectorAll(".md-typeset__scrollwrap, .md-typeset pre > code, .mermaid")) {
        if (box.scrollWidth <= box.clientWidth) box.removeAttribute("tabindex");
        else box.tabIndex = 0; // arrow keys then move a table that is wider than the screen
    }
}

mend();
addEventListener("load", mend);
addEventListener("resize", mend);
new MutationObserver(mend).observe(document.body, {childList: true, subtree: true}); // tables are wrapped later
