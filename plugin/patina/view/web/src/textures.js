// SPDX-License-Identifier: Apache-2.0
// Textures as the shaders expect them: rows as packed, mip levels averaged in linear light.
import * as THREE from "three";
import { unpack, unpackSmooth } from "./data.js";

const wraps = {
    repeat: THREE.RepeatWrapping, mirror: THREE.MirroredRepeatWrapping, clamp: THREE.ClampToEdgeWrapping,
    black: THREE.ClampToEdgeWrapping
};

// The next level: 2 x 2 texels at a time, an odd last one with its neighbour.
function halved(level) {
    const { data, width, height } = level;
    const w = Math.max(1, width >> 1), h = Math.max(1, height >> 1);
    const out = new Float32Array(w * h * 4);
    for (let y = 0; y < h; ++y)
        for (let x = 0; x < w; ++x) {
            const x0 = Math.min(2 * x, width - 1), x1 = Math.min(2 * x + 1, width - 1);
            const y0 = Math.min(2 * y, height - 1), y1 = Math.min(2 * y + 1, height - 1);
            for (let c = 0; c < 4; ++c)
                out[4 * (y * w + x) + c] = 0.25 *
                    (data[4 * (y0 * width + x0) + c] + data[4 * (y0 * width + x1) + c] +
                     data[4 * (y1 * width + x0) + c] + data[4 * (y1 * width + x1) + c]);
        }
    return { data: out, width: w, height: h };
}

function pyramid(data, width, height) {
    const levels = [{ data, width, height }];
    while (levels.at(-1).width > 1 || levels.at(-1).height > 1) levels.push(halved(levels.at(-1)));
    return levels;
}

const toLinear = Float32Array.from({ length: 256 }, (_, i) => {
    const x = i / 255;
    return x <= 0.04045 ? x / 12.92 : Math.pow((x + 0.055) / 1.055, 2.4);
});

// Texels of an image of the page as floats, four a texel.
async function floatsOf(image) {
    if (image.format === "srgb8") {
        const bytes = await unpack(image.data, "u1");
        return Float32Array.from(bytes, (b, i) => i % 4 === 3 ? b / 255 : toLinear[b]);
    }
    const halves = await unpack(image.data, "f2");
    const channels = image.format === "rgb16" ? 3 : 4;
    const out = new Float32Array(image.width * image.height * 4).fill(1);
    for (let i = 0; i < image.width * image.height; ++i)
        for (let c = 0; c < channels; ++c)
            out[4 * i + c] = THREE.DataUtils.fromHalfFloat(halves[channels * i + c]);
    return out;
}

export async function makeTexture(image) {
    const levels = pyramid(await floatsOf(image), image.width, image.height);
    const asHalf = levels.map(l => ({
        data: Uint16Array.from(l.data, x => THREE.DataUtils.toHalfFloat(x)), width: l.width, height: l.height
    }));
    const texture = new THREE.DataTexture(asHalf[0].data, image.width, image.height, THREE.RGBAFormat,
                                          THREE.HalfFloatType);
    texture.mipmaps = asHalf;
    texture.wrapS = wraps[image.wrap[0]];
    texture.wrapT = wraps[image.wrap[1]];
    texture.magFilter = image.nearest ? THREE.NearestFilter : THREE.LinearFilter;
    texture.minFilter = image.nearest ? THREE.NearestFilter : THREE.LinearMipmapLinearFilter;
    texture.generateMipmaps = false;
    texture.needsUpdate = true;
    texture.userData = { texels: image.width * image.height, levels: levels.length - 1, floats: levels };
    return texture;
}

// One channel of half floats, read by texelFetch() alone.
export async function makeTable(table) {
    const texture = new THREE.DataTexture(await unpackSmooth(table.data), table.width, table.height,
                                          THREE.RedFormat, THREE.HalfFloatType);
    texture.needsUpdate = true;
    return texture;
}

export function makeRows(rows, width) {
    const data = new Float32Array(4 * width * Math.max(rows.length, 1));
    rows.forEach((row, i) => data.set(row, 4 * width * i));
    const texture = new THREE.DataTexture(data, width, Math.max(rows.length, 1), THREE.RGBAFormat,
                                          THREE.FloatType);
    texture.needsUpdate = true;
    return texture;
}

// Groups of four floats, 256 in a row.
export function makeValues(values) {
    const height = Math.max(1, Math.ceil(values.length / 1024)), data = new Float32Array(1024 * height);
    data.set(values);
    const texture = new THREE.DataTexture(data, 256, height, THREE.RGBAFormat, THREE.FloatType);
    texture.needsUpdate = true;
    return texture;
}
