// SPDX-License-Identifier: Apache-2.0
// A row of shapes along a range of one input.

export function wedgeOf(page, input, component = 0) {
    const { material, values } = page.state, control = page.state.current.controls
        .find(c => c.input === page.state.current.inputs[input].input);
    const count = values[material][input].length;
    return { input, component: count > 1 && control?.kind !== "color" ? component : count > 1 ? -1 : 0,
             from: control?.min ?? 0, to: control?.max ?? 1, count: 5 };
}

export function addWedge(gui, page) {
    const { state, viewer } = page, material = state.current;
    if (!material.inputs.length) return;
    const folder = gui.addFolder("wedge");
    const names = { off: -1 };
    for (const control of material.controls) {
        const i = material.inputs.findIndex(input => input.input === control.input);
        if (i >= 0) names[`${control.folder} ${control.label}`] = i;
    }
    const proxy = {
        get input() { return state.wedge ? state.wedge.input : -1; },
        set input(i) { state.wedge = i < 0 ? null : wedgeOf(page, i); }
    };
    folder.add(proxy, "input", names).onChange(() => { viewer.invalidate(); page.panel.rebuild(); });
    if (!state.wedge) return;
    const changed = () => viewer.invalidate();
    folder.add(state.wedge, "from").onChange(changed);
    folder.add(state.wedge, "to").onChange(changed);
    folder.add(state.wedge, "count", 2, 9, 1).onChange(changed);
}
