// SPDX-License-Identifier: Apache-2.0
// Starts the page.
import * as THREE from "three";
import { readDocument, unpack } from "./data.js";
import { makeShape } from "./shapes.js";
import { State } from "./state.js";
import { makeTable, makeTexture, makeValues } from "./textures.js";
import { buildInterface } from "./interface.js";
import { Viewer } from "./viewer.js";

function refuse(text) {
    const box = document.getElementById("problem");
    box.textContent = text;
    box.hidden = false;
}

async function makeParts(data) {
    // Those of one image share its texture.
    const own = data.environments.map(e => e.texelsOf === undefined ? makeTexture(e) : null);
    const environments = await Promise.all(data.environments.map(async (e, i) => ({
        name: e.name, texture: await own[e.texelsOf ?? i], radiance: e.radiance,
        toLocal: new THREE.Matrix3().fromArray(e.toLocal)
    })));
    return {
        albedo: await makeTable(data.albedo), environments,
        lightTable: makeValues(await unpack(data.lightTable, "f4")),
        textures: await Promise.all(data.textures.map(makeTexture)),
        shapes: await Promise.all(data.shapes.map(makeShape))
    };
}

async function start() {
    const canvas = document.getElementById("view");
    if (!document.createElement("canvas").getContext("webgl2")) {
        refuse("This page needs WebGL 2, which this browser does not offer. A current Firefox, Chrome, Edge or " +
               "Safari has it; where it does, hardware acceleration may be switched off in its settings.");
        return null;
    }
    if (typeof DecompressionStream === "undefined") {
        refuse("This browser cannot unpack the page's data. Firefox from 113, Chrome from 80 and Safari from 16.4 can.");
        return null;
    }
    const data = await readDocument();
    const state = new State(data);
    if (location.hash.length > 1) state.fromText(location.hash.slice(1));
    const viewer = new Viewer(canvas, data, await makeParts(data), state);
    const page = await buildInterface(viewer, data, state);
    // As many passes a frame as leave the page fluent.
    let steps = 1, last = 0;
    const loop = now => {
        requestAnimationFrame(loop);
        steps = now - last < 24 ? Math.min(8, steps + 1) : Math.max(1, steps >> 1);
        last = now;
        if (page.paused) return;
        page.beforeStep();
        if (!viewer.accumulator.count) steps = 1;
        for (let i = 0; i < steps && viewer.step(); ++i)
            page.firstPicture ||= performance.now();
    };
    requestAnimationFrame(loop);
    return page;
}

window.patina = { ready: start().catch(error => { refuse(`The page cannot be shown: ${error.message}`); throw error; }) };
