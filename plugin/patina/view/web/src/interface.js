// SPDX-License-Identifier: Apache-2.0
// The parts of the interface, and what they do to the state.
import { TrackballControls } from "three/examples/jsm/controls/TrackballControls.js";
import { CodePanel } from "./codePanel.js";
import { loadReferences, measure } from "./compare.js";
import { Drawer } from "./drawer.js";
import { listen } from "./keyboard.js";
import { Panel } from "./panel.js";
import { PlanPanel } from "./planPanel.js";

// The size of the canvas in pixels: what its box shows, or what the address asks for (?width=256).
function sizeOf(canvas) {
    const asked = Number(new URLSearchParams(location.search).get("width"));
    if (asked >= 16 && asked <= 4096) return [Math.round(asked), Math.round(asked)];
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    return [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
}

export class Page {
    constructor(viewer, data, state) {
        Object.assign(this, { viewer, data, state, paused: false, firstPicture: 0 });
        this.controls = new TrackballControls(viewer.camera, viewer.canvas);
        Object.assign(this.controls, { noPan: true, rotateSpeed: 2.5, staticMoving: true, keys: ["", "", ""] });
        viewer.camera.near = data.camera.radius * 0.01;
        viewer.camera.far = data.camera.radius * 100;
        this.placeCamera();
        this.controls.addEventListener("change", () => viewer.invalidate());
        new ResizeObserver(() => this.fit()).observe(viewer.canvas);
        this.fit();
        this.panel = new Panel(this);
        this.drawer = new Drawer();
        this.code = new CodePanel(this);
        this.plan = new PlanPanel(this);
        viewer.canvas.addEventListener("webglcontextlost", () => this.lose());
        listen(this);
    }

    placeCamera() {
        const { camera } = this.viewer;
        camera.position.fromArray(this.state.eye);
        camera.up.fromArray(this.data.camera.up);
        this.controls.target.fromArray(this.data.camera.target);
        this.controls.update();
    }

    fit() {
        const [w, h] = sizeOf(this.viewer.canvas);
        this.controls.handleResize();
        if (w === this.viewer.width && h === this.viewer.height) return;
        this.viewer.resize(w, h);
        this.viewer.invalidate();
    }

    // A shader that never ends, for one. three.js sets up anew what it has when the browser allows.
    lose() {
        this.code.edits.putAllAside();
        this.say("The browser has stopped this page's graphics, perhaps because a shader took too long. The page draws " +
                 "with the generated text; what was written is still in the shader's panel.");
    }

    beforeStep() {
        this.drawer.refresh();
        this.controls.update();
        this.state.eye = this.viewer.camera.position.toArray();
    }

    refresh() {
        this.viewer.invalidate();
        this.panel.rebuild();
    }

    choose(i) {
        this.state.material = i;
        this.state.wedge = null;
        this.refresh();
    }

    usePreset(preset) {
        const { current, values, material } = this.state;
        current.inputs.forEach((input, i) => {
            if (preset.values[input.input]) values[material][i] = preset.values[input.input].slice();
        });
        current.choices.forEach((choice, i) => {
            const control = current.controls.find(c => c.input === choice.input);
            const at = control?.options?.indexOf(preset.values[choice.input]) ?? -1;
            if (at >= 0) this.state.choose(i, at);
        });
        this.refresh();
    }

    reset() {
        const { material } = this.state;
        this.state.reset();
        this.state.material = material;
        this.code.edits.putAllAside();
        history.replaceState(null, "", location.pathname + location.search);
        this.placeCamera();
        this.refresh();
    }

    // Mean FLIP against the path-traced picture; null where there is none of this view.
    measureFlip() { return measure(this); }

    say(text) { document.getElementById("note").textContent = text; }
    showNote() {
        const { sentence, notes } = this.state.current;
        const { pending = "" } = this;
        this.pending = "";
        this.say([pending, sentence, ...[...notes, ...this.data.notes].map(n => n[0].toUpperCase() + n.slice(1) + ".")].filter(Boolean).join(" "));
    }
}

export async function buildInterface(viewer, data, state) {
    await loadReferences(viewer, data);
    return new Page(viewer, data, state);
}
