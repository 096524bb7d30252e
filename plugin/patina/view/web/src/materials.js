// SPDX-License-Identifier: Apache-2.0
// The program of a material: the page's head, the generated text, the page's end.
import * as THREE from "three";
import { makeRows } from "./textures.js";

const isWhole = (material, program, needsAll) => Boolean(needsAll && material.programs[program].whole);

// A text of a material's program: the lean one, or the whole one where it is needed and there is one.
export function variantOf(material, program, needsAll) {
    const { lean, whole } = material.programs[program];
    return isWhole(material, program, needsAll) ? whole : lean;
}

export const textKey = (material, index, program, needsAll) =>
    `${index} ${program} ${isWhole(material, program, needsAll)}`;

export const PARTS = ["head", "material", "page"]; // in the order of the shader

// What a shader is put together from.
export function partsOf(data, variant) {
    const flags = variant.presence ? "#define PRESENCE\n" : "";
    return { head: flags + data.library.head, material: variant.text, page: data.library.page };
}

const closed = text => text.endsWith("\n") ? text : text + "\n";
export const joined = parts => PARTS.map(name => closed(parts[name])).join("");

// @param line of the joined text, from 1
// @returns the part that it is of, and its number there; null where there is no such line
export function placeOf(parts, line) {
    for (const part of PARTS) {
        const count = closed(parts[part]).split("\n").length - 1;
        if (line >= 1 && line <= count) return { part, line };
        line -= count;
    }
    return null;
}

const maxUniforms = 128; // as in glslText.py: more values come by a texture, 256 in a row

// @param parts of an edited text; without them the generated one
export function makeMaterial(data, index, program, needsAll, shared, textures, parts) {
    const material = data.materials[index], variant = variantOf(material, program, needsAll);
    const many = material.inputs.length > maxUniforms, rows = Math.ceil(material.inputs.length / 256);
    const live = new Float32Array(many ? 1024 * rows : 4 * Math.max(material.inputs.length, 1));
    const uniforms = { ...shared };
    if (many) uniforms.liveTable = { value: new THREE.DataTexture(live, 256, rows, THREE.RGBAFormat, THREE.FloatType) };
    else uniforms.live = { value: live };
    variant.textures.forEach((t, i) => { uniforms["sampler" + i] = { value: textures[t] }; });
    if (variant.parameters.length)
        uniforms.parameterTable = { value: makeRows([variant.parameters], variant.parameters.length / 4) };
    const made = new THREE.RawShaderMaterial({
        glslVersion: THREE.GLSL3, uniforms, side: THREE.DoubleSide,
        vertexShader: data.library.surface, fragmentShader: joined(parts ?? partsOf(data, variant))
    });
    made.forceSinglePass = true;
    return { made, live, liveTable: uniforms.liveTable?.value };
}

// Values of the inputs, as vec4 rows.
export function fillLive({ live, liveTable }, values) {
    values.forEach((value, i) => {
        for (let c = 0; c < 4; ++c) live[4 * i + c] = value.length === 1 ? value[0] : value[c] ?? 0;
    });
    if (liveTable) liveTable.needsUpdate = true;
}
