// SPDX-License-Identifier: Apache-2.0
"use strict";
// Shows the materials that hold every word of the search.
const find = document.getElementById("find"), found = document.getElementById("found");
find.addEventListener("input", () => {
    const words = find.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const section of document.querySelectorAll("section")) {
        let here = 0;
        for (const article of section.querySelectorAll("article")) {
            article.hidden = !words.every((word) => article.dataset.words.includes(word));
            here += article.hidden ? 0 : 1;
        }
        section.hidden = here === 0;
        count += here;
    }
    found.textContent = words.length ? `${count} found` : "";
});
