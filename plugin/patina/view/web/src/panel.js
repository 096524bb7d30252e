// SPDX-License-Identifier: Apache-2.0
// The panel: every part of the state has a control.
import GUI from "lil-gui";
import { addCompare } from "./compare.js";
import { addInputs } from "./inputs.js";
import { addLights } from "./lightControls.js";
import { addActions } from "./actions.js";
import { addWedge } from "./wedge.js";

export const decode = x => x <= 0.04045 ? x / 12.92 : Math.pow((x + 0.055) / 1.055, 2.4);
export const encode = x => x <= 0.0031308 ? 12.92 * x : x >= 1 ? 1 : 1.055 * Math.pow(x, 1 / 2.4) - 0.055;

// A colour picker shows display values of a linear colour.
export function addColor(folder, name, get, set) {
    const proxy = { get color() { return get().map(encode); }, set color(c) { set(c.map(decode)); } };
    return folder.addColor(proxy, "color").name(name);
}

function choices(list) {
    const out = {};
    list.forEach((item, i) => {
        let name = item.name;
        while (name in out) name += " ";
        out[name] = i;
    });
    return out;
}

export class Panel {
    constructor(page) {
        this.page = page;
        this.box = document.getElementById("panel");
        this.rebuild();
    }

    // All of it anew, after what it shows has changed from elsewhere.
    rebuild() {
        const { page } = this, { data, state, viewer } = page;
        const folders = this.gui?.foldersRecursive() ?? [];
        const closed = new Set(folders.filter(f => f._closed).map(f => f._title));
        const open = new Set(folders.filter(f => !f._closed).map(f => f._title));
        const scroll = this.box.scrollTop;
        this.gui?.destroy();
        this.gui = new GUI({ container: this.box, title: data.title, touchStyles: true });
        const changed = () => viewer.invalidate();
        if (data.materials.length > 1)
            this.gui.add(state, "material", choices(data.materials)).onChange(i => page.choose(i));
        this.presets();
        addInputs(this.gui, page);
        const view = this.gui.addFolder("view");
        view.add(state, "shape", choices(data.shapes)).onChange(changed);
        view.add(state, "environment", choices(data.environments)).onChange(changed);
        const turn = { get degrees() { return state.rotation * 180 / Math.PI; },
                       set degrees(x) { state.rotation = x * Math.PI / 180; } };
        view.add(turn, "degrees", -180, 180, 1).name("environment turned by").onChange(changed);
        view.add(state, "environmentGain", 0, 4).name("environment gain").onChange(changed);
        addColor(view, "ambient", () => state.ambient, c => { state.ambient = c; }).onChange(changed);
        view.add(state, "exposure", -6, 6, 0.1).onChange(() => viewer.redraw());
        view.add(state, "samples", [4, 8, 16, 32, 64, 128, 256, 512, 1024]).onChange(changed);
        view.add(state, "backdrop").name("show environment").onChange(changed);
        addLights(this.gui, page, addColor);
        addWedge(this.gui, page);
        addCompare(this.gui, page);
        addActions(this.gui, page);
        for (const folder of this.gui.foldersRecursive()) {
            if (closed.has(folder._title)) folder.close();
            if (!open.has(folder._title)) continue;
            folder.fill?.();
            folder.open();
        }
        this.box.scrollTop = scroll;
        page.showNote();
    }

    presets() {
        const { page } = this, { presets } = page.state.current;
        if (!presets.length) return;
        const folder = this.gui.addFolder("presets");
        for (const preset of presets)
            folder.add({ set: () => page.usePreset(preset) }, "set").name(preset.name);
    }
}
