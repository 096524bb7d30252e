// SPDX-License-Identifier: Apache-2.0
// Sliders and colour pickers for the inputs of the material that is shown, one folder per node.
import { addColor } from "./panel.js";

const suffixes = { 2: ["x", "y"], 3: ["x", "y", "z"], 4: ["x", "y", "z", "w"] };
const colors = ["r", "g", "b", "a"];

function addNumber(folder, control, values, index, changed) {
    const count = values[index].length;
    const names = control.default.length > 1 && control.kind === "number" && /ior|extinction|color|radius/i.test(control.label)
        ? colors : suffixes[count];
    for (let c = 0; c < count; ++c) {
        const proxy = { get value() { return values[index][c]; }, set value(x) { values[index][c] = x; } };
        const unit = control.unit ? ` (${control.unit})` : "";
        const slider = folder.add(proxy, "value", control.min, control.max);
        if (control.step > 0) slider.step(control.step);
        slider.name(control.label + (count > 1 ? " " + names[c] : "") + unit).onChange(changed);
    }
}

function addSwitch(folder, control, values, index, changed) {
    const proxy = { get on() { return values[index][0] !== 0; }, set on(x) { values[index] = [x ? 1 : 0]; } };
    folder.add(proxy, "on").name(control.label).onChange(changed);
}

// A value of which each has a program of its own.
function addChoice(folder, control, page) {
    const { state } = page, index = state.current.choices.findIndex(c => c.input === control.input);
    const options = Object.fromEntries(control.options.map((text, i) => [text, i]));
    const proxy = { get at() { return state.choices[state.material][index]; }, set at(i) {
        if (state.choose(index, i)) page.pending = "The page has no program for these choices together: " +
            "the others are back where they were.";
    } };
    folder.add(proxy, "at", options).name(control.label).onChange(() => page.refresh());
}

function addFixed(folder, control) {
    const shown = folder.add({ value: control.default }, "value").name(control.label).disable();
    shown.domElement.title = `Fixed: ${control.reason}.`;
}

function fill(folder, controls, page, index, changed) {
    const { state } = page, values = state.values[state.material];
    for (const control of controls) {
        const i = index.get(control.input);
        if (control.kind === "choice") addChoice(folder, control, page);
        else if (control.kind === "fixed") addFixed(folder, control);
        else if (i === undefined) continue;
        else if (control.kind === "switch") addSwitch(folder, control, values, i, changed);
        else if (control.kind === "color")
            addColor(folder, control.label, () => values[i], c => { values[i] = c; }).onChange(changed);
        else addNumber(folder, control, values, i, changed);
    }
}

const eager = 3, manyFolders = 40;

// Folders are filled when they are opened first: a large material has thousands of controls.
export function addInputs(gui, page) {
    const { state, viewer } = page, material = state.current;
    const index = new Map(material.inputs.map((input, i) => [input.input, i]));
    const byFolder = grouped(material.controls);
    const changed = () => viewer.invalidate();
    let parent = gui, count = 0;
    for (const [title, controls] of byFolder) {
        if (byFolder.size > manyFolders && count % manyFolders === 0) {
            parent = gui.addFolder(`nodes ${count + 1} to ${Math.min(count + manyFolders, byFolder.size)}`);
            if (count) parent.close();
        }
        const folder = parent.addFolder(title);
        if (count++ < eager) {
            fill(folder, controls, page, index, changed);
            continue;
        }
        folder.close();
        let filled = false;
        folder.fill = () => {
            if (!filled) fill(folder, controls, page, index, changed);
            filled = true;
        };
        folder.onOpenClose(f => { if (f === folder && !f._closed) f.fill(); });
    }
}

function grouped(controls) {
    const groups = new Map();
    for (const c of controls) groups.has(c.folder) ? groups.get(c.folder).push(c) : groups.set(c.folder, [c]);
    return groups;
}
