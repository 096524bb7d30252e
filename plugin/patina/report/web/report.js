// SPDX-License-Identifier: Apache-2.0
// The page of one render: two of its pictures with a divider between them, and the numbers of the pixel under the pointer.
"use strict";
(() => {
    const data = JSON.parse(document.getElementById("patina-data").textContent);
    const $ = (id) => document.getElementById(id);
    const left = $("left"), right = $("right"), sheet = $("sheet"), wipe = $("wipe"), divider = $("divider");
    const state = { left: 0, right: Math.min(1, data.layers.length - 1), share: 0.5, zoom: 0 };

    async function unpack(text) {
        const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
        const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
        return new Response(stream).arrayBuffer();
    }

    function half(bits) {
        const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
        if (exponent === 0) return sign * fraction * 2 ** -24;
        return exponent === 31 ? NaN : sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
    }

    const number = (x) => (Math.abs(x) >= 1e5 || (x !== 0 && Math.abs(x) < 1e-3) ? x.toExponential(2) : String(+x.toPrecision(4)));

    function legend(layer) {
        const made = document.createElement("div");
        made.className = "legend";
        const { low, high, unit, scale } = layer.legend, bar = document.createElement("i");
        bar.style.background = `linear-gradient(to right, ${data.colors})`;
        const show = (x) => (unit === "%" ? `${number(100 * x)} %` : `${number(x)}${unit ? " " + unit : ""}`);
        made.append(`${layer.label}: ${show(low)}`, bar, show(high) + (scale === "log" ? ", logarithmic" : ""));
        return made;
    }

    function draw() {
        const a = data.layers[state.left], b = data.layers[state.right];
        if (left.src !== a.uri) left.src = a.uri;
        if (right.src !== b.uri) right.src = b.uri;
        left.alt = a.label;
        right.alt = b.label;
        right.style.clipPath = `inset(0 0 0 ${100 * state.share}%)`;
        divider.style.left = `${100 * state.share}%`;
        divider.setAttribute("aria-valuenow", Math.round(100 * state.share));
        $("leftTag").textContent = a.label;
        $("rightTag").textContent = b.label;
        $("leftChoice").value = state.left;
        $("rightChoice").value = state.right;
        $("legends").replaceChildren(...[...new Set([a, b])].filter((layer) => layer.legend).map(legend));
        sheet.style.width = state.zoom ? `${data.probe.width * state.zoom}px` : "100%";
        for (const button of $("zoom").children) button.setAttribute("aria-pressed", +button.dataset.zoom === state.zoom);
    }

    function change(values) {
        Object.assign(state, values);
        state.share = Math.min(Math.max(state.share, 0), 1);
        draw();
    }

    for (const [id, side] of [["leftChoice", "left"], ["rightChoice", "right"]]) {
        data.layers.forEach((layer, i) => $(id).add(new Option(layer.label, i)));
        $(id).addEventListener("change", () => change({ [side]: +$(id).value }));
    }
    $("swap").addEventListener("click", () => change({ left: state.right, right: state.left }));
    for (const button of $("zoom").children) button.addEventListener("click", () => change({ zoom: +button.dataset.zoom }));

    const place = (event) => {
        const box = sheet.getBoundingClientRect();
        return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    };
    divider.addEventListener("pointerdown", (event) => {
        divider.setPointerCapture(event.pointerId);
        event.preventDefault();
        divider.focus();
    });
    divider.addEventListener("pointermove", (event) => {
        if (divider.hasPointerCapture(event.pointerId)) change({ share: place(event)[0] });
    });
    divider.addEventListener("keydown", (event) => {
        const step = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
        if (step === undefined) return;
        event.preventDefault();
        change({ share: state.share + step });
    });
    document.addEventListener("keydown", (event) => {
        if (event.target.closest("select, input, pre") || event.ctrlKey || event.metaKey || event.altKey) return;
        if (event.key >= "1" && event.key <= "9" && +event.key <= data.layers.length) change({ right: +event.key - 1 });
        else if (event.key === "s") change({ left: state.right, right: state.left });
    });

    let pixels = null;
    /** The values of a pixel of the page's pictures, as pairs of a name and a text. */
    function describe(x, y) {
        const i = y * data.probe.width + x, step = data.probe.step, depth = pixels.depth[i], prim = pixels.prim[i];
        const color = [0, 1, 2].map((c) => half(pixels.color[3 * i + c]));
        const told = [["pixel", `${x * step + data.origin[0]}, ${y * step + data.origin[1]}`], ["linear RGB", color.map(number).join("  ")],
            ["samples", String(pixels.samples[i])], ["error", `${number(100 * half(pixels.error[i]))} %`],
            ["depth", depth < 1e9 ? number(depth) : "nothing is seen"]];
        if (prim >= 0) told.push(["prim", data.prims[prim] ?? String(prim)]);
        return told;
    }

    function showValues(pairs) {
        $("pixel").replaceChildren(...pairs.map(([name, text]) => {
            const made = document.createElement("span"), head = document.createElement("b");
            head.textContent = name + " ";
            made.append(head, text);
            return made;
        }));
    }

    sheet.addEventListener("pointermove", (event) => {
        const [u, v] = place(event);
        if (!pixels || u < 0 || v < 0 || u >= 1 || v >= 1) return;
        showValues(describe(Math.floor(u * data.probe.width), Math.floor(v * data.probe.height)));
    });

    for (const button of document.querySelectorAll("button[data-copy]")) {
        button.addEventListener("click", async () => {
            const text = $(button.dataset.copy).textContent;
            try {
                await navigator.clipboard.writeText(text);
                button.textContent = "Copied";
            } catch {
                const range = document.createRange();
                range.selectNodeContents($(button.dataset.copy));
                getSelection().removeAllRanges();
                getSelection().addRange(range);
                button.textContent = "Selected";
            }
        });
    }

    async function load() {
        const p = data.probe, parts = await Promise.all(["color", "samples", "error", "depth", "prim"].map((name) => unpack(p[name])));
        pixels = { color: new Uint16Array(parts[0]), samples: new Uint16Array(parts[1]), error: new Uint16Array(parts[2]),
            depth: new Float32Array(parts[3]), prim: new Int32Array(parts[4]) };
        return { state, data, change, describe };
    }
    draw();
    window.patina = { ready: load() };
})();
