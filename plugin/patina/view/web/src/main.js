// Starts the page.
import * as THREE from "three";
import { readDocument } from "./data.js";
import { makeShape } from "./shapes.js";
import { State } from "./state.js";
import { makeTable, makeTexture } from "./textures.js";
import { buildInterface } from "./interface.js";
import { Viewer } from "./viewer.js";

function refuse(text) {
    const box = document.getElementById("problem");
    box.textContent = text;
    box.hidden = false;
}

async function makeParts(data) {
    const environments = await Promise.all(data.environments.map(async e => ({
        name: e.name, texture: await makeTexture(e), radiance: e.radiance,
        toLocal: new THREE.Matrix3().fromArray(e.toLocal)
    })));
    return {
        albedo: await makeTable(data.albedo), environments,
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
    const data = readDocument();
    const state = new State(data);
    if (location.hash.length > 1) state.fromText(location.hash.slice(1));
    const viewer = new Viewer(canvas, data, await makeParts(data), state);
    const page = await buildInterface(viewer, data, state);
    const loop = () => {
        if (page.paused) return requestAnimationFrame(loop);
        page.beforeStep();
        if (viewer.step() && viewer.accumulator.count === 1 && !page.firstPicture)
            page.firstPicture = performance.now();
        requestAnimationFrame(loop);
    };
    requestAnimationFrame(loop);
    return page;
}

window.patina = { ready: start().catch(error => { refuse(`The page cannot be shown: ${error.message}`); throw error; }) };
