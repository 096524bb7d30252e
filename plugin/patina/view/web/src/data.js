// SPDX-License-Identifier: Apache-2.0
// The data of the page: a JSON text in the document, arrays in it packed (view/blobs.py).

export async function readDocument() {
    const data = JSON.parse(document.getElementById("patina-data").textContent);
    const { library, programs, layers, plans } = JSON.parse(new TextDecoder().decode(await unpack(data.texts, "u1")));
    data.library = library;
    data.materials.forEach((m, i) => Object.assign(m, { programs: programs[i], layer: layers[i], plan: plans[i] }));
    return data;
}

const types = { u1: Uint8Array, u2: Uint16Array, f2: Uint16Array, u4: Uint32Array, f4: Float32Array };

export async function unpack(text, type) {
    const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new types[type](await new Response(stream).arrayBuffer());
}

// As blobs.pack_smooth() packs them: bits of half floats.
export async function unpackSmooth(text) {
    const bytes = await unpack(text, "u1"), count = bytes.length / 2, out = new Uint16Array(count);
    for (let i = 0; i < count; ++i) {
        const folded = bytes[i] | bytes[count + i] << 8;
        out[i] = (folded >> 1 ^ -(folded & 1)) + (i > 1 ? out[i - 2] : 0);
    }
    return out;
}
