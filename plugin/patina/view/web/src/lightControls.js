// SPDX-License-Identifier: Apache-2.0
// Direct lights of the page, each with a switch, a gain and a colour.

export function addLights(gui, page, addColor) {
    const { data, state, viewer } = page;
    if (!data.lights.length) return;
    const changed = () => viewer.invalidate();
    const all = gui.addFolder("lights");
    data.lights.forEach((light, i) => {
        const one = all.addFolder(light.name), values = state.lights[i];
        one.add(values, "on").onChange(changed);
        one.add(values, "gain", 0, 4).onChange(changed);
        addColor(one, "tint", () => values.color, c => { values.color = c; }).onChange(changed);
        if (i > 3) one.close();
    });
}
