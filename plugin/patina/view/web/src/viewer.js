// SPDX-License-Identifier: Apache-2.0
// Draws the page's picture pass by pass until it is done; everything that changes it starts it over.
import * as THREE from "three";
import { Accumulator } from "./accumulator.js";
import { drawSamples } from "./environmentSamples.js";
import { fillLive } from "./materials.js";
import { PageScene } from "./scene.js";
import { makeRows } from "./textures.js";

function radicalInverse(i, base) {
    let x = 0;
    for (let share = 1 / base; i > 0; i = Math.floor(i / base), share /= base) x += (i % base) * share;
    return x;
}

export class Viewer {
    constructor(canvas, data, parts, state) {
        this.canvas = canvas;
        this.data = data;
        this.parts = parts;
        this.state = state;
        this.renderer = new THREE.WebGLRenderer({ canvas, antialias: false, preserveDrawingBuffer: true });
        this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
        this.renderer.autoClear = false;
        this.renderer.debug.checkShaderErrors = true;
        this.accumulator = new Accumulator(this.renderer);
        this.content = new PageScene(data, parts);
        this.camera = new THREE.PerspectiveCamera(data.camera.fov, 1, 0.01, 100);
        this.references = new Map();
        this.listeners = [];
        this.resize(canvas.width, canvas.height);
        this.invalidate();
    }

    resize(width, height) {
        this.width = Math.max(1, width);
        this.height = Math.max(1, height);
        this.renderer.setPixelRatio(1);
        this.renderer.setSize(this.width, this.height, false);
        this.accumulator.resize(this.width, this.height);
    }

    invalidate() {
        this.accumulator.count = 0;
        this.stale = true;
        this.drawn = false;
    }

    // Few samples go into one pass, so that a slow device still answers.
    get samplesPerPass() { return Math.min(8, Math.max(1, Math.floor(this.state.samples / 64))); }
    get passes() { return Math.max(1, Math.round(this.state.samples / this.samplesPerPass)); }
    get done() { return !this.stale && this.accumulator.count >= this.passes; }

    tiles() {
        const { wedge } = this.state;
        const values = this.state.values[this.state.material];
        if (!wedge) return [values];
        return Array.from({ length: wedge.count }, (_, i) => {
            const t = wedge.count > 1 ? i / (wedge.count - 1) : 0;
            const at = wedge.from + (wedge.to - wedge.from) * t;
            return values.map((v, k) => k !== wedge.input ? v
                : v.map((x, c) => wedge.component < 0 || wedge.component === c ? at : x));
        });
    }

    _apply() {
        const { state, content } = this, s = content.shared;
        const environment = this.parts.environments[state.environment];
        s.environmentMap.value = environment.texture;
        s.environmentInfo.value.set(environment.texture.userData.texels, environment.texture.userData.levels);
        const turn = new THREE.Matrix3().set(
            Math.cos(state.rotation), 0, Math.sin(state.rotation), 0, 1, 0,
            -Math.sin(state.rotation), 0, Math.cos(state.rotation));
        s.worldToEnvironment.value.multiplyMatrices(turn, environment.toLocal);
        s.environmentScale.value.fromArray(environment.radiance).multiplyScalar(state.environmentGain);
        s.ambient.value.fromArray(state.ambient);
        s.plain.value.set(...state.backdropColor, state.backdrop ? 0 : 1);
        // Rows begin with the radiance, see shaders/lights/fields.glsl.
        const rows = this.data.lights.map((light, i) => {
            const row = light.row.slice();
            for (let c = 0; c < 3; ++c) row[c] *= state.lights[i].gain * state.lights[i].color[c];
            return state.lights[i].on ? row : null;
        }).filter(Boolean);
        s.lightData.value?.dispose();
        s.lightData.value = makeRows(rows, Math.max(1, ...rows.map(row => row.length / 4)));
        s.lightCount.value = rows.length;
        // Samples of a pass are shared out where there are many lights.
        const each = Math.min(this.samplesPerPass, Math.max(1, Math.floor(4 * this.samplesPerPass / Math.max(rows.length, 1))));
        const drawn = drawSamples(environment.texture, s, this.passes, Math.max(4, 2 * this.samplesPerPass));
        s.environmentSamples.value?.dispose();
        s.environmentSamples.value = drawn.texture;
        s.environmentDensity.value.set(drawn.level, drawn.densityOfOne, drawn.trust);
        s.lightSamples.value.set([drawn.count, each]);
        content.setShape(this.parts.shapes[state.shape]);
        this.stale = false;
    }

    // One pass into the target: a column for each step of a wedge.
    _draw(target) {
        const { renderer, content, camera, state } = this;
        const s = content.shared, columns = this.tiles(), pass = this.accumulator.count;
        s.passInfo.value.set([pass, this.samplesPerPass, state.samples, content.shape.closed ? 1 : 0]);
        // Halton's points, moved so that their mean is the middle of the pixel.
        const jitter = [2, 3].map(base => radicalInverse(pass, base) + 0.5 / this.passes - 0.5);
        const program = content.programFor(state.material, state.program, state.needsAll());
        const { made } = program;
        content.mesh.material = made;
        columns.forEach((values, i) => {
            const x0 = Math.round(i * this.width / columns.length);
            const x1 = Math.round((i + 1) * this.width / columns.length);
            fillLive(program, values);
            made.uniformsNeedUpdate = true;
            target.viewport.set(x0, 0, x1 - x0, this.height);
            target.scissor.set(x0, 0, x1 - x0, this.height);
            target.scissorTest = true;
            camera.aspect = (x1 - x0) / this.height;
            camera.fov = state.fieldOfView(camera.aspect);
            camera.updateProjectionMatrix();
            content.setCamera(camera, this.height);
            s.jitter.value.set(2 * jitter[0] / (x1 - x0), 2 * jitter[1] / this.height);
            renderer.setRenderTarget(target);
            renderer.clear(true, true, false);
            renderer.render(content.scene, camera);
        });
    }

    // @returns whether anything was drawn
    step() {
        if (this.stale) this._apply();
        const adds = this.accumulator.count < this.passes;
        if (!adds && this.drawn) return false;
        if (adds) this.accumulator.add(target => this._draw(target));
        this.accumulator.show(2 ** this.state.exposure, this.reference()?.texture, this.state.wipe);
        this.drawn = true;
        for (const listener of this.listeners) listener(this);
        return true;
    }

    // The path-traced picture of what is seen, if there is one.
    reference() {
        const { state } = this;
        return state.isAtStart() ? this.references.get(`${state.material} ${state.shape}`) : undefined;
    }

    // For what changes the display alone.
    redraw() { this.drawn = false; }

    settle() { while (this.step()); }
}
