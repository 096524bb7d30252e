// SPDX-License-Identifier: Apache-2.0
// The program of a material: the page's head, the generated text, the page's end.
import * as THREE from "three";
import { makeRows } from "./textures.js";

export function fragmentText(data, material, variant) {
    const flags = variant.presence ? "#define PRESENCE\n" : "";
    return flags + data.library.head + variant.text + data.library.page;
}

const maxUniforms = 128; // as in glslText.py: more values come by a texture, 256 in a row

export function makeMaterial(data, index, program, needsAll, shared, textures) {
    const material = data.materials[index], { lean, whole } = material.programs[program];
    const variant = needsAll && whole ? whole : lean;
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
        vertexShader: data.library.surface, fragmentShader: fragmentText(data, material, variant)
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
