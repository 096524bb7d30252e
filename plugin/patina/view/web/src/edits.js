// SPDX-License-Identifier: Apache-2.0
// Texts of shaders as users have changed them. Each belongs to one text of the page, and is drawn where
// that text would be.
import { joined, PARTS, partsOf, placeOf, textKey, variantOf } from "./materials.js";
import { readLog } from "./infoLog.js";

const version = "#version 300 es\n"; // one line, that three.js puts before

export class Edits {
    constructor(page) {
        this.page = page;
        this.drafts = new Map(); // key -> parts
    }

    // The text that the inputs ask for now.
    current() {
        const { data, state } = this.page, needsAll = state.needsAll();
        const index = state.material, program = state.program;
        return { index, program, needsAll, key: textKey(data.materials[index], index, program, needsAll),
                 generated: partsOf(data, variantOf(data.materials[index], program, needsAll)) };
    }

    partsOf(text) { return this.drafts.get(text.key) ?? text.generated; }
    // The changed text that is drawn, or undefined.
    drawn(text) { return this.page.viewer.content.edited.get(text.key)?.source; }

    change(text, part, value) {
        const parts = { ...this.partsOf(text), [part]: value };
        if (PARTS.every(name => parts[name] === text.generated[name])) this.drafts.delete(text.key);
        else this.drafts.set(text.key, parts);
    }

    // Draws the generated text again.
    // @param keep whether the draft stays
    putAside(text, keep) {
        const { content } = this.page.viewer;
        content.edited.get(text.key)?.made.dispose();
        content.edited.delete(text.key);
        if (!keep) this.drafts.delete(text.key);
        this.page.viewer.invalidate();
    }

    putAllAside() {
        for (const { made } of this.page.viewer.content.edited.values()) made.dispose();
        this.page.viewer.content.edited.clear();
    }

    // @returns list of { part, line, isError, text }; it is drawn from now on unless one is an error
    async compile(text) {
        const parts = this.partsOf(text);
        if (!this.drafts.has(text.key)) {
            this.putAside(text, false);
            return [];
        }
        const found = this._translate(joined(parts)).map(m => ({ ...m, part: null, ...placeOf(parts, m.line ?? 0) }));
        if (found.some(m => m.isError)) return found;
        return [...found, ...await this._link(text, parts)];
    }

    _translate(source) {
        const gl = this.page.viewer.renderer.getContext(), shader = gl.createShader(gl.FRAGMENT_SHADER);
        gl.shaderSource(shader, version + source);
        gl.compileShader(shader);
        const fits = gl.getShaderParameter(shader, gl.COMPILE_STATUS);
        const found = readLog(gl.getShaderInfoLog(shader)).map(m => ({ ...m, line: m.line === null ? null : m.line - 1 }));
        gl.deleteShader(shader);
        if (!fits && !found.some(m => m.isError))
            found.push({ line: null, isError: true, text: "the browser refuses this text and gives no reason" });
        return fits ? found.map(m => ({ ...m, isError: false })) : found;
    }

    async _link(text, parts) {
        const { viewer } = this.page, { renderer, content } = viewer;
        const program = content.make(text.index, text.program, text.needsAll, parts);
        const log = [], before = renderer.debug.onShaderError;
        renderer.debug.onShaderError = (gl, linked) => log.push(gl.getProgramInfoLog(linked) || "the program cannot be linked");
        const mesh = content.mesh.clone();
        mesh.material = program.made;
        try {
            renderer.setRenderTarget(viewer.accumulator.pass); // for which three.js would else compile it once more
            renderer.compile(mesh, viewer.camera);
            renderer.setRenderTarget(null);
            const linked = renderer.properties.get(program.made).currentProgram;
            const tells = renderer.extensions.has("KHR_parallel_shader_compile");
            while (tells && !linked.isReady()) await new Promise(done => setTimeout(done, 10));
            linked.getUniforms(); // three.js looks for errors at first use
        } finally {
            renderer.debug.onShaderError = before;
        }
        if (log.length) {
            program.made.dispose();
            return readLog(log.join("\n")).map(m => ({ ...m, line: null, isError: true }));
        }
        content.edited.get(text.key)?.made.dispose();
        content.edited.set(text.key, { ...program, source: joined(parts) });
        viewer.invalidate();
        return [];
    }
}
