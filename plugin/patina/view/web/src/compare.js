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

// Draws pictures of another size, and then goes on with the page's own.
// @param use called with draw(), which gives { colors, cover }: three numbers a pixel, linear, and one, top row first
export async function aside(page, width, height, use) {
    const { viewer } = page, size = [viewer.width, viewer.height];
    page.paused = true;
    try {
        viewer.resize(width, height);
        return await use(async () => {
            viewer.invalidate();
            while (viewer.step()) await tick();
            const own = viewer.accumulator.read(), n = width * height;
            const colors = new Float32Array(3 * n), cover = new Float32Array(n);
            for (let i = 0; i < n; ++i) {
                const from = 4 * ((height - 1 - Math.floor(i / width)) * width + i % width);
                colors.set(own.subarray(from, from + 3), 3 * i);
                cover[i] = own[from + 3];
            }
            return { colors, cover };
        });
    } finally {
        viewer.resize(...size);
        viewer.invalidate();
        page.paused = false;
    }
}

// Mean FLIP of what the page draws from the same place, at the reference's size.
export async function measure(page) {
    const { viewer, state } = page, reference = viewer.reference();
    if (!reference) return null;
    const { width, height } = reference, other = reference.texture.image.data;
    return aside(page, width, height, async draw => {
        const { colors } = await draw(), b = new Float32Array(3 * width * height);
        for (let i = 0; i < width * height; ++i)
            for (let c = 0; c < 3; ++c) b[3 * i + c] = THREE.DataUtils.fromHalfFloat(other[4 * i + c]);
        return meanFlip(b, colors, width, height, 2 ** state.exposure);
    });
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
