// SPDX-License-Identifier: Apache-2.0
// Directions to the environment that all pixels share, drawn by its luminance over the texels of one
// of its smaller versions. As many rows as passes; together they are one set of points.
import * as THREE from "three";
import { makeRows } from "./textures.js";

const widest = 256, coarsest = 32, maxTrust = 8;
const golden = 0.6180339887498949;
const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

// The place of a running sum, from `from` to `to`, to which a share of it leads, and where in it.
function placeOf(sums, from, to, share) {
    const first = from, x = share * sums[to];
    while (from < to) {
        const middle = (from + to) >> 1;
        if (sums[middle] > x) to = middle; else from = middle + 1;
    }
    const before = from > first ? sums[from - 1] : 0;
    return [from, Math.min(Math.max((x - before) / Math.max(sums[from] - before, 1e-300), 0), 1)];
}

// Light of each texel, and running sums of what it gives by its solid angle: of each row, and of rows.
function tableOf({ data, width, height }, scale, ambient) {
    const light = new Float32Array(3 * width * height), sums = new Float64Array(width * height);
    const rows = new Float64Array(height);
    let total = 0;
    for (let y = 0, i = 0; y < height; ++y) {
        const angle = 2 * Math.PI / width * (Math.cos(Math.PI * y / height) - Math.cos(Math.PI * (y + 1) / height));
        let row = 0;
        for (let x = 0; x < width; ++x, ++i) {
            for (let c = 0; c < 3; ++c) light[3 * i + c] = data[4 * i + c] * scale[c] + ambient[c];
            row += angle * Math.max(0, luminance(light[3 * i], light[3 * i + 1], light[3 * i + 2]));
            sums[i] = row;
        }
        rows[y] = total += row;
    }
    return { light, sums, rows, total };
}

// How uneven the light is where lobes of some width see it: the variance over the square of the mean,
// in a version of few texels.
function unevennessOf(levels, scale, ambient) {
    const map = levels.find(l => l.width <= coarsest), { light, total } = tableOf(map, scale, ambient);
    let squares = 0;
    for (let y = 0, i = 0; y < map.height; ++y) {
        const angle = Math.cos(Math.PI * y / map.height) - Math.cos(Math.PI * (y + 1) / map.height);
        for (let x = 0; x < map.width; ++x, ++i) squares += angle * luminance(...light.subarray(3 * i, 3 * i + 3)) ** 2;
    }
    const mean = total / (4 * Math.PI);
    return Math.max(0, squares / (2 * map.width * mean * mean) - 1);
}

// About the golden part of `count`, without a common divisor.
function strideOf(count) {
    const divisor = (a, b) => b ? divisor(b, a % b) : a;
    let stride = Math.max(1, Math.round(count * golden));
    while (divisor(stride, count) > 1) ++stride;
    return stride;
}

// @param uniforms environmentScale, ambient and worldToEnvironment of the page
// @returns the texture, how many samples a pass has (0 for a black environment), the level that was
// sampled, the density by solid angle of a luminance of 1, and how much more than by their density
// these samples count beside those of the BSDF: not at all where light is even, which those know best
export function drawSamples(texture, uniforms, passes, wanted) {
    const levels = texture.userData.floats;
    const level = levels.findIndex(l => l.width <= widest), map = levels[level];
    const scale = uniforms.environmentScale.value.toArray(), ambient = uniforms.ambient.value.toArray();
    const { light, sums, rows, total } = tableOf(map, scale, ambient);
    if (!(total > 0)) return { texture: makeRows([[]], 1), count: 0, level, densityOfOne: 0, trust: 0 };
    const toWorld = uniforms.worldToEnvironment.value.clone().transpose();
    const lines = [], direction = new THREE.Vector3(), all = passes * wanted, stride = strideOf(all);
    for (let pass = 0; pass < passes; ++pass) {
        const row = [];
        for (let k = 0; k < wanted; ++k) {
            // A lattice by the golden ratio, in an order in which its beginnings are even too.
            const n = (pass * wanted + k) * stride % all, u = (n * golden + 0.5) % 1, v = (n + 0.5) / all;
            const [y, down] = placeOf(rows, 0, map.height - 1, v), first = y * map.width;
            const [i, across] = placeOf(sums, first, first + map.width - 1, u), x = i - first;
            const top = Math.cos(Math.PI * y / map.height), bottom = Math.cos(Math.PI * (y + 1) / map.height);
            const up = top + (bottom - top) * down, side = Math.sqrt(Math.max(0, 1 - up * up));
            const turn = (0.5 - (x + across) / map.width) * 2 * Math.PI;
            direction.set(Math.sin(turn) * side, up, Math.cos(turn) * side).applyMatrix3(toWorld);
            const own = light.subarray(3 * i, 3 * i + 3);
            row.push(direction.x, direction.y, direction.z, luminance(...own) / total, ...own, 0);
        }
        lines.push(row);
    }
    return { texture: makeRows(lines, 2 * wanted), count: wanted, level, densityOfOne: 1 / total,
             trust: Math.min(maxTrust, maxTrust * unevennessOf(levels, scale, ambient) ** 2) };
}
