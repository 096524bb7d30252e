// SPDX-License-Identifier: Apache-2.0
// How far two texts of a material draw apart.
import { aside } from "./compare.js";
import { meanFlip } from "./flip.js";

const side = 96; // pixels

// The mean over what the shape covers: three numbers, linear.
function meanOf({ colors, cover }) {
    const sum = [0, 0, 0];
    let total = 0;
    // A pixel at the edge shows the backdrop too.
    cover.forEach((share, i) => {
        if (share < 1) return;
        total += 1;
        for (let c = 0; c < 3; ++c) sum[c] += colors[3 * i + c];
    });
    return total ? sum.map(x => x / total) : null;
}

// Draws what the page shows before and after a change of its state, with the same random numbers.
// @param without, now functions that change the state; `now` comes last
// @returns { before, after: means or null, flip, a, b: colours, side }
export async function measureChange(page, without, now) {
    return aside(page, side, side, async draw => {
        without();
        const a = await draw();
        now();
        const b = await draw();
        return { before: meanOf(a), after: meanOf(b), flip: meanFlip(a.colors, b.colors, side, side, 2 ** page.state.exposure),
                 a: a.colors, b: b.colors, side };
    });
}

export const luminance = c => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];

// Of luminance: +0.02 is 2 % more.
export const relative = (before, after) => luminance(after) / Math.max(luminance(before), 1e-9) - 1;

export const percent = x => `${x < 0 ? "\u2212" : "+"}${(100 * Math.abs(x)).toFixed(Math.abs(x) < 0.001 && x !== 0 ? 3 : 1)} %`;

// Grey where both are alike, brighter where the second is: eight times the difference of display values.
export function differencePicture({ a, b, side }, scale) {
    const canvas = document.createElement("canvas"), image = new ImageData(side, side);
    const encode = x => { const c = Math.min(1, Math.max(0, x * scale));
        return c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055; };
    canvas.width = canvas.height = side;
    for (let i = 0; i < side * side; ++i) {
        for (let c = 0; c < 3; ++c) image.data[4 * i + c] = Math.round(128 + 8 * 255 * (encode(b[3 * i + c]) - encode(a[3 * i + c])));
        image.data[4 * i + 3] = 255;
    }
    canvas.getContext("2d").putImageData(image, 0, 0);
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", "Eight times the difference of the display values; grey where there is none");
    return canvas;
}
