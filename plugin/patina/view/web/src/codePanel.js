// SPDX-License-Identifier: Apache-2.0
// The text of the shader that is drawn, to be read and changed.
import { CodeEditor } from "./codeEditor.js";
import { Edits } from "./edits.js";
import { element } from "./element.js";
import { joined } from "./materials.js";

const titles = { material: "this material", head: "library: lobes and patterns, before it", page: "library: light, after it" };
const pause = () => new Promise(done => setTimeout(done, 30));

export class CodePanel {
    constructor(page) {
        this.page = page;
        this.edits = new Edits(page);
        this.part = "material";
        this.key = "";
        this.found = [];
        this.editor = new CodeEditor(() => this.typed());
        this.select = element("select", { onchange: () => { this.part = this.select.value; this.show(); } });
        this.whole = element("input", { type: "checkbox", onchange: () => {
            page.state.whole = this.whole.checked;
            page.refresh();
        } });
        const button = (id, text, run) => element("button", { id, type: "button", onclick: run }, text);
        this.compileButton = button("codeCompile", "Compile (Ctrl+Enter)", () => this.compile());
        this.revertButton = button("codeRevert", "Back to the generated text", () => this.revert());
        this.state = element("p", { id: "codeState", role: "status" });
        this.list = element("ol", { id: "codeErrors", "aria-label": "Messages of the compiler" });
        this.box = element("div", { className: "code" },
            element("div", { className: "tools" }, element("label", {}, "Part ", this.select),
                    element("label", {}, this.whole, " every input live"), this.compileButton, this.revertButton),
            this.state, this.list, this.editor.box);
        this.box.addEventListener("keydown", event => {
            if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
            event.preventDefault();
            this.compile();
        });
    }

    get title() { return `Shader of ${this.page.state.current.name}`; }

    // Follows the text that is drawn.
    refresh() {
        this.whole.checked = this.page.state.whole;
        const text = this.edits.current();
        if (text.key === this.key) {
            if (this.edits.drawn(text) !== this.drawn) this.showState("");
            return;
        }
        const left = this.key && this.edits.drafts.has(this.key) && this.key.split(" ")[0] === text.key.split(" ")[0];
        this.key = text.key;
        this.text = text;
        this.found = [];
        this.show(left ? "These values need another text, which is shown now. Your changes are kept with the text before, " +
                         "and come back with its values." : "");
    }

    show(said = "") {
        const { text, edits } = this, parts = edits.partsOf(text);
        this.select.replaceChildren(...Object.keys(titles).map(name => {
            const count = parts[name].trimEnd().split("\n").length;
            const changed = parts[name] === text.generated[name] ? "" : ", changed";
            return element("option", { value: name, selected: name === this.part }, `${titles[name]} (${count} lines${changed})`);
        }));
        this.editor.set(parts[this.part], `GLSL ES 3.00, ${titles[this.part]}`);
        this.showState(said);
    }

    showState(said) {
        const { edits, text, found } = this, errors = found.filter(m => m.isError).length;
        const changed = edits.drafts.has(text.key), drawn = this.drawn = edits.drawn(text);
        const state = errors ? `${errors} error${errors > 1 ? "s" : ""}: the picture shows the last text that compiled.`
            : !changed && !drawn ? "Generated text, as the page draws with it."
            : drawn === joined(edits.partsOf(text)) ? "Changed text, as the page draws with it."
            : "Changed, not compiled yet.";
        this.state.textContent = said ? `${said} ${state}` : state;
        this.revertButton.disabled = !changed && !drawn;
        this.list.replaceChildren(...found.slice(0, 50).map(m => element("li", { className: m.isError ? "error" : "warning" },
            m.part ? element("button", { type: "button", onclick: () => this.goTo(m) },
                             `${m.part === "material" ? "" : m.part + " "}line ${m.line}`) : null,
            ` ${m.text}`)));
        this.editor.mark(found.filter(m => m.part === this.part).reverse().map(m => [m.line, m.isError ? "error" : "warning"]));
    }

    goTo(message) {
        this.part = message.part;
        this.show();
        this.editor.goTo(message.line);
    }

    typed() {
        const { text, edits, editor, part } = this, count = t => t.split("\n").length;
        const more = count(editor.text) - count(edits.partsOf(text)[part]), caret = editor.caretLine();
        for (const m of this.found) // messages move with their lines
            if (m.part === part && m.line > caret - more) m.line += more;
        edits.change(text, part, editor.text);
        this.showState("");
    }

    // @returns whether the text is drawn now
    async compile() {
        if (this.busy) return false;
        this.busy = true;
        const { text, edits } = this;
        this.state.textContent = "Compiling ...";
        try {
            await pause(); // so that the word is seen
            const found = await edits.compile(text);
            const fits = !found.some(m => m.isError);
            if (text.key === this.key) {
                this.found = found;
                const first = found.find(m => m.isError && m.part);
                if (first && !found.some(m => m.part === this.part)) this.part = first.part;
                this.show();
                if (first) this.editor.show(first.line);
            }
            return fits;
        } finally {
            this.busy = false;
        }
    }

    revert() {
        this.edits.putAside(this.text, false);
        this.found = [];
        this.show();
    }
}
