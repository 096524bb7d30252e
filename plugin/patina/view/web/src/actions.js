// SPDX-License-Identifier: Apache-2.0
// Exports of the page: pictures, layers, links; and the reset to the start.
import { layerText } from "./layer.js";

function save(name, blob) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const fileName = (state, end) => (state.current.name.replace(/[^\w-]+/g, "_").slice(0, 60) || "material") + end;

export function savePicture(page) {
    page.viewer.redraw();
    page.viewer.step();
    page.viewer.canvas.toBlob(blob => save(fileName(page.state, ".png"), blob), "image/png");
}

function saveLayer(page) {
    save(fileName(page.state, ".usda"), new Blob([layerText(page.state)], { type: "text/plain" }));
}

async function copyLink(page) {
    const text = page.state.toText();
    history.replaceState(null, "", "#" + text);
    try {
        await navigator.clipboard.writeText(location.href);
        page.say("The link is in the clipboard; it holds the values, for a reader who has this page.");
    } catch {
        page.say("The address of this page now holds the values; copy it from there.");
    }
}

export function addActions(gui, page) {
    const folder = gui.addFolder("page");
    const add = (name, title, run) => {
        const button = folder.add({ run }, "run").name(title);
        button.domElement.dataset.action = name;
    };
    add("shader", "shader (c)", () => page.drawer.toggle(page.code));
    add("plan", "plan (l)", () => page.drawer.toggle(page.plan));
    add("png", "save the picture (p)", () => savePicture(page));
    add("layer", "save the values as .usda", () => saveLayer(page));
    add("link", "copy a link to this", () => copyLink(page));
    add("reset", "reset everything (r)", () => page.reset());
}
