// SPDX-License-Identifier: Apache-2.0
// The space below the picture, which shows one thing at a time.
import { element } from "./element.js";

export class Drawer {
    constructor() {
        this.box = document.getElementById("drawer");
        this.shown = null;
        this.box.addEventListener("keydown", event => { if (event.key === "Escape") this.close(); });
    }

    // @param content has a title, a box, and refresh() for what may have changed
    toggle(content) {
        if (this.shown === content) return this.close();
        this.shown = content;
        const title = element("h2", { id: "drawerTitle", tabIndex: -1 });
        const close = element("button", { type: "button", onclick: () => this.close() }, "Close (Esc)");
        this.box.replaceChildren(element("header", {}, title, close), content.box);
        this.box.hidden = false;
        document.querySelector("main").classList.add("drawn");
        this.refresh();
        title.focus();
    }

    close() {
        if (!this.shown) return;
        this.shown = null;
        this.box.hidden = true;
        this.box.replaceChildren();
        document.querySelector("main").classList.remove("drawn");
        document.getElementById("view").focus();
    }

    refresh() {
        if (!this.shown) return;
        const title = document.getElementById("drawerTitle"), text = this.shown.title;
        if (title.textContent !== text) title.textContent = text;
        this.shown.refresh();
    }
}
