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

export function addInputs(gui, page) {
    const { state, viewer } = page, material = state.current, values = state.values[state.material];
    const index = new Map(material.inputs.map((input, i) => [input.input, i]));
    const folders = new Map();
    const changed = () => viewer.invalidate();
    for (const control of material.controls) {
        const i = index.get(control.input);
        if (i === undefined) continue;
        if (!folders.has(control.folder)) {
            folders.set(control.folder, gui.addFolder(control.folder));
            if (folders.size > 3) folders.get(control.folder).close();
        }
        const folder = folders.get(control.folder);
        if (control.kind === "color")
            addColor(folder, control.label, () => values[i], c => { values[i] = c; }).onChange(changed);
        else addNumber(folder, control, values, i, changed);
    }
}
