// SPDX-License-Identifier: Apache-2.0
// Mean FLIP of two pictures (Andersson et al. 2020, LDR-FLIP), at 67 pixels per degree: display
// colours pass the eye's contrast sensitivity, are compared in a uniform space (HyAB), and count more
// where edges and points differ.

const degreePixels = 67.0206;
const { ceil, sqrt, exp, abs, min, max, hypot, PI } = Math;

// Rows and columns of one channel, each with its own kernel; edges repeat.
function filtered(channel, w, h, across, down) {
    const r = (across.length - 1) / 2, middle = new Float32Array(w * h), out = new Float32Array(w * h);
    for (let y = 0; y < h; ++y)
        for (let x = 0; x < w; ++x) {
            let sum = 0;
            for (let k = -r; k <= r; ++k) sum += across[k + r] * channel[y * w + min(w - 1, max(0, x + k))];
            middle[y * w + x] = sum;
        }
    for (let y = 0; y < h; ++y)
        for (let x = 0; x < w; ++x) {
            let sum = 0;
            for (let k = -r; k <= r; ++k) sum += down[k + r] * middle[min(h - 1, max(0, y + k)) * w + x];
            out[y * w + x] = sum;
        }
    return out;
}

function gaussian(radius, f) {
    return Float64Array.from({ length: 2 * radius + 1 }, (_, i) => f(i - radius));
}
const scaled = (kernel, factor) => kernel.map(x => x * factor);
const total = kernel => kernel.reduce((a, b) => a + b, 0);

// A sum of two Gaussians is not separable, but each of them is.
function sensitivity(channel, w, h, a1, b1, a2, b2) {
    const radius = ceil(3 * sqrt(0.04 / (2 * PI * PI)) * degreePixels);
    const parts = [[a1, b1], [a2, b2]].filter(([a]) => a > 0).map(([a, b]) => {
        const g = gaussian(radius, i => exp(-PI * PI * (i / degreePixels) ** 2 / b));
        return { kernel: g, factor: a * sqrt(PI / b) };
    });
    const norm = parts.reduce((s, p) => s + p.factor * total(p.kernel) ** 2, 0);
    const out = new Float32Array(w * h);
    for (const { kernel, factor } of parts) {
        const f = filtered(channel, w, h, kernel, scaled(kernel, factor / norm));
        for (let i = 0; i < out.length; ++i) out[i] += f[i];
    }
    return out;
}

const white = [0.950428545, 1.000000000, 1.088900371];
function xyz(r, g, b) {
    return [0.412386563 * r + 0.357591469 * g + 0.180450460 * b,
            0.212636862 * r + 0.715182981 * g + 0.072180187 * b,
            0.019330615 * r + 0.119197204 * g + 0.950372587 * b];
}
function rgb(x, y, z) {
    return [3.241003275 * x - 1.537398934 * y - 0.498615861 * z, -0.969224334 * x + 1.875930071 * y + 0.041554224 * z,
            0.055639423 * x - 0.204011202 * y + 1.057148933 * z];
}
const root = t => t > (6 / 29) ** 3 ? Math.cbrt(t) : t / (3 * (6 / 29) ** 2) + 4 / 29;
// L*a*b* with the Hunt effect: dark colours are less colourful.
function huntLab(r, g, b) {
    const [x, y, z] = xyz(r, g, b).map((c, i) => root(c / white[i]));
    const l = 116 * y - 16;
    return [l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)];
}
const distance = (p, q) => abs(p[0] - q[0]) + hypot(p[1] - q[1], p[2] - q[2]);

function colors(image, w, h) {
    const planes = [0, 1, 2].map(() => new Float32Array(w * h));
    for (let i = 0; i < w * h; ++i) {
        const [x, y, z] = xyz(image[3 * i], image[3 * i + 1], image[3 * i + 2]).map((c, k) => c / white[k]);
        planes[0][i] = 116 * y - 16;
        planes[1][i] = 500 * (x - y);
        planes[2][i] = 200 * (y - z);
    }
    const seen = [sensitivity(planes[0], w, h, 1, 0.0047, 0, 1e-5), sensitivity(planes[1], w, h, 1, 0.0053, 0, 1e-5),
                  sensitivity(planes[2], w, h, 34.1, 0.04, 13.5, 0.025)];
    const lab = [];
    for (let i = 0; i < w * h; ++i) {
        const y = (seen[0][i] + 16) / 116, x = seen[1][i] / 500 + y, z = y - seen[2][i] / 200;
        const c = rgb(x * white[0], y * white[1], z * white[2]).map(v => min(1, max(0, v)));
        lab.push(huntLab(...c));
    }
    return { lab, grey: planes[0].map(l => (l + 16) / 116) };
}

function features(grey, w, h) {
    const sd = 0.5 * 0.082 * degreePixels, radius = ceil(3 * sd);
    const g = gaussian(radius, i => exp(-i * i / (2 * sd * sd)));
    const weights = { edge: gaussian(radius, i => -i * exp(-i * i / (2 * sd * sd))),
                      point: gaussian(radius, i => (i * i / (sd * sd) - 1) * exp(-i * i / (2 * sd * sd))) };
    const result = {};
    for (const [name, kernel] of Object.entries(weights)) {
        const positive = total(kernel.filter(x => x > 0)), negative = -total(kernel.filter(x => x < 0));
        const k = kernel.map(x => x > 0 ? x / positive : x / negative), smooth = scaled(g, 1 / total(g));
        const dx = filtered(grey, w, h, k, smooth), dy = filtered(grey, w, h, smooth, k);
        result[name] = dx.map((x, i) => hypot(x, dy[i]));
    }
    return result;
}

const encode = c => c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
const decode = c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;

// As a display with 8 bits shows it.
function displayed(image, scale) {
    return image.map(x => decode(Math.round(255 * encode(min(1, max(0, x * scale)))) / 255));
}

// Linear pictures, three floats a pixel; scale: of exposure.
export function meanFlip(reference, test, w, h, scale = 1) {
    const qc = 0.7, pc = 0.4, pt = 0.95, qf = 0.5;
    const [a, b] = [reference, test].map(image => {
        const c = colors(displayed(image, scale), w, h);
        return { ...c, ...features(c.grey, w, h) };
    });
    const maximum = distance(huntLab(0, 1, 0), huntLab(0, 0, 1)) ** qc;
    let sum = 0;
    for (let i = 0; i < w * h; ++i) {
        const color = distance(a.lab[i], b.lab[i]) ** qc;
        const part = color < pc * maximum ? pt / (pc * maximum) * color
            : pt + (color - pc * maximum) / (maximum - pc * maximum) * (1 - pt);
        const feature = (max(abs(a.edge[i] - b.edge[i]), abs(a.point[i] - b.point[i])) / sqrt(2)) ** qf;
        sum += part ** (1 - feature);
    }
    return sum / (w * h);
}
