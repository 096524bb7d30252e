// SPDX-License-Identifier: Apache-2.0
// A text area with line numbers, colours and marked lines. What is painted behind it are the lines in
// view alone, so that long texts stay quick.
import { element } from "./element.js";
import { colored } from "./glslColors.js";

const lineHeight = 18; // pixels, as in page.css

export class CodeEditor {
    // @param changed called after the user has typed
    constructor(changed) {
        this.lines = [""];
        this.marks = new Map(); // line -> "error" or "warning"
        this.area = element("textarea", { id: "codeText", spellcheck: false, wrap: "off", autocomplete: "off",
                                          autocapitalize: "off", "aria-describedby": "codeState" });
        this.numbers = element("div", { className: "numbers", "aria-hidden": "true" });
        this.back = element("div", { className: "back", "aria-hidden": "true" });
        this.box = element("div", { className: "editor" }, this.back, this.area, this.numbers);
        this.area.addEventListener("scroll", () => this.paint());
        this.area.addEventListener("input", () => { this.split(); this.paint(); changed(); });
        new ResizeObserver(() => this.paint()).observe(this.area);
    }

    get text() { return this.area.value; }

    set(text, label) {
        this.area.setAttribute("aria-label", label);
        if (text !== this.area.value) {
            this.area.value = text;
            this.area.scrollTop = this.area.scrollLeft = 0;
        }
        this.split();
        this.paint();
    }

    // @param marks list of [line, "error" or "warning"]
    mark(marks) {
        this.marks = new Map(marks);
        this.area.setAttribute("aria-invalid", String(marks.some(([, kind]) => kind === "error")));
        this.paint();
    }

    split() {
        this.lines = this.text.split("\n");
        this.box.style.setProperty("--digits", String(this.lines.length).length);
    }

    paint() {
        const { scrollTop, scrollLeft, clientHeight } = this.area;
        const first = Math.floor(scrollTop / lineHeight), count = Math.ceil(clientHeight / lineHeight) + 1;
        const before = this.lines.slice(0, first).join("\n");
        let inComment = before.lastIndexOf("/*") > before.lastIndexOf("*/");
        const numbers = [], rows = [];
        this.lines.slice(first, first + count).forEach((line, i) => {
            const kind = this.marks.get(first + i + 1) ?? "";
            numbers.push(element("div", { className: kind }, (kind ? "\u25cf " : "") + (first + i + 1)));
            rows.push(element("div", { className: kind }, ...colored(line.slice(0, 2000), inComment).map(([text, color]) =>
                color ? element("span", { className: color }, text) : text)));
            if (line.includes("/*") || line.includes("*/")) inComment = line.lastIndexOf("/*") > line.lastIndexOf("*/");
        });
        this.numbers.replaceChildren(...numbers);
        this.back.replaceChildren(...rows);
        const shift = first * lineHeight - scrollTop;
        this.numbers.style.transform = `translateY(${shift}px)`;
        this.back.style.transform = `translate(${-scrollLeft}px, ${shift}px)`;
    }

    caretLine() { return this.text.slice(0, this.area.selectionStart).split("\n").length; }

    show(line) {
        this.area.scrollTop = Math.max(0, (line - 3) * lineHeight);
        this.paint();
    }

    // Selects a line and shows it.
    goTo(line) {
        const from = this.lines.slice(0, line - 1).reduce((sum, l) => sum + l.length + 1, 0);
        this.area.focus();
        this.area.setSelectionRange(from, from + (this.lines[line - 1] ?? "").length);
        this.show(line);
    }
}
