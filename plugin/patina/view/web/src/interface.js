// The parts of the interface, and what they do to the state.
import { TrackballControls } from "three/examples/jsm/controls/TrackballControls.js";
import { buildPanel } from "./panel.js";

// The size of the canvas in pixels: what its box shows, or what the address asks for (?width=256).
function sizeOf(canvas) {
    const asked = Number(new URLSearchParams(location.search).get("width"));
    if (asked >= 16 && asked <= 4096) return [Math.round(asked), Math.round(asked)];
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    return [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
}

export async function buildInterface(viewer, data, state, refuse) {
    const { canvas, camera } = viewer;
    const page = { viewer, data, state, paused: false, firstPicture: 0, refuse };
    camera.position.fromArray(state.eye);
    camera.up.fromArray(data.camera.up);
    const controls = new TrackballControls(camera, canvas);
    Object.assign(controls, { noPan: true, rotateSpeed: 2.5, dynamicDampingFactor: 0.3, staticMoving: true });
    controls.target.fromArray(data.camera.target);
    camera.near = data.camera.radius * 0.01;
    camera.far = data.camera.radius * 100;
    controls.addEventListener("change", () => viewer.invalidate());
    controls.update();
    page.controls = controls;
    page.fit = () => {
        const [w, h] = sizeOf(canvas);
        if (w !== viewer.width || h !== viewer.height) viewer.resize(w, h);
        controls.handleResize();
        viewer.invalidate();
    };
    window.addEventListener("resize", page.fit);
    page.fit();
    page.beforeStep = () => {
        controls.update();
        state.eye = camera.position.toArray();
    };
    page.panel = buildPanel(page);
    return page;
}
