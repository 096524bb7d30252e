import GUI from "lil-gui";

export function buildPanel(page) {
    const gui = new GUI({ title: page.data.title });
    gui.add(page.state, "exposure", -6, 6, 0.1).onChange(() => page.viewer.redraw());
    return gui;
}
