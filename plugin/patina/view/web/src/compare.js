// SPDX-License-Identifier: Apache-2.0
// The path-traced picture beside the page's own.
import * as THREE from "three";
import { meanFlip } from "./flip.js";
import { makeTexture } from "./textures.js";

export async function loadReferences(viewer, data) {
    for (const reference of data.references) {
        const texture = await makeTexture(reference.image);
        viewer.references.set(`${reference.material} ${reference.shape}`, { texture, ...reference.image });
    }
}

const tick = () => new Promise(done => setTimeout(done));

// Mean FLIP of what the page draws from the same place, at the reference's size.
export async function measure(page) {
    const { viewer, state } = page, reference = viewer.reference();
    if (!reference) return null;
    const [width, height] = [viewer.width, viewer.height];
    page.paused = true;
    try {
        viewer.resize(reference.width, reference.height);
        viewer.invalidate();
        while (viewer.step()) await tick();
        const own = viewer.accumulator.read(), other = reference.texture.image.data;
        const n = reference.width * reference.height, a = new Float32Array(3 * n), b = new Float32Array(3 * n);
        for (let y = 0; y < reference.height; ++y)
            for (let x = 0; x < reference.width; ++x)
                for (let c = 0; c < 3; ++c) {
                    const at = y * reference.width + x, flipped = (reference.height - 1 - y) * reference.width + x;
                    a[3 * at + c] = own[4 * flipped + c];
                    b[3 * at + c] = THREE.DataUtils.fromHalfFloat(other[4 * at + c]);
                }
        return meanFlip(b, a, reference.width, reference.height, 2 ** state.exposure);
    } finally {
        viewer.resize(width, height);
        viewer.invalidate();
        page.paused = false;
    }
}

export function addCompare(gui, page) {
    const { viewer, state, data } = page;
    if (!data.references.some(r => r.material === state.material)) return;
    const folder = gui.addFolder("compare");
    folder.add(state, "wipe", 0, 1).name("path traced from").onChange(() => {
        viewer.redraw();
        if (!viewer.reference()) page.say("The path-traced picture is of the first view and the first values: " +
                                          "reset everything to compare.");
    });
    folder.add({ run: async () => {
        page.say("Measuring ...");
        const flip = await page.measureFlip();
        page.say(flip === null ? "There is no path-traced picture of this view and these values."
            : `Mean FLIP against the path tracer: ${flip.toFixed(4)}`);
    } }, "run").name("measure FLIP").domElement.dataset.action = "flip";
}
